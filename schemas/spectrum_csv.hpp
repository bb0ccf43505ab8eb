#pragma once

#include <string>
#include <string_view>

#include "core/material/material.hpp"

namespace irido {

/// The spectrum in a CSV text `nm,value` (csv_rows.hpp): at least two rows, no value negative, not
/// all zero. Throws InputError with file `name` and "line:column".
Table read_spectrum_csv(std::string_view text, const std::string& name);

}  // namespace irido
