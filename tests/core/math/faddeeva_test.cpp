#include "core/math/faddeeva.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/gauss.hpp"
#include "core/math/random.hpp"

using namespace irido;

namespace {

using LongComplex = std::complex<long double>;

/// w(z) = pi^(-1/2) int_0^inf exp(-s^2/4 + i z s) ds by a Gauss rule on short panels.
LongComplex integrated(const Complex& z) {
    const LongComplex iz(-z.imag(), z.real());
    constexpr int kPanels = 80;
    constexpr long double kHalf = 20.0L / kPanels / 2;
    LongComplex sum = 0;
    for (int panel = 0; panel < kPanels; ++panel)
        for (const GaussNode& node : gauss_legendre<16>()) {
            const long double s = kHalf * (2 * panel + 1 + static_cast<long double>(node.x));
            sum += static_cast<long double>(node.weight) * std::exp(iz * s - s * s / 4);
        }
    return sum * kHalf / std::sqrt(std::numbers::pi_v<long double>);
}

}  // namespace

TEST_CASE("the Faddeeva function agrees with its integral", "[faddeeva]") {
    Random random(3);
    double worst = 0;
    for (int i = 0; i < 120; ++i) {
        // limited so that the integral itself has 16 digits
        const Complex z(random.uniform(-7, 7),
                        i % 3 ? random.uniform(0, 7) : random.log_uniform(1e-9, 7));
        const LongComplex exact = integrated(z), value(faddeeva(z));
        worst = std::max(worst, static_cast<double>(std::abs(value - exact) / std::abs(exact)));
    }
    CHECK(worst * 1e14 < 0.5);
}

TEST_CASE("the Faddeeva function has its values on the axes, its limits and its symmetry",
          "[faddeeva]") {
    CHECK(std::abs(faddeeva(0) - 1.0) < 1e-15);
    for (const double y : {1e-8, 0.1, 0.7, 2.0, 5.0, 6.2, 9.0, 20.0}) {
        const double exact = static_cast<double>(std::exp(static_cast<long double>(y) * y) *
                                                 std::erfc(static_cast<long double>(y)));
        CHECK(std::abs(faddeeva({0, y}) - exact) < 1e-14 * exact);
    }
    for (const double x : {0.3, 1.0, 2.5, 5.9, 11.0})
        CHECK(std::abs(faddeeva({x, 0}).real() - std::exp(-x * x)) < 1e-15);
    for (const double r : {30.0, 1e4, 9e6, 1.1e7, 1e150, 1e300})
        for (const double turn : {0.0, 0.2, 0.25, 0.4, 0.5}) {
            const Complex z = std::polar(r, kPi * turn);
            const Complex w = faddeeva({z.real(), std::abs(z.imag())});
            const Complex expected =
                Complex(0, 1 / std::sqrt(kPi)) / z * (1.0 + 0.5 / z / z + 0.75 / z / z / z / z);
            CHECK(std::abs(w - expected) < 1e-8 * std::abs(expected));
        }
    Random random(4);
    for (int i = 0; i < 1000; ++i) {
        const Complex z(random.uniform(0, 12), random.uniform(0, 12));
        CHECK(faddeeva(-std::conj(z)) == std::conj(faddeeva(z)));
        CHECK(std::abs(faddeeva(z)) <= 1);
    }
    CHECK(faddeeva({kInfinity, 0}) == 0.0);
    CHECK_THROWS_AS(faddeeva({1, -1e-300}), DomainError);
    CHECK_THROWS_AS(faddeeva({std::nan(""), 1}), DomainError);
}
