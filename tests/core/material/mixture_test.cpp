#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.hpp"
#include "core/material/index_series.hpp"
#include "core/material/material.hpp"
#include "core/math/random.hpp"

using namespace irido;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace {

constexpr std::array kRules{MixingRule::bruggeman, MixingRule::maxwell_garnett,
                            MixingRule::lorentz_lorenz, MixingRule::linear, MixingRule::series};

Material constant(Complex index) {
    return {"c", RefractiveIndex{Constant{index.real()}, Constant{index.imag()}}, Outside::refuse};
}

Material mixture(MixingRule rule, double fraction, Material inclusion, Material host) {
    return {"m", Mixture{rule, fraction, {std::move(inclusion), std::move(host)}}, Outside::refuse};
}

Complex mixed(MixingRule rule, double fraction, Complex inclusion, Complex host) {
    return index_at(mixture(rule, fraction, constant(inclusion), constant(host)), 500);
}

/// Residual of Bruggeman's condition, relative to the size of its terms.
double residual(double f, Complex e1, Complex e2, Complex e) {
    const Complex a = f * (e1 - e) * (e2 + 2.0 * e), b = (1 - f) * (e2 - e) * (e1 + 2.0 * e);
    const double size = (std::abs(e1) + std::abs(e)) * (std::abs(e2) + 2 * std::abs(e)) +
                        (std::abs(e2) + std::abs(e)) * (std::abs(e1) + 2 * std::abs(e));
    return std::abs(a + b) / size;
}

Complex random_index(Random& random) {
    return {random.log_uniform(0.05, 5), random.one_in(3) ? 0 : random.log_uniform(1e-4, 8)};
}

}  // namespace

TEST_CASE("an interface of silicon and its oxide", "[material]") {
    // the formula in 40 digits
    const Complex index = mixed(MixingRule::bruggeman, 0.5, {3.88, 0.019}, 1.457);
    CHECK_THAT(index.real(), WithinRel(2.585480831799296, 1e-13));
    CHECK_THAT(index.imag(), WithinRel(0.008585554310679472, 1e-13));
}

TEST_CASE("Bruggeman's root goes from the host to the inclusion without a jump", "[material]") {
    Random random(11);
    for (int pair = 0; pair < 400; ++pair) {
        const Complex n1 = random_index(random), n2 = random_index(random);
        Complex last = n2 * n2;
        constexpr int kSteps = 400;
        double longest = 0;
        for (int i = 0; i <= kSteps; ++i) {
            const double f = static_cast<double>(i) / kSteps;
            const Complex eps = mixed_permittivity(MixingRule::bruggeman, n1, n2, f);
            CHECK(residual(f, n1 * n1, n2 * n2, eps) < 1e-14);
            CHECK(eps.imag() >= -1e-13 * std::abs(eps));
            longest = std::max(longest, std::abs(eps - last));
            last = eps;
        }
        const double size = std::abs(n1 * n1) + std::abs(n2 * n2);
        CHECK(std::abs(last - n1 * n1) < 1e-12 * size);
        CHECK(longest < 0.2 * size);
    }
}

TEST_CASE("mixtures of nothing, of all and of one medium", "[material]") {
    Random random(12);
    for (const MixingRule rule : kRules)
        for (int i = 0; i < 50; ++i) {
            const Complex n1 = random_index(random), n2 = random_index(random);
            CHECK(mixed(rule, 0, n1, n2) == n2);
            CHECK(mixed(rule, 1, n1, n2) == n1);
            const double f = random.uniform(0, 1);
            CHECK(std::abs(mixed(rule, f, n1, n1) - n1) < 1e-13 * std::abs(n1));
            const Complex little = mixed_permittivity(rule, n1, n2, 1e-14);
            CHECK(std::abs(little - n2 * n2) <
                  1e-9 * (std::abs(n1 * n1) + std::abs(n2 * n2)) + 1e-9 * std::abs(n2 * n2));
        }
}

