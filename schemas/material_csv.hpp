#pragma once

#include <string>
#include <string_view>

#include "schemas/material_file.hpp"

namespace irido {

/// The material in a CSV text `nm,n[,k]` (csv_rows.hpp), interpolated linearly, k = 0 if not given.
/// Throws InputError with file `name` and "line:column".
MaterialFile read_material_csv(std::string_view text, const std::string& name);

}  // namespace irido
