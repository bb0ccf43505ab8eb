#pragma once

#include <string_view>
#include <vector>

namespace irido::schemas {

/// The values of a LIST: v | start:stop:step | start:stop/count, joined by commas. The stop of
/// start:stop:step is included if it lies on the grid; decimals are exact as written (0:1:0.1
/// contains 0.3, not 0.30000000000000004). Throws InputError("", "", words).
std::vector<double> read_number_list(std::string_view text);

/// The parts between the commas of "a,b", empty ones included.
std::vector<std::string_view> comma_separated(std::string_view text);

}  // namespace irido::schemas
