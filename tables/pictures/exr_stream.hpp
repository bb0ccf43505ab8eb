#pragma once

#include <openexr.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/colorimetry/space.hpp"
#include "tables/pictures/figure.hpp"

namespace irido::tables {

/// An OpenEXR file in memory, through the C library of OpenEXR 3.1 (the "core" API).
class ExrFile {
public:
    /// For reading bytes that outlive it. Throws PictureError.
    explicit ExrFile(std::string_view input);
    /// For writing. Throws PictureError.
    ExrFile();
    ~ExrFile();
    ExrFile(const ExrFile&) = delete;
    ExrFile& operator=(const ExrFile&) = delete;

    operator exr_context_t() const { return context_; }
    /// Throws PictureError with the library's message if a call has failed.
    void check(exr_result_t result) const;
    /// Closes a file being written and returns its bytes.
    std::string finish();

    struct Stream {
        std::string_view input;
        std::string output;
        std::string message;  ///< the library's latest
    };

private:
    exr_context_initializer_t common_setup();

    Stream stream_;
    exr_context_t context_ = nullptr;
    bool is_reading_ = false;
};

/// Pixels in memory: rows from the top, components of a pixel adjacent.
struct ExrPixels {
    std::int32_t width = 0, height = 0;
    std::span<const char* const> channels;  ///< names of a pixel's components
    exr_pixel_type_t type = EXR_PIXEL_FLOAT;

    std::ptrdiff_t row_bytes() const;
    std::size_t bytes() const;
};

/// Records the channels' primaries and white in the header of the only part. Throws PictureError.
void set_chromaticities(const ExrFile& file, const RgbSpace& space);

/// Writes all rows of the only part, whose header has been written, as scan lines in the pixels'
/// type. Throws PictureError.
void write_rows(const ExrFile& file, const ExrPixels& pixels, const char* texels);

/// Reads all rows of the first part, scan lines or tiles, in the pixels' type; channels of the file
/// that are not named are skipped. Throws PictureError.
void read_rows(const ExrFile& file, const ExrPixels& pixels, char* texels);

}  // namespace irido::tables
