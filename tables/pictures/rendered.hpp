#pragma once

#include <string>
#include <string_view>

#include "core/render/environment.hpp"
#include "core/render/picture.hpp"
#include "tables/pictures/raster.hpp"

namespace irido::tables {

/// Pixels of a picture in sRGB, each component clipped, with unpremultiplied alpha.
Pixels pixels_of(const Picture& picture);

/// Composited over a background of one colour, opaque.
Pixels pixels_over(const Picture& picture, const Triple& linear_srgb);

/// An OpenEXR file, single precision: R, G, B in linear sRGB, premultiplied by A. `metadata`
/// becomes the attribute irido.metadata. Throws PictureError.
std::string exr_file(const Picture& picture, const std::string& metadata);

/// The first part of an OpenEXR file, its channels R, G and B, or Y for all three: scan lines or
/// tiles, of any precision and with any compression except DWAA and DWAB. Throws PictureError.
EnvironmentImage environment_from_exr(std::string_view bytes);

}  // namespace irido::tables
