#include "core/math/philox.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace irido;

// Known answers: kat_vectors of Random123, the authors' own library.
static_assert(philox({0, 0, 0, 0}, {0, 0}) ==
              std::array<std::uint32_t, 4>{0x6627e8d5U, 0xe169c58dU, 0xbc57ac4cU, 0x9b00dbd8U});
static_assert(philox({0xffffffffU, 0xffffffffU, 0xffffffffU, 0xffffffffU},
                     {0xffffffffU, 0xffffffffU}) ==
              std::array<std::uint32_t, 4>{0x408f276dU, 0x41c83b0eU, 0xa20bc7c6U, 0x6d5451fdU});
static_assert(philox({0x243f6a88U, 0x85a308d3U, 0x13198a2eU, 0x03707344U},
                     {0xa4093822U, 0x299f31d0U}) ==
              std::array<std::uint32_t, 4>{0xd16cfe09U, 0x94fdccebU, 0x5001e420U, 0x24126ea1U});
static_assert(unit_number(0xffffffffU, 0xffffffffU) < 1 && unit_number(0U, 0U) > 0);
static_assert(unit_number(0xffffffffU) < 1 && unit_number(0U) > 0);

TEST_CASE("numbers of a counter are uniform, uncorrelated and reproducible", "[philox]") {
    constexpr std::size_t kCount = 100000;
    PhiloxSequence sequence(philox_key(0x123456789abcdefU), {1, 2, 3}),
        other(philox_key(0x123456789abcdefU), {1, 2, 4}), same = sequence;
    double sum = 0, squares = 0, lagged = 0, crossed = 0, before = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
        const double x = sequence.next() - 0.5, y = other.next() - 0.5;
        REQUIRE(same.next() - 0.5 == x);
        sum += x, squares += x * x, lagged += x * before, crossed += x * y;
        before = x;
    }
    // five standard deviations of the means
    const double root = std::sqrt(static_cast<double>(kCount));
    CHECK(std::abs(sum / kCount) < 5 * std::sqrt(1.0 / 12) / root);
    CHECK(std::abs(squares / kCount - 1.0 / 12) < 5 * std::sqrt(1.0 / 180) / root);
    CHECK(std::abs(lagged / kCount) < 5 * (1.0 / 12) / root);
    CHECK(std::abs(crossed / kCount) < 5 * (1.0 / 12) / root);
}
