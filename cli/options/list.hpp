#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace irido::cli {

/// Thrown for what the user typed on the command line; the text is the whole message.
struct UsageError : Error {
    using Error::Error;
};

/// The parts of "a,b": one more than there are commas, empty ones among them.
std::vector<std::string_view> comma_separated(std::string_view text);

/// LIST of the command line: v | start:stop:step | start:stop/count, joined by commas. The stop of
/// start:stop:step is included when it lies on the grid; decimals stay what they look like
/// (0:1:0.1 has 0.3, not 0.30000000000000004). `option` names the option in errors.
/// lowest, highest  the closed range of every value. Throws UsageError.
std::vector<double> parse_list(std::string_view option, std::string_view text, double lowest,
                               double highest);

/// One number, or one whole number, in the closed range. Throws UsageError.
double parse_one_number(std::string_view option, std::string_view text, double lowest,
                        double highest);
std::uint64_t parse_whole_number(std::string_view option, std::string_view text, double lowest,
                                 double highest);

}  // namespace irido::cli