TEST_CASE("mixtures obey their definitions, and lie between walls along and across", "[material]") {
    Random random(13);
    for (int i = 0; i < 300; ++i) {
        const double n1 = random.uniform(1, 4), n2 = random.uniform(1, 4);
        const double e1 = n1 * n1, e2 = n2 * n2, f = random.uniform(0, 1);
        const auto eps = [&](MixingRule rule) {
            return std::pow(mixed(rule, f, n1, n2).real(), 2);
        };
        const auto clausius = [](double e) { return (e - 1) / (e + 2); };
        CHECK_THAT(eps(MixingRule::linear), WithinRel(f * e1 + (1 - f) * e2, 1e-14));
        CHECK_THAT(1 / eps(MixingRule::series), WithinRel(f / e1 + (1 - f) / e2, 1e-14));
        CHECK_THAT(clausius(eps(MixingRule::lorentz_lorenz)),
                   WithinAbs(f * clausius(e1) + (1 - f) * clausius(e2), 1e-14));
        const double garnett = eps(MixingRule::maxwell_garnett);
        CHECK_THAT((garnett - e2) / (garnett + 2 * e2),
                   WithinAbs(f * (e1 - e2) / (e1 + 2 * e2), 1e-14));
        for (const MixingRule rule : {MixingRule::bruggeman, MixingRule::maxwell_garnett}) {
            CHECK(eps(rule) <= eps(MixingRule::linear) * (1 + 1e-14));
            CHECK(eps(rule) >= eps(MixingRule::series) * (1 - 1e-14));
        }
        const double bruggeman = eps(MixingRule::bruggeman);
        const Complex swapped = mixed(MixingRule::bruggeman, 1 - f, n2, n1);
        CHECK_THAT(swapped.real() * swapped.real(), WithinRel(bruggeman, 1e-13));
    }
}

TEST_CASE("a mixture is known where its parts are, and has their kinks", "[material]") {
    const Material table{"t", RefractiveIndex{Table{{400, 500, 700}, {1.5, 1.6, 1.55}}},
                         Outside::refuse};
    const Material mixed = mixture(MixingRule::linear, 0.3, table, constant({2, 0.1}));
    CHECK(range_of(mixed) == WavelengthRange{400, 700});
    CHECK_FALSE(is_constant(mixed));
    CHECK(is_constant(mixture(MixingRule::linear, 0.3, constant(2), constant(3))));
    CHECK(kinks(mixed, {300, 800}) == std::vector<double>{400, 500, 700});
    CHECK(table_rows(mixed, {300, 600}) == std::vector<double>{400, 500});
    CHECK_THROWS_WITH(index_at(mixed, 800), Catch::Contains("t is known from 400 to 700 nm"));
    Material held = mixed, held_part = mixed;
    held.outside = Outside::clamp;
    std::get<Mixture>(held_part.model).parts[0].outside = Outside::clamp;
    CHECK(index_at(held, 800) == index_at(mixed, 700));
    CHECK(index_at(held_part, 800) == index_at(mixed, 700));
    CHECK(range_of(held_part) == kAllWavelengths);
    CHECK(has_rows(mixed));
    CHECK_THROWS_AS(index_at(mixture(MixingRule::linear, 1.5, table, table), 500), DomainError);
}

TEST_CASE("the series of a mixture has its derivatives", "[material]") {
    Material glass{"g", RefractiveIndex{Formula{5, {1.5, 0.01, -2}, kAllWavelengths}},
                   Outside::refuse};
    Material metal{"x", LorentzDrude{1, 8, {{0.8, 0.1, 0}, {0.5, 0.6, 3}}, kAllWavelengths},
                   Outside::refuse};
    for (const MixingRule rule : kRules)
        for (const double nm : {400.0, 633.0, 900.0}) {
            const Material mixed = mixture(rule, 0.3, metal, glass);
            const Series<Complex> series = index_series(mixed, nm);
            CHECK(series[0] == index_at(mixed, nm));
            // x = w/w0 - 1; central differences at two step sizes, extrapolated
            const auto at = [&](double x) { return index_at(mixed, nm / (1 + x)); };
            const auto first = [&](double h) { return (at(h) - at(-h)) / (2 * h); };
            const auto second = [&](double h) {
                return (at(h) - 2.0 * at(0) + at(-h)) / (2 * h * h);
            };
            constexpr double h = 5e-4;
            const Complex d1 = (4.0 * first(h) - first(2 * h)) / 3.0;
            const Complex d2 = (4.0 * second(h) - second(2 * h)) / 3.0;
            CHECK(std::abs(series[1] - d1) < 1e-6 * (1 + std::abs(d1)));
            CHECK(std::abs(series[2] - d2) < 1e-4 * (1 + std::abs(d2)));
        }
}
