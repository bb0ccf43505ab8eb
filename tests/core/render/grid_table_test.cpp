#include "core/render/grid_table.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/math/random.hpp"

using namespace irido;
using Catch::Matchers::WithinAbs;

namespace {

double largest(std::span<const float> a, std::span<const float> b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::max(most, static_cast<double>(std::abs(a[i] - b[i])));
    return most;
}

/// Two channels with `fringes` over the thickness.
GridTable::Function waves(double fringes) {
    return [fringes](double nm, std::span<const double> cosines, std::span<float> values) {
        for (std::size_t i = 0; i < cosines.size(); ++i) {
            const double phase = fringes * 6.28 * nm / 100 * std::sqrt(0.8 + cosines[i]);
            values[2 * i] = static_cast<float>(std::cos(phase));
            values[2 * i + 1] = static_cast<float>(cosines[i] * cosines[i] * std::sin(phase));
        }
    };
}

}  // namespace

TEST_CASE("a table of cubics errs by less than its tolerance", "[render]") {
    Random random(1);
    for (const double tolerance : {1e-1, 1e-2, 1e-3})
        for (const double fringes : {0.1, 1.0, 3.0}) {
            const ShownRange range{0.1, 0.95, 50, 150};
            const GridTable table({.range = range,
                                   .channels = 2,
                                   .tolerance = tolerance,
                                   .most_samples = 1'000'000,
                                   .threads = 2},
                                  waves(fringes), largest);
            REQUIRE(table.is_good());
            CHECK(table.error() <= tolerance);
            std::array<float, 2> exact{}, found{};
            for (int i = 0; i < 5000; ++i) {
                const double cosine = random.uniform(0.1, 0.95), nm = random.uniform(50, 150);
                waves(fringes)(nm, {&cosine, 1}, exact);
                table.lookup(cosine, nm, found);
                REQUIRE(largest(exact, found) <= 1.2 * tolerance);
            }
        }
}

TEST_CASE("a table has no more axes than there is to show", "[render]") {
    const auto plan = [](const ShownRange& range) {
        return GridTable::Plan{
            .range = range, .channels = 2, .tolerance = 1e-3, .most_samples = 10'000};
    };
    const GridTable angles(plan({0, 1, 80, 80}), waves(1), largest);
    CHECK(angles.is_good());
    CHECK(angles.thicknesses() == 1);
    const GridTable one(plan({0.5, 0.5, 80, 80}), waves(1), largest);
    CHECK(one.cosines() == 1);
    std::array<float, 2> exact{}, found{};
    const double cosine = 0.5;
    waves(1)(80, {&cosine, 1}, exact);
    one.lookup(0.5, 80, found);
    CHECK(exact == found);
}

TEST_CASE("a table that would have too many samples is given up", "[render]") {
    const GridTable table(
        {.range = {0, 1, 0, 1e4}, .channels = 2, .tolerance = 1e-4, .most_samples = 2000}, waves(5),
        largest);
    CHECK_FALSE(table.is_good());
    CHECK(table.evaluations() <= 4000);
}
