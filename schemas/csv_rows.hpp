#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/material/material.hpp"

namespace irido {

/// A wavelength and the values at it.
struct CsvRow {
    std::string place;  ///< "line:column" of the last number
    std::vector<double> values;
};

/// Rows of a table by wavelength: "nm,value,...". Blank lines, comments from # on, one header line
/// before the first row, CR at line ends and blanks around numbers are allowed.
/// Every row has as many numbers as the first, between `fewest` and `most`; all are finite, and the
/// first, in nm, increases strictly within kAllWavelengths. Throws InputError with file `name` and
/// "line:column", also when there is no row.
std::vector<CsvRow> read_csv_rows(std::string_view text, const std::string& name,
                                  std::size_t fewest, std::size_t most);

/// Column `index` of rows over their first column.
Table table_of(const std::vector<CsvRow>& rows, std::size_t index);

}  // namespace irido
