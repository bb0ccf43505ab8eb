#pragma once

#include "tables/pictures/raster.hpp"

namespace irido::tables {

/// A PNG file of 8 or 16 bits a component with an sRGB chunk, and alpha if the pixels have it.
/// `pixels_per_metre` of the pHYs chunk, 0 for none; `metadata` becomes the iTXt chunk
/// "irido.metadata" if there is any. Throws PictureError.
std::string png_file(const Pixels& pixels, unsigned bits, unsigned pixels_per_metre = 0,
                     const std::string& metadata = "");

}  // namespace irido::tables
