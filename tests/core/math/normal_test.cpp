#include "core/math/normal.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.hpp"
#include "core/math/philox.hpp"

using namespace irido;

namespace {

/// Tail probability of the standard normal distribution, for either tail.
double tail(double x) {
    return 0.5 * std::erfc(x / std::sqrt(2.0));
}

}  // namespace

TEST_CASE("normal quantiles have their cumulative probability", "[math]") {
    double worst = 0;
    for (int i = 1; i < 4000; ++i) {
        const double p = i / 8000.0;
        const double x = normal_quantile(p);
        // the change of p for one ulp of x
        worst = std::max(worst, std::abs(tail(-x) - p) / p / (1 + x * x));
        CHECK(normal_quantile(1 - p) == Approx(-x).epsilon(1e-13).margin(1e-15));
    }
    for (double p = 1e-300; p < 1e-3; p *= 1.7) {
        const double x = normal_quantile(p);
        worst = std::max(worst, std::abs(tail(-x) - p) / p / (1 + x * x));
    }
    CHECK(worst < 2e-15);
    CHECK(normal_quantile(0.5) == 0);
    CHECK(normal_quantile(0.975) == Approx(1.959963984540054).epsilon(1e-15));
    for (const double p : {0.0, 1.0, -1.0, 2.0, std::nan("")})
        CHECK_THROWS_AS(normal_quantile(p), DomainError);
}

TEST_CASE("normal deviates are symmetric and have the moments of the distribution", "[math]") {
    CHECK(normal_deviate(0) == -normal_deviate(~std::uint64_t{0}));
    CHECK(normal_deviate(0) == Approx(-8.2095361516013856).epsilon(1e-14));
    constexpr int kCount = 200'000;
    double sums[4] = {};
    for (int i = 0; i < kCount; ++i) {
        const auto words = philox({static_cast<std::uint32_t>(i), 0, 0, 0}, {7, 0});
        const double x = normal_deviate(std::uint64_t{words[1]} << 32 | words[0]);
        double power = 1;
        for (double& sum : sums) sum += (power *= x);
    }
    const double unit = std::sqrt(1.0 / kCount);
    CHECK(std::abs(sums[0] / kCount) < 4 * unit);
    CHECK(std::abs(sums[1] / kCount - 1) < 4 * std::sqrt(2.0) * unit);
    CHECK(std::abs(sums[2] / kCount) < 4 * std::sqrt(15.0) * unit);
    CHECK(std::abs(sums[3] / kCount - 3) < 4 * std::sqrt(96.0) * unit);
}
