#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tables/pictures/drawing.hpp"

namespace irido::tables {

/// An output format of drawings. The bytes depend only on the drawing.
struct PictureFormat {
    std::string_view name;     ///< value of --format, and the file extension
    std::string_view summary;  ///< for --help
    bool is_binary;
    std::string (*write)(const Drawing&);
};

/// All formats, by name. The list is made from the files in tables/pictures/formats/.
std::span<const PictureFormat* const> picture_formats();

/// nullptr if there is no format of that name.
const PictureFormat* find_picture_format(std::string_view name);

}  // namespace irido::tables
