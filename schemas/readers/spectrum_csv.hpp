#pragma once

#include <string>
#include <string_view>

#include "core/material/material.hpp"

namespace irido::schemas {

/// Reads a spectrum from a table of two columns (column_text.hpp), wavelength and power per unit
/// wavelength: wavelengths in nm or, if the header says so, in um or angstroms, in any order. At
/// least two rows, no negative values, not all zero. Throws InputError with file `name` and
/// "line:column".
Table read_spectrum_csv(std::string_view text, const std::string& name);

}  // namespace irido::schemas
