#include "core/math/vector_math.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/math/random.hpp"
#include "tests/support/simd_levels.hpp"

using namespace irido;

namespace {

/// Distance to the exact value in units of its last digit as a double.
double ulps(double value, long double exact) {
    int exponent = 0;
    std::frexp(exact, &exponent);
    return static_cast<double>(std::abs(value - exact) / std::ldexp(1.0L, exponent - 53));
}

/// Angles of one magnitude, a quarter of them at doubles next to multiples of pi/2.
std::vector<double> angles(double size) {
    std::vector<double> x;
    Random random(17);
    for (int i = 0; i < 20000; ++i) {
        const double any = random.uniform(-size, size);
        const double quarter = std::numbers::pi / 2;
        x.push_back(i % 4 == 0 ? std::round(any / quarter) * quarter : any);
    }
    x.push_back(0);
    x.push_back(5e-324);
    x.push_back(1e-160);
    return x;
}

}  // namespace

TEST_CASE("sine and cosine are within 1 ulp at every level, from 1e-160 to 1e12 rad") {
    for (const SimdLevel level : tested_vector_levels()) {
        double worst = 0;
        for (const double size : {1e-8, 0.5, 3.0, 1e2, 1e5, 1e7, 1e12}) {
            const std::vector<double> x = angles(size);
            std::vector<double> sine(x.size()), cosine(x.size());
            sin_cos(x, sine, cosine, level);
            for (std::size_t i = 0; i < x.size(); ++i) {
                if (x[i] == 0) {
                    CHECK(sine[i] == 0);
                } else if (std::abs(x[i]) > 1e-300) {
                    worst =
                        std::max(worst, ulps(sine[i], std::sin(static_cast<long double>(x[i]))));
                }
                worst = std::max(worst, ulps(cosine[i], std::cos(static_cast<long double>(x[i]))));
            }
        }
        CAPTURE(name_of(level));
        CHECK(worst < 1);
        CHECK(worst > 0.4);  // checks the error measure itself
    }
}

TEST_CASE("exp(x) - 1 keeps its digits near 0 and saturates at every level") {
    Random random(5);
    std::vector<double> x{0, -1e-300, -1e-17, -0.34, -0.35, -708, -1e6, -1e300};
    for (int i = 0; i < 20000; ++i) x.push_back(-std::pow(10, random.uniform(-20, 3)));
    for (const SimdLevel level : tested_vector_levels()) {
        std::vector<double> out(x.size());
        expm1(x, out, level);
        double worst = 0;
        CHECK(out[0] == 0);
        for (std::size_t i = 1; i < x.size(); ++i)
            worst = std::max(worst, ulps(out[i], std::expm1(static_cast<long double>(x[i]))));
        CAPTURE(name_of(level));
        CHECK(worst < 2);
    }
}

TEST_CASE("multiply-adds converge where their fixed point is") {
    for (const SimdLevel level : tested_levels()) {
        CHECK(lanes(level) >= 1);
        // ten chains x -> x (1 - 2^-20) + 2^-20 from 0.5, summed
        const double after = multiply_adds(200'000'000 / 10, level);
        CHECK(after > 9);
        CHECK(after < 10);
    }
}
