#pragma once

#include <string>
#include <string_view>

#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// Whether a text is a CSV or TXT download from the refractiveindex.info site: its first line is
/// "wl,n".
bool is_refractiveindex_csv(std::string_view text);

/// Reads a block of rows "wl,n" and, if k is known, a block "wl,k" with its own rows, wavelengths
/// in um. k < 0 is set to 0. Throws InputError with file `name` and "line:column".
MaterialFile read_refractiveindex_csv(std::string_view text, const std::string& name);

}  // namespace irido::schemas
