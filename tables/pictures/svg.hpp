#pragma once

#include <string>

namespace irido::tables {

/// Shortest text of a number.
std::string svg_number(double value);

/// Text of a coordinate, to a hundredth of a unit.
std::string svg_coordinate(double value);

/// Text escaped for element content and attributes, and well_formed().
std::string svg_escaped(const std::string& text);

/// A line of text; anchor start, middle or end.
std::string svg_text(double x, double y, const std::string& anchor, const std::string& text);

/// A straight line; `color` is an SVG colour.
std::string svg_line(double x1, double y1, double x2, double y2, const std::string& color);

}  // namespace irido::tables
