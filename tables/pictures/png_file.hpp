#pragma once

#include "tables/pictures/raster.hpp"

namespace irido::tables {

/// A PNG file with an sRGB chunk, and alpha if the pixels have it. Throws PictureError.
/// pixels            the pixels
/// bits              per component: 8 or 16
/// pixels_per_metre  resolution for the pHYs chunk, 0 for none
/// metadata          for the iTXt chunk "irido.metadata", "" for none
std::string png_file(const Pixels& pixels, unsigned bits, unsigned pixels_per_metre = 0,
                     const std::string& metadata = "");

}  // namespace irido::tables
