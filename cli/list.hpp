#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace irido {

/// Thrown for what the user typed on the command line; the text is the whole message.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// LIST of the command line: v | start:stop:step | start:stop/count, joined by commas. The stop of
/// start:stop:step is included when it lies on the grid; decimals stay what they look like
/// (0:1:0.1 has 0.3, not 0.30000000000000004). `option` names the option in errors.
/// lowest, highest  the closed range of every value. Throws UsageError.
std::vector<double> parse_list(std::string_view option, std::string_view text, double lowest,
                               double highest);

}  // namespace irido
