#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace irido::schemas {

/// `text` without spaces, tabs and carriage returns at its ends.
std::string_view trimmed(std::string_view text);

/// The finite number spelt by all of `text`, independent of the locale: "1.5", ".5", "+2", "1E-03".
/// -0 is 0. Empty for an empty text, trailing characters ("1.80-17"), inf, nan, and values beyond a
/// double's range.
std::optional<double> parse_number(std::string_view text);

/// `text` in single quotes for a message: at most 40 bytes of it, without control characters.
std::string in_quotes(std::string_view text);

}  // namespace irido::schemas
