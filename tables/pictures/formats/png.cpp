#include "tables/pictures/picture_format.hpp"
#include "tables/pictures/png_file.hpp"
#include "tables/pictures/raster.hpp"

namespace irido::tables {

namespace {

constexpr double kPixelsAUnit = 2;
constexpr unsigned kPixelsAMetre = 7559;  ///< two per unit, 96 units per inch

std::string write(const Drawing& drawing) {
    return png_file(rasterized(drawing, kPixelsAUnit), drawing.bits, kPixelsAMetre,
                    drawing.metadata);
}

}  // namespace

extern const PictureFormat picture_format_png{
    .name = "png",
    .summary = "pixels in sRGB, two a unit",
    .is_binary = true,
    .write = write,
};

}  // namespace irido::tables
