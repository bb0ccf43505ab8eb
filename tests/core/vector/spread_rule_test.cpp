#include "core/vector/spread_rule.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/complex.hpp"
#include "core/math/random.hpp"

using namespace irido;
using Catch::WithinAbs;

namespace {

/// The largest function of a phase with coefficients of this ratio.
double value_at(double phase, double ratio) {
    double sum = 0, size = 2 / std::numbers::pi;
    for (int k = 1; size > 1e-17; ++k, size *= ratio) sum += size * std::cos(k * phase);
    return sum;
}

/// Its mean, or that of its first harmonics.
double mean_at(double phase, double ratio, double sigma, std::size_t most = 100000) {
    double sum = 0, size = 2 / std::numbers::pi;
    for (std::size_t k = 1; k <= most && size > 1e-17; ++k, size *= ratio) {
        const double x = static_cast<double>(k) * sigma;
        sum += size * std::exp(-x * x / 2) * std::cos(static_cast<double>(k) * phase);
    }
    return sum;
}

double mean_by(const SpreadRule& rule, double phase, double ratio, double sigma) {
    double mean = 0;
    if (rule.by_thickness) {
        for (const HermiteNode& node : hermite_nodes(rule.count)) {
            mean += node.weight * value_at(phase + node.x * sigma, ratio);
            if (node.x > 0) mean += node.weight * value_at(phase - node.x * sigma, ratio);
        }
        return mean;
    }
    const auto count = static_cast<double>(rule.count);
    for (std::size_t j = 0; j < rule.count; ++j) {
        const double off = 2 * std::numbers::pi * static_cast<double>(j) / count;
        double weight = 1;
        for (std::size_t k = 1; k <= rule.count / 2; ++k) {
            const double x = static_cast<double>(k) * sigma;
            weight += 2 * std::exp(-x * x / 2) * std::cos(static_cast<double>(k) * off);
        }
        mean += weight / count * value_at(phase + off, ratio);
    }
    return mean;
}

struct Case {
    double ratio, sigma, error, phase;
};
Case random_case(Random& random) {
    return {random.uniform(0, 0.6), random.log_uniform(1e-3, 8), random.log_uniform(1e-10, 1e-2),
            random.uniform(0, 6.3)};
}

}  // namespace

TEST_CASE("Gauss and Hermite's nodes integrate powers", "[vector]") {
    for (std::size_t count = 1; count <= kMostHermiteNodes; ++count) {
        double moment = 1;  // of a standard normal deviation
        for (std::size_t power = 0; power < 2 * count; power += 2) {
            double sum = 0, nodes = 0;
            for (const HermiteNode& node : hermite_nodes(count)) {
                const double times = node.x > 0 ? 2 : 1;
                sum += times * node.weight * std::pow(node.x, static_cast<double>(power));
                nodes += times;
            }
            INFO(count << " nodes, power " << power);
            CHECK(nodes == static_cast<double>(count));
            CHECK_THAT(sum / moment, WithinAbs(1, 1e-12));
            moment *= static_cast<double>(power + 1);
        }
    }
}

TEST_CASE("rules for spread phases keep their error, and are no finer than they must", "[vector]") {
    Random random(31);
    int by_thickness = 0, by_phase = 0;
    for (int i = 0; i < 600; ++i) {
        const Case c = random_case(random);
        INFO(c.ratio << " " << c.sigma << " " << c.error << " " << c.phase);
        const SpreadPhase phase{c.ratio, c.sigma, c.sigma};
        const auto rule = spread_rule(phase, c.error);
        REQUIRE(rule);
        const double exact = mean_at(c.phase, c.ratio, c.sigma);
        CHECK_THAT(mean_by(*rule, c.phase, c.ratio, c.sigma), WithinAbs(exact, c.error + 1e-13));
        (rule->by_thickness ? by_thickness : by_phase) += 1;
        const auto loose = spread_rule(phase, 100 * c.error);
        REQUIRE(loose);
        CHECK(loose->count <= rule->count);
        CHECK(spread_rule({c.ratio, c.sigma / 2, c.sigma}, c.error)->count >= rule->count);
    }
    CHECK(by_thickness > 100);
    CHECK(by_phase > 100);
    CHECK_FALSE(spread_rule({0.999, 0.2, 0.2}, 1e-9));
}

TEST_CASE("series over spread phases have the terms that their error needs", "[vector]") {
    Random random(32);
    for (int i = 0; i < 600; ++i) {
        const Case c = random_case(random);
        const auto terms = series_terms({c.ratio, c.sigma, c.sigma}, c.error);
        INFO(c.ratio << " " << c.sigma << " " << c.error);
        REQUIRE(terms);
        const double exact = mean_at(0, c.ratio, c.sigma);
        CHECK(exact - mean_at(0, c.ratio, c.sigma, *terms) <= c.error);
        if (*terms > 1) CHECK(exact - mean_at(0, c.ratio, c.sigma, *terms - 1) > 0.3 * c.error);
    }
    CHECK_FALSE(series_terms({0.999, 1e-3, 1e-3}, 1e-9));
}

TEST_CASE("rules for spread layers that absorb keep their error", "[vector]") {
    Random random(33);
    int found = 0;
    for (int i = 0; i < 400; ++i) {
        const Case c = random_case(random);
        const double loss = c.sigma * random.log_uniform(1e-5, 3);
        const double depth = random.uniform(5, 12);
        const double wave = std::exp(-loss * depth);
        const auto rule =
            lossy_spread_rule({c.ratio, c.sigma, c.sigma, loss, wave, depth}, c.error);
        if (!rule) continue;
        ++found;
        INFO(c.ratio << " " << c.sigma << " " << loss << " " << depth << " " << c.error);
        REQUIRE(rule->by_thickness);
        // R of r = z/(1 - ratio z), and T of |t|^2 = |z|/|1 - ratio z|^2, by equal steps and by the
        // rule
        const auto values_at = [&](double x) {
            const Complex z = std::exp(Complex(-loss * (depth + x), c.phase + c.sigma * x));
            const double inverse = 1 / std::norm(1.0 - c.ratio * z);
            return std::array{std::norm(z) * inverse, std::abs(z) * inverse};
        };
        std::array<double, 2> exact{}, mean{};
        double weights = 0;
        constexpr int kSteps = 40000;
        for (int j = 0; j <= kSteps; ++j) {
            const double x = -depth + 2 * depth * j / kSteps, weight = std::exp(-x * x / 2);
            const auto values = values_at(x);
            for (std::size_t k = 0; k < 2; ++k) exact.at(k) += weight * values.at(k);
            weights += weight;
        }
        for (const HermiteNode& node : hermite_nodes(rule->count)) {
            CHECK(node.x <= depth);
            for (const double x : {node.x, -node.x}) {
                const double weight = node.x == 0 ? node.weight / 2 : node.weight;
                const auto values = values_at(x);
                for (std::size_t k = 0; k < 2; ++k) mean.at(k) += weight * values.at(k);
            }
        }
        const double tail = std::exp(-depth * depth / 2);
        for (std::size_t k = 0; k < 2; ++k)
            CHECK_THAT(mean.at(k), WithinAbs(exact.at(k) / weights, c.error + tail));
    }
    CHECK(found > 100);
}
