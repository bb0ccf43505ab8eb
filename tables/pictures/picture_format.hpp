#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tables/pictures/drawing.hpp"

namespace irido::tables {

/// A way to write drawings. The bytes follow from the drawing alone.
struct PictureFormat {
    std::string_view name;     ///< as --format and as a file's extension
    std::string_view summary;  ///< for --help
    bool is_binary;
    std::string (*write)(const Drawing&);
};

/// All formats, by name. The list is made from the files in tables/pictures/formats/.
std::span<const PictureFormat* const> picture_formats();

/// nullptr if there is none of that name.
const PictureFormat* find_picture_format(std::string_view name);

}  // namespace irido::tables
