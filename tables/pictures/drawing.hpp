#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace irido::tables {

/// In units of a picture, of which 96 are an inch; x to the right, y down.
struct Point {
    double x = 0, y = 0;
};

struct Box {
    double left = 0, top = 0, right = 0, bottom = 0;

    double width() const { return right - left; }
    double height() const { return bottom - top; }
    bool operator==(const Box&) const = default;
};

/// A colour in the encoding of sRGB, 65535 being 1.
struct Ink {
    std::uint16_t r = 0, g = 0, b = 0;

    bool operator==(const Ink&) const = default;
};

/// The ink 0xrrggbb.
constexpr Ink ink(std::uint32_t rgb) {
    const auto component = [rgb](unsigned shift) {
        return static_cast<std::uint16_t>(((rgb >> shift) & 0xFFU) * 257U);
    };
    return {component(16), component(8), component(0)};
}

/// "#rrggbb"
std::string hex(const Ink& ink);

/// Lines that are drawn along, filled, or both.
struct Path {
    std::vector<std::vector<Point>> lines = {};
    bool closed = false;
    std::optional<Ink> fill = {};  ///< of what the closed lines wind around
    double opacity = 1;            ///< of the fill
    std::optional<Ink> stroke = {};
    double width = 1;               ///< of the stroke
    std::vector<double> dash = {};  ///< lengths drawn and left out in turn; none: a whole line
};

enum class Anchor { start, middle, end };

/// A line of text, its baseline through `at`, read upwards if `upright`.
struct Text {
    Point at;
    std::string text;  ///< UTF-8, well_formed()
    Anchor anchor = Anchor::start;
    double size = 12;
    Ink ink = {};
    bool upright = false;
    bool halo = false;  ///< over a white edge, to be read on lines and areas
};

/// A grid of coloured cells that fills a box, row by row from the top left.
struct Cells {
    Box box;
    std::size_t columns = 0, rows = 0;
    std::vector<Ink> inks;
};

/// What belongs together, drawn in order.
struct DrawnGroup {
    std::string name;              ///< class in SVG
    std::string title = {};        ///< what SVG shows when it is pointed at
    std::optional<Box> clip = {};  ///< outside of which nothing is drawn
    std::vector<std::variant<Path, Text, Cells>> items = {};
};

/// A picture on white ground, ready to be written in any format.
struct Drawing {
    double width = 0, height = 0;
    std::string title;
    std::string metadata;  ///< JSON that formats keep with the picture; "" for none
    unsigned bits = 8;     ///< of a component where a format has a choice: 8 or 16
    std::vector<DrawnGroup> groups;
};

/// A closed path around a box.
Path box_path(const Box& box);

/// A straight line.
Path line_path(Point from, Point to, const Ink& ink, double width = 1);

}  // namespace irido::tables
