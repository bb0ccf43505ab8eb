#include "schemas/readers/utf8.hpp"

#include <array>

namespace irido::schemas {

namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

bool is_character(char32_t point) {
    if (point < 0x20) return point == '\t' || point == '\n' || point == '\r';
    return point != 0xFFFE && point != 0xFFFF;
}

}  // namespace

std::optional<char32_t> next_code_point(std::string_view text, std::size_t& at) {
    constexpr std::array<char32_t, 4> kLeast{0, 0x80, 0x800, 0x10000};
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(at++);
    if (first < 0x80) return first;
    const std::size_t more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : 1;
    if (first < 0xC2 || first > 0xF4 || text.size() - at < more) return std::nullopt;
    char32_t point = first & (0x3FU >> more);
    for (std::size_t i = at; i < at + more; ++i) {
        if ((byte(i) & 0xC0U) != 0x80) return std::nullopt;
        point = point << 6U | (byte(i) & 0x3FU);
    }
    const bool is_surrogate = point >= 0xD800 && point < 0xE000;
    if (point < kLeast[more] || point > 0x10FFFF || is_surrogate) return std::nullopt;
    at += more;
    return point;
}

std::string well_formed(std::string_view text) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t from = at;
        const auto point = next_code_point(text, at);
        out += point && is_character(*point) ? text.substr(from, at - from) : kReplacement;
    }
    return out;
}

bool is_well_formed(std::string_view text) {
    return well_formed(text) == text;
}

std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

}  // namespace irido::schemas
