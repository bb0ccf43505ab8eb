#pragma once

#include <string>
#include <string_view>

#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// Whether a text is a .mat file of J. A. Woollam's WVASE: a comment line, a line with a unit (eV,
/// Angstroms, nm, um) and a line with a single word.
bool is_woollam_mat(std::string_view text);

/// Reads its rows: n and k below NK, the permittivity below E1E2. Dispersion models are refused by
/// name. Throws InputError with file `name` and "line:column".
MaterialFile read_woollam_mat(std::string_view text, const std::string& name);

}  // namespace irido::schemas
