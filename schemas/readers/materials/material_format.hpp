#pragma once

#include <span>
#include <string>
#include <string_view>

#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// A format of material files, recognized by content rather than by file name.
struct MaterialFormat {
    std::string_view name;
    bool (*is)(std::string_view text);
    /// Throws InputError with file `name`.
    MaterialFile (*read)(std::string_view text, const std::string& name);
};

/// All formats except tables of columns, which are the fallback.
std::span<const MaterialFormat> material_formats();

}  // namespace irido::schemas
