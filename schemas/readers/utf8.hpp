#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace irido::schemas {

/// Decodes the code point at text[at] and moves `at` past it; where the bytes are not UTF-8,
/// returns nothing and moves `at` by one byte. Source: RFC 3629.
std::optional<char32_t> next_code_point(std::string_view text, std::size_t& at);

/// Text that every format can carry: invalid UTF-8, and characters that XML 1.0 does not allow
/// (control characters except tab and line ends, U+FFFE, U+FFFF), become U+FFFD.
std::string well_formed(std::string_view text);

/// The message for a text that is not well-formed.
inline constexpr const char* kNoText = "must be UTF-8 without control characters";

/// Whether well_formed() changes nothing.
bool is_well_formed(std::string_view text);

/// The text without a leading byte order mark.
std::string_view without_byte_order_mark(std::string_view text);

}  // namespace irido::schemas
