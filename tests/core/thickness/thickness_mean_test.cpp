#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/thickness/thickness_mean.hpp"

using namespace irido;
using Catch::WithinAbs;

namespace {

/// (1 - rho^2) / |1 - rho exp(i d)|^2, whose mean is 1 + 2 sum rho^m exp(-m^2 sigma^2/2) cos(m d).
ThicknessFunction poisson(double rho) {
    return [rho](double d, double phase, std::span<double> values) {
        const Complex denominator = 1.0 - rho * std::polar(1.0, d + phase);
        values[0] = (1 - rho) * (1 - rho) / std::norm(denominator);
        return denominator;
    };
}

double poisson_mean(double rho, double mean, double sigma) {
    long double sum = 1;
    for (long m = 1; m < 2000000; ++m) {
        const long double size = 2 * std::pow(static_cast<long double>(rho), m) *
                                 std::exp(-0.5L * m * m * sigma * sigma);
        sum += size * std::cos(static_cast<long double>(m) * mean);
        if (size < 1e-19L) break;
    }
    return static_cast<double>(sum) * (1 - rho) / (1 + rho);
}

double mean_of(const ThicknessFunction& f, const ThicknessSpread& spread) {
    double mean = 0;
    thickness_mean(spread, f, {&mean, 1});
    return mean;
}

}  // namespace

TEST_CASE("means of fringes are geometric series") {
    for (const double rho : {0.01, 0.3, 0.9, 0.999}) {
        for (const double sigma : {0.001, 0.1, 0.5, 0.79, 1.0, 3.0, 8.9, 9.1, 1e3, 1e8}) {
            for (const double centre : {0.0, 0.3, 3.1}) {
                const double mean = centre + 2 * 3.14159265358979 * std::ceil(8 * sigma / 6 + 1);
                CAPTURE(rho, sigma, centre);
                const double exact = poisson_mean(rho, mean, sigma);
                CHECK_THAT(mean_of(poisson(rho), {mean, sigma, 1}),
                           WithinAbs(exact, kThicknessMeanError));
                // with a trace of absorption other methods are used, which must agree
                if (sigma > 1e3 || (rho > 0.9 && sigma > 3)) continue;
                CHECK_THAT(mean_of(poisson(rho), {mean, sigma, {1, 1e-30}}),
                           WithinAbs(exact, kThicknessMeanError));
                CHECK_THAT(mean_of(poisson(rho), {mean, sigma, {1, 1e-30}, true}),
                           WithinAbs(exact, kThicknessMeanError));
            }
        }
    }
}

TEST_CASE("a line of 1e-9 of the spread is found") {
    for (const double width : {1e-3, 1e-6, 1e-9}) {
        for (const double centre : {0.0, 0.777, -2.5}) {
            // a Lorentzian under a Gaussian: width pi density(centre), to (width)^2 and to width
            const auto f = [&](double d, double, std::span<double> values) {
                const Complex denominator(d - 100 - centre, width);
                values[0] = width * width / std::norm(denominator);
                return denominator;
            };
            const double height = std::exp(-centre * centre / 2) / std::sqrt(2 * 3.14159265358979);
            const double mean = mean_of(f, {100, 1, {0, 1e-9}});
            CAPTURE(width, centre);
            CHECK_THAT(mean,
                       WithinAbs(3.14159265358979 * width * height, 2 * width * width + 1e-15));
        }
    }
}

TEST_CASE("a Gaussian is cut at zero") {
    // mean of exp(-g d) over a half Gaussian: exp(g^2/2) erfc(g/sqrt 2)
    for (const double g : {1e-3, 0.5, 3.0}) {
        const auto f = [&](double d, double, std::span<double> values) {
            CHECK(d >= 0);
            values[0] = std::exp(-g * d);
            return Complex(1);
        };
        CHECK_THAT(mean_of(f, {0, 1, {0, g}}),
                   WithinAbs(std::exp(g * g / 2) * std::erfc(g / std::sqrt(2.0)), 1e-13));
    }
}

TEST_CASE("a pole at a real thickness has no mean") {
    const auto f = [](double d, double, std::span<double> values) {
        const Complex denominator(d - 100.3, 0);
        values[0] = 1 / std::norm(denominator);
        return denominator;
    };
    CHECK_THROWS_AS(mean_of(f, {100, 1, {0, -1}}), DomainError);
}
