#include "tables/pictures/band_diagram.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/colorimetry/observer.hpp"
#include "core/colorimetry/space.hpp"
#include "tables/pictures/svg.hpp"

namespace irido::tables {

namespace {

constexpr double kWidth = 760, kHeight = 560;
constexpr double kLeft = 92, kRight = 740, kTop = 76, kBottom = 496;
constexpr double kMiddle = (kLeft + kRight) / 2, kStrip = 12;
constexpr double kFirstVisible_nm = 380, kLastVisible_nm = 780, kHueStep_nm = 2;
constexpr double kLabelHeight = 15;  ///< a gap must be this tall to be named inside

constexpr const char* kColorS = "#0072b2";
constexpr const char* kColorP = "#d55e00";

std::string rectangle(double x, double y, double width, double height, const std::string& style) {
    return "<rect x=\"" + svg_coordinate(x) + "\" y=\"" + svg_coordinate(y) + "\" width=\"" +
           svg_coordinate(width) + "\" height=\"" + svg_coordinate(height) + "\" " + style + "/>\n";
}

/// A pale sRGB colour of a wavelength's hue, paler where the eye sees less of it. White is added
/// until no component is negative.
std::string hue(double wavelength_nm) {
    const Observer& eye = observer(2);
    const auto row = static_cast<std::size_t>(wavelength_nm - kFirstRow_nm);
    const RgbSpace& srgb = rgb_space("srgb");
    const RgbTransform transform(srgb, srgb.white, Adaptation::none);
    Triple rgb = transform({eye.x[row], eye.y[row], eye.z[row]});
    const auto [least, most] = std::ranges::minmax(rgb);
    const double length = most - least;
    const double strength = 0.8 * std::min(1.0, 0.2 + std::sqrt(length));
    for (double& c : rgb) c = 1 - strength * (most - c) / length;
    return hex(srgb, rgb);
}

/// Steps of 1, 2 or 5 times a power of ten that leave at most `most` of them.
double tick_step(double length, double most) {
    for (double decade = std::pow(10, std::floor(std::log10(length / most)));; decade *= 10)
        for (const double digit : {1.0, 2.0, 5.0})
            if (length <= most * digit * decade) return digit * decade;
}

/// Where wavelengths and angles lie in the picture; side -1 for s, +1 for p.
class Frame {
public:
    explicit Frame(const BandDiagram& diagram)
        : diagram_(diagram), largest_deg_(diagram.angles_deg.back()) {}

