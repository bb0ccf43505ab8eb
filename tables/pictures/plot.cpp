#include "tables/pictures/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tables/pictures/svg.hpp"

namespace irido::tables {

namespace {

constexpr std::size_t kColumns = 4;
constexpr double kPlotWidth = 1080, kPlotLeft = 62, kPlotRight = 18, kPlotTop = 44, kPlotGap = 30;
constexpr double kPanelHeight = 150, kPanelTitle = 20, kTicks = 26, kLegendRow = 22;
constexpr double kPanelWidth =
    (kPlotWidth - kPlotLeft - kPlotRight - (kColumns - 1) * kPlotGap) / kColumns;
constexpr double kLegendEntry = 146;

constexpr std::array kColors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000",
                             "#e69f00", "#56b4e9", "#7f7f7f", "#8c510a"};

struct Box {
    double left, top, right, bottom;
};

double position(double value, const Plot::Axis& axis) {
    const double power = value > 0 ? std::log10(value) : axis.first_power;
    return std::clamp((power - axis.first_power) / (axis.last_power - axis.first_power), 0.0, 1.0);
}

/// Circle, square, triangle, diamond or cross around a point.
std::string marker(std::size_t kind, double x, double y) {
    const std::string at = svg_coordinate(x) + " " + svg_coordinate(y);
    const std::string color = kColors[kind % kColors.size()];
    constexpr std::array shapes{"m-3.4 0a3.4 3.4 0 1 0 6.8 0a3.4 3.4 0 1 0 -6.8 0z",
                                "m-3 -3h6v6h-6z", "m0 -4l3.8 6.6h-7.6z",
                                "m0 -4.4l4.4 4.4l-4.4 4.4l-4.4 -4.4z",
                                "m-3.4 -3.4l6.8 6.8m0 -6.8l-6.8 6.8"};
    const std::size_t shape = kind % shapes.size();
    const bool is_cross = shape + 1 == shapes.size();
    return "<path d=\"M" + at + shapes[shape] + "\" " +
           (is_cross ? "stroke-width=\"2\" stroke=\"" + color + "\""
                     : "fill=\"" + color + "\" stroke=\"#ffffff\" stroke-width=\"0.6\"") +
           "/>\n";
}

std::string polyline(const std::vector<Plot::Point>& points, const std::string& style) {
    std::string out = "<polyline points=\"";
    for (const Plot::Point& point : points)
        out += svg_coordinate(point.x) + "," + svg_coordinate(point.y) + " ";
    return out + "\" " + style + "/>\n";
}

/// Powers between two labels, so that they keep `space` apart on `length`.
int label_step(const Plot::Axis& axis, double length, double space) {
    const double unit = length / (axis.last_power - axis.first_power);
    return std::max(1, static_cast<int>(std::ceil(space / unit)));
}

/// 10 to a power with the power raised.
std::string power_text(double x, double y, const std::string& anchor, int power) {
    return "<text x=\"" + svg_coordinate(x) + "\" y=\"" + svg_coordinate(y) + "\" text-anchor=\"" +
           anchor + "\">10<tspan dy=\"-4\" font-size=\"9\">" + std::to_string(power) +
           "</tspan></text>\n";
}

std::string grid(const Plot& plot, const Box& box, bool has_labels_left) {
    std::string out;
    const double width = box.right - box.left, height = box.bottom - box.top;
    const int x_step = label_step(plot.x, width, 34), y_step = label_step(plot.y, height, 20);
    for (int power = plot.x.first_power; power <= plot.x.last_power; ++power) {
        const double x = box.left + width * position(std::pow(10, power), plot.x);
        out += svg_line(x, box.top, x, box.bottom, "#e4e4e4");
        if ((power - plot.x.first_power) % x_step == 0)
            out += power_text(x, box.bottom + 15, "middle", power);
    }
    for (int power = plot.y.first_power; power <= plot.y.last_power; ++power) {
        if ((power - plot.y.first_power) % y_step != 0) continue;
        const double y = box.bottom - height * position(std::pow(10, power), plot.y);
        out += svg_line(box.left, y, box.right, y, "#e4e4e4");
        if (has_labels_left) out += power_text(box.left - 6, y + 5, "end", power);
    }
    return out;
}

std::string panel_at(const Plot& plot, const Plot::Panel& panel, const Box& box,
                     bool has_labels_left) {
    const auto placed = [&](const std::vector<Plot::Point>& points) {
        std::vector<Plot::Point> result = points;
        for (Plot::Point& point : result)
            point = {box.left + (box.right - box.left) * position(point.x, plot.x),
                     box.bottom - (box.bottom - box.top) * position(point.y, plot.y)};
        return result;
    };
    std::string out = "<g class=\"panel\">\n" + grid(plot, box, has_labels_left);
    out += "<g font-weight=\"bold\">" + svg_text(box.left, box.top - 6, "start", panel.title) +
           "</g>\n";
    if (!panel.highlight.empty())
        out += polyline(placed(panel.highlight),
                        "class=\"highlight\" fill=\"none\" stroke=\"#fbe08a\" stroke-width=\"9\" "
                        "stroke-linejoin=\"round\" stroke-linecap=\"round\"");
    for (const Plot::Series& series : panel.series) {
        const std::vector<Plot::Point> points = placed(series.points);
        const std::string color = kColors[series.kind % kColors.size()];
        out += "<g class=\"series\">\n";
        if (points.size() > 1) out += polyline(points, "fill=\"none\" stroke=\"" + color + "\"");
        for (const Plot::Point& point : points) out += marker(series.kind, point.x, point.y);
        out += "</g>\n";
    }
    return out + "</g>\n";
}

std::string legend_at(const Plot& plot, double top) {
    std::string out = "<g class=\"legend\">\n";
    const auto per_row =
        static_cast<std::size_t>((kPlotWidth - kPlotLeft - kPlotRight) / kLegendEntry);
    const auto place = [&](std::size_t i) {
        const std::size_t row = i / per_row;
        return Plot::Point{kPlotLeft + kLegendEntry * static_cast<double>(i % per_row),
                           top + kLegendRow * static_cast<double>(row)};
    };
    for (std::size_t i = 0; i < plot.legend.size(); ++i) {
        const auto [x, y] = place(i);
        out += svg_line(x, y, x + 22, y, kColors[i % kColors.size()]) + marker(i, x + 11, y) +
               svg_text(x + 28, y + 4, "start", plot.legend[i]);
    }
    if (!plot.highlight.empty()) {
        const auto [x, y] = place(plot.legend.size());
        out += polyline({{x + 4, y}, {x + 18, y}},
                        "stroke=\"#fbe08a\" stroke-width=\"9\" stroke-linecap=\"round\"") +
               svg_text(x + 28, y + 4, "start", plot.highlight);
    }
    return out + "</g>\n";
}

}  // namespace

