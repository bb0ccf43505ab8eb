#pragma once

#include "tables/pictures/drawing.hpp"

namespace irido::tables {

/// Rows of pixels from the top left, in sRGB encoding.
struct Pixels {
    std::size_t width = 0, height = 0;
    std::vector<Ink> inks;
    std::vector<std::uint16_t> alpha = {};  ///< one per pixel; none: all opaque
};

/// Rasterizes a drawing with `scale` pixels per unit. Antialiasing is exact along rows and in
/// sixteen steps across them. The same pixels on every machine.
Pixels rasterized(const Drawing& drawing, double scale);

}  // namespace irido::tables
