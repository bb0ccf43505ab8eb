#pragma once

#include "tables/pictures/drawing.hpp"

namespace irido::tables {

/// The outlines of a line of text as closed polylines, with curves flattened.
std::vector<std::vector<Point>> text_outline(const Text& text);

/// Closed polylines, all with the same winding, around the area that a path's stroke covers: butt
/// caps, round joins, dashes.
std::vector<std::vector<Point>> stroke_outline(const Path& path);

}  // namespace irido::tables
