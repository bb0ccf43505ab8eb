#pragma once

#include <string>
#include <string_view>

#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// Whether a text is a SOPRA .nk file: its first line holds a unit code (1 eV, 2 um, 3 cm-1, 4 nm),
/// the first and last values in that unit, and the number of intervals between them.
bool is_sopra_nk(std::string_view text);

/// Reads its pairs of n and k at equal steps of the unit, one more than intervals; text after a
/// pair is a comment. Throws InputError with file `name`.
MaterialFile read_sopra_nk(std::string_view text, const std::string& name);

/// Whether a text is SOPRA's database in the form distributed for other programs: fields that end
/// in *, the first of which is VERSION.
bool is_sopra_mat(std::string_view text);

/// Reads its lines DATA1*number*nm*n*k*, as many as POINTS says. Throws InputError with file `name`
/// and "line:column".
MaterialFile read_sopra_mat(std::string_view text, const std::string& name);

}  // namespace irido::schemas
