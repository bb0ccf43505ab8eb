#pragma once

#include <string>
#include <string_view>

#include "core/material/material.hpp"

namespace irido::schemas {

/// The spectrum in a table of two columns (column_text.hpp), wavelength and power per wavelength:
/// wavelengths in nm, or as the header says in um or angstroms, in any order. At least two rows, no
/// value negative, not all zero. Throws InputError with file `name` and "line:column".
Table read_spectrum_csv(std::string_view text, const std::string& name);

}  // namespace irido::schemas
