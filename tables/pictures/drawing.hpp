#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace irido::tables {

/// In picture units, 96 per inch; x to the right, y down.
struct Point {
    double x = 0, y = 0;
};

struct Box {
    double left = 0, top = 0, right = 0, bottom = 0;

    double width() const { return right - left; }
    double height() const { return bottom - top; }
    bool operator==(const Box&) const = default;
};

/// A colour in sRGB encoding, 65535 being 1.
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

/// Polylines to be stroked, filled, or both.
struct Path {
    std::vector<std::vector<Point>> lines = {};
    bool closed = false;
    std::optional<Ink> fill = {};  ///< for the area inside the closed lines
    double opacity = 1;            ///< of the fill
    std::optional<Ink> stroke = {};
    double width = 1;               ///< of the stroke
    std::vector<double> dash = {};  ///< alternating lengths drawn and skipped; none: solid
};

enum class Anchor { start, middle, end };

/// A line of text with its baseline through `at`, reading upwards if `upright`.
struct Text {
    Point at;
    std::string text;  ///< UTF-8, well_formed()
    Anchor anchor = Anchor::start;
    double size = 12;
    Ink ink = {};
    bool upright = false;
    bool halo = false;  ///< with a white outline, for legibility over lines and areas
};

/// A grid of coloured cells that fills a box, in rows from the top left.
struct Cells {
    Box box;
    std::size_t columns = 0, rows = 0;
    std::vector<Ink> inks;
};

/// A group of related shapes, drawn in order.
struct DrawnGroup {
    std::string name;              ///< class in SVG
    std::string title = {};        ///< tooltip in SVG
    std::optional<Box> clip = {};  ///< nothing is drawn outside it
    std::vector<std::variant<Path, Text, Cells>> items = {};
};

/// A picture on a white background, ready for output in any format.
struct Drawing {
    double width = 0, height = 0;
    std::string title;
    std::string metadata;  ///< JSON that formats store with the picture; "" for none
    unsigned bits = 8;     ///< per component, where a format has a choice: 8 or 16
    std::vector<DrawnGroup> groups;
};

/// A closed path around a box.
Path box_path(const Box& box);

/// A straight line.
/// from, to  its ends
/// ink       its colour
/// width     of the stroke, in units of the picture
Path line_path(Point from, Point to, const Ink& ink, double width = 1);

}  // namespace irido::tables
