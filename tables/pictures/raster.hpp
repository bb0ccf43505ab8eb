#pragma once

#include "tables/pictures/drawing.hpp"

namespace irido::tables {

/// Rows of pixels from the top left, in the encoding of sRGB.
struct Pixels {
    std::size_t width = 0, height = 0;
    std::vector<Ink> inks;
    std::vector<std::uint16_t> alpha = {};  ///< of each; none: all are opaque
};

/// A drawing with `scale` pixels a unit. Edges are smoothed: exact along rows, in sixteen steps
/// across them. The same pixels on every machine.
Pixels rasterized(const Drawing& drawing, double scale);

}  // namespace irido::tables
