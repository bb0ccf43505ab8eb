#pragma once

#include <string>
#include <string_view>

#include "schemas/readers/column_text.hpp"
#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// The material in a table of numbers (column_text.hpp): a column of wavelength (nm, um, angstrom),
/// photon energy (eV) or wavenumber (cm-1), and n, k or the permittivity eps1, eps2. The header
/// says which; without one they are nm, n and k. `loss` means k next to n, eps2 next to eps1; -k
/// and -eps2 are those of n - ik. Interpolated linearly in wavelength; k = 0 if not given. Throws
/// InputError with file `name` and "line:column".
MaterialFile read_column_file(std::string_view text, const std::string& name);

/// The material of columns with the given names, whatever the table's own header.
MaterialFile material_of_columns(const ColumnText& table, const std::vector<std::string>& header,
                                 const std::string& name);

/// The column names that read_column_file knows, for messages.
std::string known_columns();

}  // namespace irido::schemas
