#pragma once

#include <string>
#include <string_view>

#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// Whether a text is a .mat file of J. A. Woollam's WVASE: a comment, a line with a unit (eV,
/// Angstroms, nm, um) and a line with one word.
bool is_woollam_mat(std::string_view text);

/// Its material: below NK rows of n and k, below E1E2 of the permittivity. Models of dispersion are
/// refused by name. Throws InputError with file `name` and "line:column".
MaterialFile read_woollam_mat(std::string_view text, const std::string& name);

}  // namespace irido::schemas
