#include "core/render/noise.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.hpp"
#include "core/math/random.hpp"

using namespace irido;
using Catch::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// Thickness in [0, 1].
ThicknessField unit_field(double scale, std::uint64_t seed, unsigned octaves) {
    return ThicknessField({0, 1, scale, seed, octaves});
}

}  // namespace

// The value printed by Perlin's Java program, as given by Rosetta Code under "Perlin noise".
TEST_CASE("seed 0 is Perlin's improved noise", "[render]") {
    const PerlinNoise noise;
    CHECK(noise(3.14, 42, 7) == 0.13691995878400012);
    CHECK(noise(3.14 + 256, 42 - 512, 7 + 256) == Approx(0.13691995878400012).epsilon(1e-12));
}

// From the definition: gradients at lattice points are vectors to the edges of a cube.
TEST_CASE("noise vanishes at whole points and has an edge's slope there", "[render]") {
    Random random(7);
    constexpr double kStep = 1e-5;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const PerlinNoise noise(seed);
        std::array<double, 3> at{}, slope{};
        for (double& x : at) x = std::floor(random.uniform(-1000, 1000));
        CHECK(noise(at[0], at[1], at[2]) == 0);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::array<double, 3> near = at;
            near[axis] += kStep;
            slope[axis] = noise(near[0], near[1], near[2]) / kStep;
        }
        std::ranges::sort(slope, {}, [](double x) { return std::abs(x); });
        CHECK_THAT(slope[0], WithinAbs(0, 1e-8));
        CHECK_THAT(std::abs(slope[1]), WithinAbs(1, 1e-8));
        CHECK_THAT(std::abs(slope[2]), WithinAbs(1, 1e-8));
    }
}

TEST_CASE("noise is smooth across cells and stays in its range", "[render]") {
    Random random(3);
    const PerlinNoise noise(5);
    double least = 0, most = 0;
    for (int i = 0; i < 200'000; ++i) {
        const double y = random.uniform(-50, 50), z = random.uniform(-50, 50);
        const double value = noise(random.uniform(-50, 50), y, z);
        least = std::min(least, value);
        most = std::max(most, value);
        if (i % 100 != 0) continue;
        const double cell = std::floor(random.uniform(-50, 50)), h = 1e-6;
        const double before = noise(cell - h, y, z), on = noise(cell, y, z);
        CHECK_THAT(noise(cell + h, y, z) - on, WithinAbs(on - before, 1e-10));
    }
    CHECK(least >= -1.04);
    CHECK(most <= 1.04);
    CHECK(least < -0.7);
    CHECK(most > 0.7);
}

TEST_CASE("thickness is linear in the noise; octaves double frequency, halve weight", "[render]") {
    Random random(11);
    const PerlinNoise noise(9);
    for (int i = 0; i < 1000; ++i) {
        const double x = random.uniform(-1, 1), y = random.uniform(-1, 1),
                     z = random.uniform(-1, 1);
        const auto n = [&](double f) { return noise(f * x, f * y, f * z); };
        const double one = ThicknessField({100, 800, 3, 9, 1})(x, y, z);
        CHECK_THAT(one, WithinRel(100 + 700 * (0.5 + 0.5 * n(3)), 1e-14));
        const double three = unit_field(3, 9, 3)(x, y, z);
        CHECK_THAT(three, WithinAbs(0.5 + 0.5 * (n(3) + n(6) / 2 + n(12) / 4) / 1.75, 1e-14));
    }
}

TEST_CASE("thickness stays between its ends, seeds differ, a scale of 0 is flat", "[render]") {
    Random random(1);
    const ThicknessField field({200, 300, 40, 1, 1}), other({200, 300, 40, 2, 1});
    double difference = 0;
    for (int i = 0; i < 20'000; ++i) {
        const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
        const double value = field(x, y, 0.3);
        if (value < 200 || value > 300) FAIL(value);
        difference = std::max(difference, std::abs(value - other(x, y, 0.3)));
    }
    CHECK(difference > 50);
    CHECK(unit_field(0, 4, 5)(0.3, 0.2, 0.1) == 0.5);
    CHECK(ThicknessField({250, 250, 4, 4, 2})(0.3, 0.2, 0.1) == 250);
}

TEST_CASE("noise out of its ranges is refused", "[render]") {
    const auto make = [](double low, double high, double scale, unsigned octaves) {
        return ThicknessField({low, high, scale, 0, octaves});
    };
    CHECK_THROWS_WITH(make(-1, 5, 1, 1), Contains("least thickness_nm must be in [0, 1e+09]"));
    CHECK_THROWS_WITH(make(5, 4, 1, 1), Contains("largest thickness_nm must be in [5, "));
    CHECK_THROWS_AS(make(0, 2e9, 1, 1), DomainError);
    CHECK_THROWS_WITH(make(0, 1, -1, 1), Contains("noise scale must be in [0, 1e+06]"));
    CHECK_THROWS_WITH(make(0, 1, 1, 0), Contains("octaves must be in [1, 16] (got 0)"));
    CHECK_THROWS_AS(make(0, 1, 1, 17), DomainError);
}
