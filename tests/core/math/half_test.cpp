#include "core/math/half.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace irido;

TEST_CASE("every binary16 comes back from the double that it stands for", "[math]") {
    std::size_t wrong = 0;
    for (unsigned bits = 0; bits <= 0xFFFF; ++bits) {
        const double value = half_value(static_cast<std::uint16_t>(bits));
        if (std::isnan(value)) {
            wrong += (bits & 0x7C00U) == 0x7C00U && (bits & 0x3FFU) != 0 ? 0 : 1;
        } else {
            wrong += half_bits(value) == bits && rounded_to_half(value) == value ? 0 : 1;
        }
    }
    CHECK(wrong == 0);
    CHECK(half_value(0x3C00) == 1);
    CHECK(half_value(0x7BFF) == 65504);
    CHECK(half_value(0x0001) == 0x1p-24);
    CHECK(half_bits(-2) == 0xC000);
}

TEST_CASE("a double is rounded to the nearest binary16, ties to even", "[math]") {
    CHECK(rounded_to_half(1 + 0x1p-11) == 1);
    CHECK(rounded_to_half(1 + 3 * 0x1p-11) == 1 + 0x1p-9);
    CHECK(rounded_to_half(1 + 0x1p-11 + 0x1p-40) == 1 + 0x1p-10);
    CHECK(rounded_to_half(0x1p-25) == 0);
    CHECK(rounded_to_half(65519) == 65504);
    CHECK(rounded_to_half(65520) == std::numeric_limits<double>::infinity());
    CHECK(std::signbit(rounded_to_half(-0.0)));
}
