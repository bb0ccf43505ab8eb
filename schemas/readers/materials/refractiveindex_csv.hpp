#pragma once

#include <string>
#include <string_view>

#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// Whether a text is the CSV or TXT that the refractiveindex.info site offers for download: its
/// first line is "wl,n".
bool is_refractiveindex_csv(std::string_view text);

/// Its material: a block "wl,n" with rows, and where k is known a block "wl,k" with its own ones,
/// wavelengths in um. k < 0 is set to 0. Throws InputError with file `name` and "line:column".
MaterialFile read_refractiveindex_csv(std::string_view text, const std::string& name);

}  // namespace irido::schemas
