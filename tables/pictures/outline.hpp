#pragma once

#include "tables/pictures/drawing.hpp"

namespace irido::tables {

/// The outlines of a line of text as closed lines, curves cut into straight pieces.
std::vector<std::vector<Point>> text_outline(const Text& text);

/// Closed lines, all wound the same way, around what a path's stroke covers: blunt ends, round
/// corners, dashes.
std::vector<std::vector<Point>> stroke_outline(const Path& path);

}  // namespace irido::tables
