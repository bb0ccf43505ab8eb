#include "schemas/readers/utf8.hpp"

#include <catch2/catch.hpp>

using namespace irido::schemas;

namespace {

const std::string kReplaced = "\xEF\xBF\xBD";

std::string utf8(char32_t point) {
    const auto byte = [](char32_t value) { return static_cast<char>(value); };
    if (point < 0x80) return {byte(point)};
    const char last = byte(0x80 | (point & 0x3F));
    if (point < 0x800) return {byte(0xC0 | point >> 6U), last};
    const char third = byte(0x80 | (point >> 6U & 0x3F));
    if (point < 0x10000) return {byte(0xE0 | point >> 12U), third, last};
    return {byte(0xF0 | point >> 18U), byte(0x80 | (point >> 12U & 0x3F)), third, last};
}

}  // namespace

TEST_CASE("every code point is read back, but for surrogates", "[schemas][utf8]") {
    std::size_t wrong = 0;
    for (char32_t point = 0; point < 0x110000; ++point) {
        std::size_t at = 0;
        const std::string text = utf8(point);
        const auto read = next_code_point(text, at);
        const bool is_surrogate = point >= 0xD800 && point < 0xE000;
        wrong += is_surrogate ? read.has_value() || at != 1 : read != point || at != text.size();
    }
    CHECK(wrong == 0);
}

TEST_CASE("what no text may hold is replaced, all else stays", "[schemas][utf8]") {
    for (const std::string good :
         {"", "a\tb\r\nc", "\x7F", "TiO\xE2\x82\x82 \xC2\xB5m", "\xF0\x9F\x8C\x88", "]]> & <"}) {
        CHECK(well_formed(good) == good);
        CHECK(is_well_formed(good));
    }
    const std::vector<std::string> bad{
        std::string(1, '\0'), "\x01",      "\x1B", "\x80", "\xC0", "\xFF", "\xE2",
        utf8(0xFFFE),         utf8(0xFFFF)};
    for (const std::string& one : bad) {
        CHECK(well_formed("a" + one + "b") == "a" + kReplaced + "b");
        CHECK_FALSE(is_well_formed(one));
    }
    CHECK(well_formed("\xC0\x80") == kReplaced + kReplaced);                  // NUL in two bytes
    CHECK(well_formed("\xED\xA0\x80") == kReplaced + kReplaced + kReplaced);  // a surrogate
}
