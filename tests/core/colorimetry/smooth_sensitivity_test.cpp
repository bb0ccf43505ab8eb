#include "core/colorimetry/smooth_sensitivity.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/sensitivity_transform.hpp"
#include "core/error.hpp"

using namespace irido;

namespace {

/// Midpoint rule over the whole support: with such small tails it is as good as any.
Triple wave_of(const SmoothSensitivity& smooth, double opd_nm) {
    constexpr int kPoints = 20000;
    const auto [low, high] = smooth.reach();
    Triple sum{};
    for (int i = 0; i < kPoints; ++i) {
        const double nu = low + (high - low) * (i + 0.5) / kPoints;
        const Triple s = smooth.at(nu);
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] += s[c] * std::cos(2 * std::numbers::pi * opd_nm * nu) * (high - low) / kPoints;
    }
    return sum;
}

}  // namespace

TEST_CASE("what is left of the sensitivity integrates slow waves as all of it", "[smooth]") {
    const Sensitivity sensitivity(observer(2), illuminant("D65"));
    const SensitivityTransform transform(sensitivity, 1e5, 1e-12);
    const SmoothSensitivity smooth(sensitivity, 128e3);
    CHECK(largest_difference(wave_of(smooth, 0), sensitivity.white()) < 1e-7);
    for (const double opd : {500.0, 3e3, 2e4, 7e4}) {
        const ComplexTriple h = transform(opd);
        // the table's cubics are worst for the fastest waves, which are weak
        CHECK(largest_difference(wave_of(smooth, opd), {h[0].real(), h[1].real(), h[2].real()}) <
              3e-6);
    }
    CHECK(largest_difference(wave_of(smooth, 2e5), {}) < 1e-6);
}

TEST_CASE("no wave of the sensitivity is larger than its bound", "[smooth]") {
    const Sensitivity sensitivity(observer(10), illuminant("A"));
    const SensitivityDecay decay(sensitivity);
    const SensitivityTransform transform(sensitivity, 4e5, 1e-12);
    double before = 2;
    for (double opd = 0; opd < 4e5; opd += 777) {
        const ComplexTriple h = transform(opd);
        const double bound = decay(opd);
        CHECK(bound <= before);
        // tabulated in steps of half a micrometre: the maximum may lie in between
        for (const Complex& channel : h)
            CHECK(std::abs(channel) <= 1.1 * decay(std::max(0.0, opd - 600)) + 1e-13);
        before = bound;
    }
    CHECK(decay(1e9) < decay(1e7));
}

TEST_CASE("smooth sensitivities refuse what they do not have", "[smooth][refused]") {
    const Sensitivity sensitivity(observer(2), illuminant("E"));
    CHECK_THROWS_AS(SmoothSensitivity(sensitivity, 10), DomainError);
    CHECK_THROWS_AS(SmoothSensitivity(sensitivity, NAN), DomainError);
    const SmoothSensitivity smooth(sensitivity, 64e3);
    CHECK_THROWS_AS(smooth.at(1 / 200.0), DomainError);
    CHECK_THROWS_AS(smooth.at(NAN), DomainError);
}
