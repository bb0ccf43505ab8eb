#include "tables/pictures/swatches.hpp"

#include <algorithm>

#include "tables/pictures/svg.hpp"

namespace irido::tables {

namespace {

constexpr double kSwatchWidth = 720, kSwatchLeft = 70, kSwatchRight = 20, kSwatchTop = 40,
                 kSwatchStrip = 64, kSwatchGap = 8;
constexpr std::size_t kMostTicks = 10;

/// Left edge of swatch `i` of `count`, on whole units where they are wide enough to show a seam.
double edge(std::size_t i, std::size_t count) {
    return kSwatchLeft + (kSwatchWidth - kSwatchLeft - kSwatchRight) * static_cast<double>(i) /
                             static_cast<double>(count);
}

std::string strip_at(double y, const Swatches::Strip& strip) {
    const std::size_t count = strip.colors.size();
    std::string out = svg_text(kSwatchLeft - 10, y + kSwatchStrip / 2 + 5, "end", strip.label);
    for (std::size_t i = 0; i < count; ++i)
        out += "<rect x=\"" + svg_number(edge(i, count)) + "\" y=\"" + svg_number(y) +
               "\" width=\"" + svg_number(edge(i + 1, count) - edge(i, count)) + "\" height=\"" +
               svg_number(kSwatchStrip) + "\" fill=\"" + strip.colors[i] + "\"/>\n";
    return out;
}

/// 1, 2, 5, 10, 20, ...: the first that leaves at most kMostTicks labels.
std::size_t tick_step(std::size_t count) {
    for (std::size_t decade = 1;; decade *= 10)
        for (const std::size_t digit : {1U, 2U, 5U})
            if (count <= kMostTicks * digit * decade) return digit * decade;
}

std::string axis_at(double y, const Swatches& swatches) {
    const std::size_t count = swatches.positions.size();
    const std::size_t step = tick_step(count);
    std::string out;
    for (std::size_t i = 0; i < count; i += step)
        out += svg_text((edge(i, count) + edge(i + 1, count)) / 2, y, "middle",
                        svg_number(swatches.positions[i]));
    return out + svg_text(kSwatchWidth / 2, y + 22, "middle", swatches.axis);
}

}  // namespace

std::string write_swatches(const Swatches& swatches) {
    const double strips = static_cast<double>(swatches.strips.size());
    const double bottom = kSwatchTop + strips * (kSwatchStrip + kSwatchGap);
    const std::string size = svg_number(kSwatchWidth) + " " + svg_number(bottom + 44);
    std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size +
                      "\" font-family=\"sans-serif\" font-size=\"14\" fill=\"#333333\" "
                      "shape-rendering=\"crispEdges\">\n"
                      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    out += svg_text(kSwatchLeft, 26, "start", swatches.title);
    for (std::size_t i = 0; i < swatches.strips.size(); ++i)
        out += strip_at(kSwatchTop + static_cast<double>(i) * (kSwatchStrip + kSwatchGap),
                        swatches.strips[i]);
    return out + axis_at(bottom + 12, swatches) + "</svg>\n";
}

}  // namespace irido::tables
