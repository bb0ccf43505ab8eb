#pragma once

#include <string>
#include <string_view>

#include "schemas/readers/column_text.hpp"
#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// The material in a table of numbers (column_text.hpp): a column of wavelengths (nm, um,
/// angstrom), of photon energies (eV) or wavenumbers (cm-1), and n, k, or the permittivity eps1,
/// eps2. The header says which; without one they are nm, n and k. `loss` is k beside n and eps2
/// beside eps1; -k and -eps2 are those of n - ik. Interpolated linearly in the wavelength, k = 0 if
/// not given. Throws InputError with file `name` and "line:column".
MaterialFile read_column_file(std::string_view text, const std::string& name);

/// The material of columns of the given names, however the table is headed.
MaterialFile material_of_columns(const ColumnText& table, const std::vector<std::string>& header,
                                 const std::string& name);

/// What columns read_column_file knows, for messages.
std::string known_columns();

}  // namespace irido::schemas