    double largest_deg() const { return largest_deg_; }
    double y(double wavelength_nm) const {
        const double part =
            (wavelength_nm - diagram_.first_nm) / (diagram_.last_nm - diagram_.first_nm);
        return kBottom - (kBottom - kTop) * std::clamp(part, -0.5, 1.5);
    }
    double x(double angle_deg, int side) const {
        return kMiddle + side * (kRight - kMiddle) * angle_deg / largest_deg_;
    }

private:
    const BandDiagram& diagram_;
    double largest_deg_;
};

std::string visible_strip(const BandDiagram& diagram, const Frame& frame) {
    const double first = std::max(diagram.first_nm, kFirstVisible_nm);
    const double last = std::min(diagram.last_nm, kLastVisible_nm);
    std::string out = "<g class=\"visible\" shape-rendering=\"crispEdges\">\n";
    for (double nm = first; nm < last; nm += kHueStep_nm) {
        // each reaches under the next, so that no seam shows
        const double end = std::min(nm + 2 * kHueStep_nm, last);
        out += rectangle(kLeft - kStrip - 2, frame.y(end), kStrip, frame.y(nm) - frame.y(end),
                         "fill=\"" + hue(std::floor(nm + kHueStep_nm / 2)) + "\"");
    }
    return out + "</g>\n";
}

std::string wavelength_axis(const BandDiagram& diagram, const Frame& frame) {
    const double step = tick_step(diagram.last_nm - diagram.first_nm, 10);
    std::string out;
    for (double i = std::ceil(diagram.first_nm / step); i * step <= diagram.last_nm; ++i) {
        const double y = frame.y(i * step);
        out += svg_line(kLeft, y, kRight, y, "#e8e8e8") +
               svg_text(kLeft - kStrip - 8, std::round(y) + 4, "end", svg_number(i * step));
    }
    const std::string middle = svg_number((kTop + kBottom) / 2);
    return out + "<g transform=\"rotate(-90 22 " + middle + ")\">" +
           svg_text(22, (kTop + kBottom) / 2, "middle", "vacuum wavelength, nm") + "</g>\n";
}

std::string angle_axis(const Frame& frame) {
    const double step = frame.largest_deg() > 45 ? 15 : tick_step(frame.largest_deg(), 6);
    std::string out;
    for (const int side : {-1, 1}) {
        for (double i = side < 0 ? 1 : 0; i * step <= frame.largest_deg(); ++i) {
            const double x = frame.x(i * step, side);
            out +=
                svg_line(x, kTop, x, kBottom, i == 0 ? "#999999" : "#e8e8e8") +
                svg_text(std::round(x * 100) / 100, kBottom + 18, "middle", svg_number(i * step));
        }
    }
    return out + svg_text(kMiddle, kBottom + 42, "middle", "angle of incidence, degrees");
}

std::string gap_area(const BandDiagram& diagram, const Frame& frame,
                     const std::vector<BandDiagram::Edges>& edges, double order, int side) {
    const std::vector<double>& angles = diagram.angles_deg;
    std::string points, back;
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const std::string x = svg_coordinate(frame.x(angles[i], side)) + ",";
        points += x + svg_coordinate(frame.y(edges[i].short_nm)) + " ";
        back = x + svg_coordinate(frame.y(edges[i].long_nm)) + " " + back;
    }
    const std::string color = side < 0 ? kColorS : kColorP;
    return "<polygon class=\"gap\" points=\"" + points + back + "\" fill=\"" + color +
           "\" fill-opacity=\"0.32\" stroke=\"" + color +
           "\" stroke-width=\"1.2\" stroke-linejoin=\"round\"><title>" + (side < 0 ? "s" : "p") +
           ", gap of order " + svg_number(order) + "</title></polygon>\n";
}

/// The order, in the middle of what is seen of a gap at the angle where that is tallest.
std::string gap_label(const BandDiagram& diagram, const Frame& frame,
                      const std::vector<BandDiagram::Edges>& edges, double order, int side) {
    double tallest = kLabelHeight, x = 0, y = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const double at = frame.x(diagram.angles_deg[i], side);
        if (std::abs(at - kMiddle) < 12 || std::abs(at - kMiddle) > kRight - kMiddle - 12) continue;
        const double top = std::max(frame.y(edges[i].long_nm), kTop);
        const double bottom = std::min(frame.y(edges[i].short_nm), kBottom);
        if (bottom - top <= tallest + 0.5) continue;
        tallest = bottom - top;
        x = at;
        y = (top + bottom) / 2;
    }
    return tallest == kLabelHeight
               ? ""
               : svg_text(std::round(x), std::round(y) + 4, "middle", svg_number(order));
}

}  // namespace

std::string write_band_diagram(const BandDiagram& diagram) {
    const Frame frame(diagram);
    const std::string size = svg_number(kWidth) + " " + svg_number(kHeight);
    std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + svg_number(kWidth) +
                      "\" height=\"" + svg_number(kHeight) + "\" viewBox=\"0 0 " + size +
                      "\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#222222\">\n"
                      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
                      "<defs><clipPath id=\"frame\">" +
                      rectangle(kLeft, kTop, kRight - kLeft, kBottom - kTop, "") +
                      "</clipPath></defs>\n<g font-size=\"16\">" +
                      svg_text(kLeft, 28, "start", diagram.title) + "</g>\n";
    out += wavelength_axis(diagram, frame) + angle_axis(frame) + visible_strip(diagram, frame);
    std::string labels;
    out += "<g clip-path=\"url(#frame)\">\n";
    for (const BandDiagram::Gap& gap : diagram.gaps) {
        out += gap_area(diagram, frame, gap.s, gap.order, -1) +
               gap_area(diagram, frame, gap.p, gap.order, 1);
        labels += gap_label(diagram, frame, gap.s, gap.order, -1) +
                  gap_label(diagram, frame, gap.p, gap.order, 1);
    }
    out += "</g>\n<g class=\"orders\" font-weight=\"bold\">\n" + labels + "</g>\n";
    out +=
        rectangle(kLeft, kTop, kRight - kLeft, kBottom - kTop, "fill=\"none\" stroke=\"#666666\"");
    for (const int side : {-1, 1})
        out += "<g font-weight=\"bold\" fill=\"" + std::string(side < 0 ? kColorS : kColorP) +
               "\">" +
               svg_text((kMiddle + (side < 0 ? kLeft : kRight)) / 2, kTop - 12, "middle",
                        side < 0 ? "s polarization" : "p polarization") +
               "</g>\n";
    return out + "</svg>\n";
}

}  // namespace irido::tables
