#include "core/colorimetry/sensitivity_transform.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/colorimetry/illuminant.hpp"
#include "core/error.hpp"
#include "core/math/random.hpp"
#include "tests/oracle/color_oracle.hpp"

using namespace irido;

namespace {

const Sensitivity& d65() {
    static const Sensitivity sensitivity(observer(2), illuminant("D65"));
    return sensitivity;
}

/// By the oracle's own quadrature of the tables, on pieces over which the phase changes by a
/// radian.
ComplexTriple brute(double opd_nm, double variance_nm2, std::string_view light) {
    const auto part = [&](bool sine) {
        return oracle::integrate(
            [&](double nm) {
                const double angle = 2 * std::numbers::pi * opd_nm / nm;
                const double damping =
                    std::exp(-2 * std::pow(std::numbers::pi / nm, 2) * variance_nm2);
                return damping * (sine ? std::sin(angle) : std::cos(angle));
            },
            observer(2), illuminant(light), {}, 1e-11, std::min(1.0, 2e4 / (opd_nm + 1)));
    };
    const Triple re = part(false), im = part(true);
    return {Complex(re[0], im[0]), Complex(re[1], im[1]), Complex(re[2], im[2])};
}

double largest_difference(const ComplexTriple& a, const ComplexTriple& b) {
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
    return largest;
}

double largest(const ComplexTriple& a) {
    return largest_difference(a, {});
}

}  // namespace

TEST_CASE("sums over the points are the integrals of the tables", "[sensitivity_transform]") {
    for (const std::string_view light : {"D65", "FL2"}) {
        const Sensitivity sensitivity(observer(2), illuminant(light));
        for (const double opd : {0.0, 700.0, 2e4, 4e5}) {
            const SensitivityPoints points = sensitivity_points(sensitivity, opd);
            for (const double variance : {0.0, 3e3}) {
                CAPTURE(light, opd, variance);
                // brute-force sums of 1e5 points have rounding errors of their own
                CHECK(largest_difference(transform_at(points, opd, variance),
                                         brute(opd, variance, light)) < 1e-12);
            }
        }
    }
}

TEST_CASE("the table is the transform within its error", "[sensitivity_transform]") {
    const SensitivityPoints points = sensitivity_points(d65(), 1e5);
    for (const double variance : {0.0, 1e4}) {
        for (const double accuracy : {1e-4, 1e-8, 1e-13}) {
            const SensitivityTransform table(d65(), 1e5, accuracy, variance);
            CHECK(table.error() <= accuracy + 1e-13);
            Random random(3);
            double worst = 0;
            for (int i = 0; i < 300; ++i) {
                const double opd = i == 0             ? 0
                                   : i == 1           ? 1e5
                                   : random.one_in(2) ? random.uniform(0, 1e5)
                                                      : random.uniform(0, 3e3);
                worst = std::max(
                    worst, largest_difference(table(opd), transform_at(points, opd, variance)));
            }
            CAPTURE(variance, accuracy, worst);
            CHECK(worst <= table.error());
        }
    }
}

TEST_CASE("without a path the transform is the white", "[sensitivity_transform]") {
    const ComplexTriple h = SensitivityTransform(d65(), 1e3, 1e-13)(0);
    for (std::size_t c = 0; c < 3; ++c) CHECK(std::abs(h[c] - d65().white()[c]) < 1e-13);
}

TEST_CASE("no value from a path on is above its bound", "[sensitivity_transform]") {
    for (const std::string_view light : {"D65", "FL11", "A"}) {
        const Sensitivity sensitivity(observer(10), illuminant(light));
        for (const double variance : {0.0, 400.0}) {
            const SensitivityTransform table(sensitivity, 2e4, 1e-8, variance);
            const SensitivityPoints points = sensitivity_points(sensitivity, 4e5);
            double before = table.bound(0);
            Random random(9);
            for (double opd = 0; opd < 4e5; opd += random.uniform(0, 4e3)) {
                const double bound = table.bound(opd);
                CAPTURE(light, variance, opd);
                CHECK(bound <= before);
                CHECK(largest(transform_at(points, opd, variance)) <= bound);
                before = bound;
            }
        }
    }
}

// BB17 section 5 calls iridescence negligible where |H| <= 0.05 and gives 25 um; in terms of the
// optical path difference that is 4.2 um with D65 and 4.6 um with the observer alone.
TEST_CASE("fringes are lost where the transform has faded", "[sensitivity_transform]") {
    const auto last_above = [](std::string_view light, double level) {
        const SensitivityTransform table({observer(2), illuminant(light)}, 1e5, 1e-8);
        Triple last_um{};
        for (double opd = 0; opd < 1e5; opd += 20) {
            const ComplexTriple h = table(opd);
            for (std::size_t c = 0; c < 3; ++c)
                if (std::abs(h[c]) > level) last_um[c] = opd / 1000;
        }
        return last_um;
    };
    const auto near = [](const Triple& a, const Triple& b) {
        for (std::size_t c = 0; c < 3; ++c) CHECK(std::abs(a[c] - b[c]) < 0.06);
    };
    near(last_above("E", 0.05), {4.6, 2.85, 3.45});
    near(last_above("E", 1e-2), {6.2, 4.9, 7.25});
    near(last_above("D65", 0.05), {4.2, 2.9, 3.8});
    near(last_above("D65", 1e-2), {6.25, 4.9, 6.3});
}

TEST_CASE("a complex path is an amplitude along the spectrum", "[sensitivity_transform]") {
    const SensitivityTransform table(d65(), 1e4, 1e-10);
    const SensitivityPoints points = sensitivity_points(d65(), 1e4);
    for (const Complex path : {Complex(0, 200), Complex(3000, -250), Complex(-120, 40)}) {
        for (std::size_t c = 0; c < 3; ++c) {
            Complex sum = 0;
            for (std::size_t i = 0; i < points.wavenumber.size(); ++i)
                sum += points.weight[c][i] *
                       std::exp(Complex(0, 2 * std::numbers::pi) * path * points.wavenumber[i]);
            // off the line the polynomials are coarser, and the amplitude reaches exp(4)
            CHECK(std::abs(table.channel(c, path) - sum) < 1e-5);
        }
    }
    CHECK_THROWS_AS(table.channel(0, {100, 251}), DomainError);
}

TEST_CASE("arguments out of range are refused", "[sensitivity_transform]") {
    CHECK_THROWS_AS(SensitivityTransform(d65(), -1, 1e-8), DomainError);
    CHECK_THROWS_AS(SensitivityTransform(d65(), std::nan(""), 1e-8), DomainError);
    CHECK_THROWS_AS(SensitivityTransform(d65(), 1e3, 0), DomainError);
    CHECK_THROWS_AS(SensitivityTransform(d65(), 1e3, 1e-8, -1), DomainError);
    const SensitivityTransform table(d65(), 1e3, 1e-8);
    CHECK_THROWS_AS(table(1001), DomainError);
    CHECK_THROWS_AS(table(-1), DomainError);
    CHECK_THROWS_AS(table(std::nan("")), DomainError);
}
