#pragma once

#include <string>
#include <vector>

#include "tables/records/records.hpp"

namespace irido {

/// Comma-separated values after RFC 4180, but with LF line ends: a header line, then one line a
/// record; texts with commas, quotes or line ends are quoted; numbers in their shortest form.
std::string write_csv(const Records& records);

/// Its header line, and the lines after it.
std::string csv_head(const std::vector<std::string>& names);
std::string csv_rows(const Records& records);

}  // namespace irido
