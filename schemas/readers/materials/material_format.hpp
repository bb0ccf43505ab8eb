#pragma once

#include <span>
#include <string>
#include <string_view>

#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// A format of material files, which is told by the text and not by the file's name.
struct MaterialFormat {
    std::string_view name;
    bool (*is)(std::string_view text);
    /// Throws InputError with file `name`.
    MaterialFile (*read)(std::string_view text, const std::string& name);
};

/// All but tables of columns, which are what is none of these.
std::span<const MaterialFormat> material_formats();

}  // namespace irido::schemas
