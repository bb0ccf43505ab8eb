#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace irido::cli {

/// An error in the command line; the text is the whole message.
struct UsageError : Error {
    using Error::Error;
};

/// Splits "a,b" at its commas; empty parts are kept.
std::vector<std::string_view> comma_separated(std::string_view text);

/// Parses a LIST: v | start:stop:step | start:stop/count, joined by commas. The stop of
/// start:stop:step is included if it lies on the grid; decimals are exact as written (0:1:0.1
/// contains 0.3, not 0.30000000000000004). Throws UsageError.
/// option           name of the option, for errors
/// text             the LIST as given
/// lowest, highest  closed range of every value, in the option's unit
std::vector<double> parse_list(std::string_view option, std::string_view text, double lowest,
                               double highest);

/// Parse a single number, or a single whole number. Throw UsageError.
/// option           name of the option, for errors
/// text             as given; any LIST with one value
/// lowest, highest  closed range of the value, in the option's unit
double parse_one_number(std::string_view option, std::string_view text, double lowest,
                        double highest);
std::uint64_t parse_whole_number(std::string_view option, std::string_view text, double lowest,
                                 double highest);

/// Parses LO:HI, where LO must not exceed HI. Throws UsageError.
/// option           name of the option, for errors
/// text             as given
/// lowest, highest  closed range of both, in the option's unit
std::pair<double, double> parse_range(std::string_view option, std::string_view text, double lowest,
                                      double highest);

}  // namespace irido::cli