std::string write_plot(const Plot& plot) {
    const std::size_t rows = (plot.panels.size() + kColumns - 1) / kColumns;
    const std::size_t entries = plot.legend.size() + (plot.highlight.empty() ? 0 : 1);
    const auto per_row =
        static_cast<std::size_t>((kPlotWidth - kPlotLeft - kPlotRight) / kLegendEntry);
    const double legend_top = kPlotTop + 8;
    const double legend_rows =
        std::ceil(static_cast<double>(entries) / static_cast<double>(per_row));
    const double top = legend_top + legend_rows * kLegendRow;
    const double row_height = kPanelTitle + kPanelHeight + kTicks;
    const double height = top + static_cast<double>(rows) * row_height + 30;
    std::string out =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + svg_number(kPlotWidth) +
        "\" height=\"" + svg_number(height) + "\" viewBox=\"0 0 " + svg_number(kPlotWidth) + " " +
        svg_number(height) +
        "\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#222222\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n<g font-size=\"16\">" +
        svg_text(kPlotLeft, 28, "start", plot.title) + "</g>\n" + legend_at(plot, legend_top);
    for (std::size_t i = 0; i < plot.panels.size(); ++i) {
        const std::size_t column = i % kColumns, row = i / kColumns;
        Box box{};
        box.left = kPlotLeft + static_cast<double>(column) * (kPanelWidth + kPlotGap);
        box.right = box.left + kPanelWidth;
        box.top = top + static_cast<double>(row) * row_height + kPanelTitle;
        box.bottom = box.top + kPanelHeight;
        out += panel_at(plot, plot.panels[i], box, column == 0);
    }
    const double middle = top + static_cast<double>(rows) * row_height / 2;
    out += svg_text(kPlotWidth / 2, height - 12, "middle", plot.x.title);
    out += "<g transform=\"rotate(-90 16 " + svg_number(middle) + ")\">" +
           svg_text(16, middle, "middle", plot.y.title) + "</g>\n";
    return out + "</svg>\n";
}

}  // namespace irido::tables
