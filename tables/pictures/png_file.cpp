#include "tables/pictures/png_file.hpp"

#include <png.h>

#include <csetjmp>

#include "tables/pictures/figure.hpp"

namespace irido::tables {

namespace {

constexpr int kPngLevel = 6;

/// One row in the file's byte order.
void put_row(const Pixels& pixels, std::size_t row, unsigned bits, std::string& bytes) {
    bytes.clear();
    const auto put = [&](std::uint16_t component) {
        if (bits == 16) bytes += static_cast<char>(component >> 8U);
        bytes += static_cast<char>(bits == 16 ? component & 0xFFU : (component + 128U) / 257U);
    };
    for (std::size_t x = 0; x < pixels.width; ++x) {
        const Ink& ink = pixels.inks[row * pixels.width + x];
        put(ink.r);
        put(ink.g);
        put(ink.b);
        if (!pixels.alpha.empty()) put(pixels.alpha[row * pixels.width + x]);
    }
}

void append_bytes(png_structp png, png_bytep bytes, std::size_t count) {
    static_cast<std::string*>(png_get_io_ptr(png))
        ->append(reinterpret_cast<const char*>(bytes), count);
}

void fail(png_structp /*png*/, png_const_charp message) {
    throw PictureError(std::string("PNG: ") + message);
}

/// The library's structures; errors are thrown through the library, which is built to be unwound.
class PngWriter {
public:
    explicit PngWriter(std::string& to)
        : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, nullptr)),
          info_(png_ ? png_create_info_struct(png_) : nullptr) {
        if (!info_) throw PictureError("PNG: no memory");
        png_set_write_fn(png_, &to, append_bytes, nullptr);
    }
    ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    png_structp png() const { return png_; }
    png_infop info() const { return info_; }

private:
    png_structp png_;
    png_infop info_;
};

}  // namespace

std::string png_file(const Pixels& pixels, unsigned bits, unsigned pixels_per_metre,
                     const std::string& metadata) {
    std::string file, key = "irido.metadata", text = metadata, row;
    const PngWriter writer(file);
    png_structp png = writer.png();
    png_infop info = writer.info();
    png_set_compression_level(png, kPngLevel);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB | PNG_FILTER_UP);
    png_set_IHDR(png, info, static_cast<png_uint_32>(pixels.width),
                 static_cast<png_uint_32>(pixels.height), static_cast<int>(bits),
                 pixels.alpha.empty() ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGBA,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    if (pixels_per_metre)
        png_set_pHYs(png, info, pixels_per_metre, pixels_per_metre, PNG_RESOLUTION_METER);
    if (!metadata.empty()) {
        png_text item{};
        item.compression = PNG_ITXT_COMPRESSION_zTXt;
        item.key = key.data();
        item.text = text.data();
        png_set_text(png, info, &item, 1);
    }
    png_write_info(png, info);
    for (std::size_t y = 0; y < pixels.height; ++y) {
        put_row(pixels, y, bits, row);
        png_write_row(png, reinterpret_cast<png_const_bytep>(row.data()));
    }
    png_write_end(png, nullptr);
    return file;
}

}  // namespace irido::tables
