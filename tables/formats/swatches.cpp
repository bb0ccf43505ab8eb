#include "tables/formats/swatches.hpp"

#include <algorithm>

#include "tables/records.hpp"

namespace irido {

namespace {

constexpr double kWidth = 720, kLeft = 70, kRight = 20, kTop = 40, kStrip = 64, kGap = 8;
constexpr std::size_t kMostTicks = 10;

std::string number(double value) {
    std::string text;
    append_number(text, value);
    return text;
}

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '&') {
            out += "&amp;";
        } else if (c == '<') {
            out += "&lt;";
        } else {
            out += c;
        }
    }
    return out;
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text) {
    return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\">" +
           escaped(text) + "</text>\n";
}

/// Left edge of swatch `i` of `count`, on whole units where they are wide enough to show a seam.
double edge(std::size_t i, std::size_t count) {
    return kLeft + (kWidth - kLeft - kRight) * static_cast<double>(i) / static_cast<double>(count);
}

std::string strip_at(double y, const Swatches::Strip& strip) {
    const std::size_t count = strip.colors.size();
    std::string out = text_at(kLeft - 10, y + kStrip / 2 + 5, "end", strip.label);
    for (std::size_t i = 0; i < count; ++i)
        out += "<rect x=\"" + number(edge(i, count)) + "\" y=\"" + number(y) + "\" width=\"" +
               number(edge(i + 1, count) - edge(i, count)) + "\" height=\"" + number(kStrip) +
               "\" fill=\"" + strip.colors[i] + "\"/>\n";
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
        out += text_at((edge(i, count) + edge(i + 1, count)) / 2, y, "middle",
                       number(swatches.positions[i]));
    return out + text_at(kWidth / 2, y + 22, "middle", swatches.axis);
}

}  // namespace

std::string write_swatches(const Swatches& swatches) {
    const double strips = static_cast<double>(swatches.strips.size());
    const double bottom = kTop + strips * (kStrip + kGap);
    const std::string size = number(kWidth) + " " + number(bottom + 44);
    std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size +
                      "\" font-family=\"sans-serif\" font-size=\"14\" fill=\"#333333\" "
                      "shape-rendering=\"crispEdges\">\n"
                      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    out += text_at(kLeft, 26, "start", swatches.title);
    for (std::size_t i = 0; i < swatches.strips.size(); ++i)
        out += strip_at(kTop + static_cast<double>(i) * (kStrip + kGap), swatches.strips[i]);
    return out + axis_at(bottom + 12, swatches) + "</svg>\n";
}

}  // namespace irido
