#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace irido::cli {

/// An error of the command line; the text is the whole message.
struct UsageError : Error {
    using Error::Error;
};

/// The parts between the commas of "a,b", empty ones included.
std::vector<std::string_view> comma_separated(std::string_view text);

/// The values of a LIST: v | start:stop:step | start:stop/count, joined by commas. The stop of
/// start:stop:step is included when it lies on the grid; decimals are exact as typed (0:1:0.1
/// contains 0.3, not 0.30000000000000004). Throws UsageError.
/// option           the option's name in errors
/// text             the LIST as typed
/// lowest, highest  closed range of every value, in the option's unit
std::vector<double> parse_list(std::string_view option, std::string_view text, double lowest,
                               double highest);

/// A single number, or a single whole number. Throws UsageError.
/// option           the option's name in errors
/// text             as typed; any LIST with one value
/// lowest, highest  closed range of the value, in the option's unit
double parse_one_number(std::string_view option, std::string_view text, double lowest,
                        double highest);
std::uint64_t parse_whole_number(std::string_view option, std::string_view text, double lowest,
                                 double highest);

/// Both ends of FIRST:LAST, FIRST not above LAST. Throws UsageError.
/// option           the option's name in errors
/// text             as typed
/// lowest, highest  closed range of both, in the option's unit
std::pair<double, double> parse_range(std::string_view option, std::string_view text, double lowest,
                                      double highest);

}  // namespace irido::cli
