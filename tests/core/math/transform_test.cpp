#include "core/math/transform.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/math/random.hpp"

using namespace irido;

namespace {

Complex direct_sum(const std::vector<double>& turns, const std::vector<double>& weights,
                   std::size_t k) {
    long double re = 0, im = 0;
    for (std::size_t i = 0; i < turns.size(); ++i) {
        const long double turn = static_cast<long double>(turns[i]) * static_cast<long double>(k);
        const long double angle = 2 * std::numbers::pi_v<long double> * (turn - std::round(turn));
        re += weights[i] * std::cos(angle);
        im += weights[i] * std::sin(angle);
    }
    return {static_cast<double>(re), static_cast<double>(im)};
}

}  // namespace

TEST_CASE("sums over scattered points are those of the definition", "[transform]") {
    Random random(5);
    for (const std::size_t count : {1U, 2U, 37U, 2500U}) {
        std::vector<double> turns{-0.5, 0.5, 0, 1e-9};  // including the ends of the range
        while (turns.size() < 301) turns.push_back(random.uniform(-0.5, 0.5));
        std::vector<std::vector<double>> weights(2);
        std::vector<double> size(2, 0.0);
        for (std::size_t i = 0; i < turns.size(); ++i) {
            weights[0].push_back(random.uniform(0, 1));
            weights[1].push_back(random.uniform(-1, 1));
            for (std::size_t c = 0; c < 2; ++c) size[c] += std::abs(weights[c][i]);
        }
        const auto sums = transform_of_points(turns, weights, count);
        REQUIRE(sums.size() == 2);
        double worst = 0;
        for (std::size_t c = 0; c < 2; ++c) {
            REQUIRE(sums[c].size() == count);
            for (std::size_t k = 0; k < count; k += 1 + count / 100)
                worst = std::max(worst,
                                 std::abs(sums[c][k] - direct_sum(turns, weights[c], k)) / size[c]);
        }
        CAPTURE(count, worst);
        CHECK(worst < 1e-13);  // as documented
    }
}

TEST_CASE("a single point is a pure wave and no point is nothing", "[transform]") {
    const std::vector<double> turns{0.3}, weight{2};
    const auto sums = transform_of_points(turns, std::span(&weight, 1), 10);
    for (std::size_t k = 0; k < 10; ++k)
        CHECK(std::abs(sums[0][k] -
                       std::polar(2.0, 0.6 * std::numbers::pi * static_cast<double>(k))) < 2e-13);
    const std::vector<double> none;
    CHECK(transform_of_points({}, std::span(&none, 1), 3)[0] == std::vector<Complex>(3, 0.0));
}

TEST_CASE("a point outside its range is refused", "[transform]") {
    const std::vector<double> weight{1};
    for (const double turn : {-0.51, 0.51, std::nan("")})
        CHECK_THROWS_AS(transform_of_points(std::span(&turn, 1), std::span(&weight, 1), 3),
                        DomainError);
}
