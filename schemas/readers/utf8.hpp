#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace irido::schemas {

/// The code point at text[at], and `at` moves behind it; nothing, and `at` moves by one byte, where
/// the bytes are not UTF-8. Source: RFC 3629.
std::optional<char32_t> next_code_point(std::string_view text, std::size_t& at);

/// Text that every format can carry: what is not UTF-8 and what XML 1.0 has no character for
/// (control characters but tab and line ends, U+FFFE, U+FFFF) becomes U+FFFD.
std::string well_formed(std::string_view text);

/// What is said of a text of which is_well_formed() is not true.
inline constexpr const char* kNoText = "must be UTF-8 without control characters";

/// Whether well_formed() changes nothing.
bool is_well_formed(std::string_view text);

/// The text after the byte order mark that it may begin with.
std::string_view without_byte_order_mark(std::string_view text);

}  // namespace irido::schemas
