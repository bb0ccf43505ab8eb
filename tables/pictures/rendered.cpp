#include "tables/pictures/rendered.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "tables/pictures/exr_stream.hpp"
#include "tables/pictures/inks.hpp"

namespace irido::tables {

namespace {

constexpr std::array kRgba{"R", "G", "B", "A"};

Triple color_of(const Picture& picture, std::size_t pixel) {
    const float* const rgba = &picture.rgba[4 * pixel];
    return {static_cast<double>(rgba[0]), static_cast<double>(rgba[1]),
            static_cast<double>(rgba[2])};
}

double alpha_of(const Picture& picture, std::size_t pixel) {
    return static_cast<double>(picture.rgba[4 * pixel + 3]);
}

}  // namespace

Pixels pixels_of(const Picture& picture) {
    Pixels pixels{picture.width, picture.height, {}, {}};
    const std::size_t count = picture.width * picture.height;
    bool is_opaque = true;
    for (std::size_t i = 0; i < count; ++i) {
        Triple color = color_of(picture, i);
        const double alpha = alpha_of(picture, i);
        if (alpha > 0 && alpha < 1)
            for (double& c : color) c /= alpha;
        pixels.inks.push_back(clipped_ink(color));
        pixels.alpha.push_back(static_cast<std::uint16_t>(std::lround(65535 * alpha)));
        is_opaque = is_opaque && alpha == 1;
    }
    if (is_opaque) pixels.alpha.clear();
    return pixels;
}

Pixels pixels_over(const Picture& picture, const Triple& linear_srgb) {
    Pixels pixels{picture.width, picture.height, {}, {}};
    for (std::size_t i = 0; i < picture.width * picture.height; ++i) {
        Triple color = color_of(picture, i);
        // colours outside sRGB are clipped before blending, as a viewer does with a PNG
        const double rest = 1 - alpha_of(picture, i);
        for (std::size_t c = 0; c < 3; ++c)
            color[c] = std::clamp(color[c], 0.0, 1.0) + rest * linear_srgb[c];
        pixels.inks.push_back(clipped_ink(color));
    }
    return pixels;
}

std::string exr_file(const Picture& picture, const std::string& metadata) {
    constexpr int kZipLevel = 6;
    const ExrPixels pixels{static_cast<std::int32_t>(picture.width),
                           static_cast<std::int32_t>(picture.height), kRgba, EXR_PIXEL_FLOAT};
    ExrFile file;
    int part = 0;
    file.check(exr_add_part(file, "picture", EXR_STORAGE_SCANLINE, &part));
    file.check(exr_initialize_required_attr_simple(file, part, pixels.width, pixels.height,
                                                   EXR_COMPRESSION_ZIP));
    file.check(exr_set_zip_compression_level(file, part, kZipLevel));
    for (const char* channel : kRgba)
        file.check(exr_add_channel(file, part, channel, EXR_PIXEL_FLOAT,
                                   EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
    set_chromaticities(file, rgb_space("srgb"));
    file.check(exr_attr_set_string(file, 0, "irido.metadata", metadata.c_str()));
    file.check(exr_write_header(file));
    write_rows(file, pixels, reinterpret_cast<const char*>(picture.rgba.data()));
    return file.finish();
}

EnvironmentImage environment_from_exr(std::string_view bytes) {
    constexpr std::int32_t kMostRows = 16384;
    const ExrFile file(bytes);
    exr_attr_box2i_t window{};
    exr_compression_t compression{};
    const exr_attr_chlist_t* channels = nullptr;
    file.check(exr_get_data_window(file, 0, &window));
    file.check(exr_get_compression(file, 0, &compression));
    file.check(exr_get_channels(file, 0, &channels));
    if (compression == EXR_COMPRESSION_DWAA || compression == EXR_COMPRESSION_DWAB)
        throw PictureError(
            "this OpenEXR file is compressed by DWA, which cannot be read: convert "
            "it, as with oiiotool IN.exr --compression zip -o OUT.exr");
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    if (width != 2 * height || height < 1 || height > kMostRows)
        throw PictureError("an environment must be twice as wide as high, of at most " +
                           std::to_string(kMostRows) + " rows (got " + std::to_string(width) +
                           " x " + std::to_string(height) + ")");
    const auto has = [&](std::string_view name) {
        for (int c = 0; c < channels->num_channels; ++c) {
            const exr_attr_chlist_entry_t& entry = channels->entries[c];
            if (name == entry.name.str && entry.x_sampling == 1 && entry.y_sampling == 1)
                return true;
        }
        return false;
    };
    static constexpr std::array kRgb{"R", "G", "B"}, kGrey{"Y", "Y", "Y"};
    const bool is_rgb = has("R") && has("G") && has("B");
    if (!is_rgb && !has("Y"))
        throw PictureError("an environment must have the channels R, G and B, or Y");
    EnvironmentImage image{static_cast<std::size_t>(width), static_cast<std::size_t>(height), {}};
    image.rgb.resize(image.width * image.height * 3);
    const ExrPixels pixels{static_cast<std::int32_t>(width), static_cast<std::int32_t>(height),
                           is_rgb ? kRgb : kGrey, EXR_PIXEL_FLOAT};
    read_rows(file, pixels, reinterpret_cast<char*>(image.rgb.data()));
    if (is_rgb) return image;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3)
        image.rgb[i + 1] = image.rgb[i + 2] = image.rgb[i];
    return image;
}

}  // namespace irido::tables
