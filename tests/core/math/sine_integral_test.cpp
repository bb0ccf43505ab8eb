#include "core/math/sine_integral.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/random.hpp"

using namespace irido;
using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>>;

namespace {

/// Si and F from their power series, which lose x/2.3 of 100 digits.
struct SineSeries {
    Wide si, f;
};
SineSeries sine_series(double at) {
    const Wide x = at;
    Wide odd = x, even = x * x / 2, si = x, f = x / 2;  // x^(2k+1)/(2k+1)!, x^(2k+2)/(2k+2)!
    for (int k = 1; k < 400; ++k) {
        odd *= -x * x / (2 * k * (2 * k + 1));
        even *= -x * x / ((2 * k + 1) * (2 * k + 2));
        si += odd / (2 * k + 1);
        f += even / (x * (2 * k + 1));
    }
    return {si, f};
}
double relative(double value, const Wide& exact) {
    return std::abs(static_cast<double>((Wide(value) - exact) / exact));
}

}  // namespace

TEST_CASE("the sine integral and the slit's agree with 60 digits", "[sine-integral]") {
    Random random(5);
    double worst_si = 0, worst_f = 0, worst_difference = 0;
    for (int i = 0; i < 600; ++i) {
        const double x = i % 2 ? random.uniform(0, 80) : random.log_uniform(1e-6, 80);
        const SineSeries exact = sine_series(x);
        worst_si = std::max(worst_si, relative(sine_integral(x), exact.si));
        worst_f = std::max(worst_f, relative(slit_integral(x), exact.f));
        CHECK(slit_integral(-x) == -slit_integral(x));
        const double to = x + (i % 3 ? random.log_uniform(1e-9, 30) : random.uniform(-20, 20));
        const Wide difference = (to < 0 ? Wide(-sine_series(-to).f) : sine_series(to).f) - exact.f;
        const double scale = std::min(1.0, 4 / (x * x)) * std::abs(to - x) / 2 +
                             std::abs(static_cast<double>(difference));
        worst_difference = std::max(
            worst_difference,
            std::abs(static_cast<double>(Wide(slit_integral(x, to)) - difference)) / scale);
    }
    CHECK(worst_si * 1e16 < 5);
    CHECK(worst_f * 1e16 < 5);
    CHECK(worst_difference * 1e15 < 3);
}

TEST_CASE("far out the sine integral meets its limits", "[sine-integral]") {
    CHECK(sine_integral(kInfinity) == kPi / 2);
    CHECK(slit_integral(-kInfinity) == -kPi / 2);
    CHECK(slit_integral(0) == 0);
    CHECK(slit_integral(-kInfinity, kInfinity) == kPi);
    CHECK(std::abs(slit_integral(1e6, kInfinity) - 1e-6) < 1e-12);
    CHECK(std::abs(sine_integral(1e9) - kPi / 2) < 2e-9);
    // both sides of the seams between methods
    for (const double x : {4.0, 40.0}) {
        const double below = std::nextafter(x, 0);
        CHECK(std::abs(slit_integral(x) - slit_integral(below)) < 1e-15);
        CHECK(std::abs(sine_integral(x) - sine_integral(below)) < 1e-15);
    }
    CHECK_THROWS_AS(auxiliary_sine(3.9), DomainError);
    CHECK_THROWS_AS(auxiliary_sine(std::nan("")), DomainError);
}
