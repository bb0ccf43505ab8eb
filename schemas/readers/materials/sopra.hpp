#pragma once

#include <string>
#include <string_view>

#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// Whether a text is a .nk file of SOPRA: its first line is a code of the unit (1 eV, 2 um, 3 cm-1,
/// 4 nm), the first and the last value in it and the number of intervals between them.
bool is_sopra_nk(std::string_view text);

/// Its material: pairs n k in equal steps of that unit, one more than intervals; text behind them
/// is a comment. Throws InputError with file `name`.
MaterialFile read_sopra_nk(std::string_view text, const std::string& name);

/// Whether a text is SOPRA's database as handed out for other programs: fields that end in *, the
/// first of which is VERSION.
bool is_sopra_mat(std::string_view text);

/// Its material: lines DATA1*number*nm*n*k*, as many as POINTS says. Throws InputError with file
/// `name` and "line:column".
MaterialFile read_sopra_mat(std::string_view text, const std::string& name);

}  // namespace irido::schemas
