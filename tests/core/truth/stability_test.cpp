#include "core/truth/stability.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "core/error.hpp"
#include "core/stack/builder.hpp"
#include "core/truth/reference.hpp"
#include "tests/oracle/random_stacks.hpp"
#include "tests/oracle/stack_oracle.hpp"
#include "tests/support/simd_levels.hpp"

using namespace irido;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace {

Stack one_film(Complex incident, Complex film, double thickness_nm, Complex substrate) {
    StackBuilder b(incident);
    b.add(b.layer(film, thickness_nm));
    return b.over(substrate);
}

Stack bare(Complex incident, Complex substrate) {
    return StackBuilder(incident).over(substrate);
}

/// Rounding error of a closed form in double.
constexpr double kRounding = 4e-16;

constexpr Precision kPrecisions[] = {Precision::double_, Precision::extended, Precision::digits50,
                                     Precision::digits100};

/// |f(1 + h) - f(1 - h)| / 2h, where f scales one number of a stack by its argument.
template <class F>
double slope(F f) {
    constexpr double kStep = 0x1p-20;  // error h^2 = 1e-12
    return std::abs(f(1 + kStep) - f(1 - kStep)) / (2 * kStep);
}

}  // namespace

TEST_CASE("the reference is Fresnel's for a bare interface", "[reference]") {
    for (const Precision precision : kPrecisions) {
        const Power s = reference_power(bare(1, 1.5), 550, 0, Polarization::s, precision);
        CHECK_THAT(s.R, WithinAbs(0.04, kRounding));
        CHECK_THAT(s.T, WithinAbs(0.96, kRounding));
        // 60 degrees: cos 1/2, and n cos(theta2) = sqrt(n^2 - 3/4)
        const double q = std::sqrt(1.5);
        const Power tilted_s = reference_power(bare(1, 1.5), 550, 60, Polarization::s, precision);
        CHECK_THAT(tilted_s.R, WithinAbs(std::pow((0.5 - q) / (0.5 + q), 2), kRounding));
        const Power tilted_p = reference_power(bare(1, 1.5), 550, 60, Polarization::p, precision);
        CHECK_THAT(tilted_p.R, WithinAbs(std::pow((2.25 * 0.5 - q) / (2.25 * 0.5 + q), 2), 1e-15));
        const Power metal =
            reference_power(bare(1, {0.05, 60}), 550, 0, Polarization::p, precision);
        CHECK_THAT(1 - metal.R, WithinRel(4 * 0.05 / (1.05 * 1.05 + 3600), 1e-10));
        CHECK_THAT(metal.T, WithinRel(4 * 0.05 / (1.05 * 1.05 + 3600), 1e-14));
    }
}

TEST_CASE("the reference knows quarter waves, mirrors, and depths", "[reference]") {
    for (const Precision precision : kPrecisions) {
        const auto at_normal = [&](const Stack& stack) {
            return reference_power(stack, 600, 0, Polarization::p, precision);
        };
        // 150 nm of 1: a quarter wave at 600 nm
        CHECK_THAT(at_normal(one_film(1, 1.25, 120, 1.5625)).R, WithinAbs(0, 1e-30));
        const double quarter = std::pow((1.5 - 4) / (1.5 + 4), 2);
        CHECK_THAT(at_normal(one_film(1, 2, 75, 1.5)).R, WithinAbs(quarter, kRounding));
        // N pairs: R = ((1 - 1.5 (2/1.5)^2N) / (1 + ...))^2
        StackBuilder b;
        b.add(StackBuilder::group(10, {b.layer(2, 75), b.layer(1.5, 100)}));
        const double f = 1.5 * std::pow(2 / 1.5, 20);
        CHECK_THAT(at_normal(b.over(1.5)).R, WithinAbs(std::pow((1 - f) / (1 + f), 2), 1e-13));
    }
    // T of a thick absorber on a substrate of the same index: that of its face times exp(-4 pi k
    // d/nm)
    const Complex index{2, 2};
    const double face = reference_power(bare(1, index), 600, 0, Polarization::s).T;
    const double depth =
        reference_power(one_film(1, index, 10000, index), 600, 0, Polarization::s).T;
    const double exponent = 4 * std::acos(-1.0) * 2 * 10000 / 600;
    CHECK_THAT(depth, WithinRel(face * std::exp(-exponent), 1e-13));
    // T = 0 and R = 1 beyond the critical angle, to the last digit
    const Power total = reference_power(bare(1.5, 1), 600, 60, Polarization::s);
    CHECK(total.R == 1);
    CHECK(total.T == 0);
}

TEST_CASE("a billion periods are a product of their digits", "[reference]") {
    StackBuilder grouped, half;
    const auto period = [](StackBuilder& b) {
        return std::vector<Element>{b.layer(2, 60), b.layer(1.5, 94), b.layer({1.7, 1e-14}, 70)};
    };
    grouped.add(StackBuilder::group(1000000000, period(grouped)));
    half.add(StackBuilder::group(333333333, period(half)));
    half.add(StackBuilder::group(666666667, period(half)));
    const Power one = reference_power(grouped.over(1.5), 700, 30, Polarization::p);
    const Power other =
        reference_power(half.over(1.5), 700, 30, Polarization::p, Precision::digits50);
    CHECK_THAT(one.R, WithinAbs(other.R, kRounding));
    CHECK_THAT(one.T, WithinRel(other.T, kRounding));
    CHECK_THAT(one.A, WithinRel(other.A, kRounding));
}

TEST_CASE("precisions agree on tame stacks", "[reference]") {
    Random random(61);
    for (int i = 0; i < 40; ++i) {
        const auto kind = static_cast<oracle::Kind>(static_cast<std::size_t>(i) % oracle::kKinds);
        const Stack stack = oracle::random_stack(kind, random);
        const double nm = random.uniform(400, 750), angle = oracle::random_angle(random);
        CAPTURE(oracle::text_of(stack), nm, angle);
        const auto at = [&](Precision precision) {
            return reference_power(stack, nm, angle, Polarization::p, precision);
        };
        const Power exact = at(Precision::digits100);
        CHECK_THAT(at(Precision::digits50).R, WithinAbs(exact.R, 1e-16));
        CHECK_THAT(at(Precision::digits50).T, WithinRel(exact.T, kRounding));
        CHECK_THAT(at(Precision::extended).R, WithinAbs(exact.R, 1e-14));
        CHECK_THAT(at(Precision::double_).R, WithinAbs(exact.R, 1e-11));
    }
}

TEST_CASE("the reference refuses what has no answer", "[reference]") {
    const Stack stack = bare(1, 1.5);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double angle : {90.0, -1.0, nan})
        CHECK_THROWS_AS(reference_power(stack, 550, angle, Polarization::s), DomainError);
    for (const double nm : {0.5, 2e7, nan}) {
        CHECK_THROWS_AS(reference_power(stack, nm, 0, Polarization::s), DomainError);
        CHECK_THROWS_AS(conditioned_power(stack, nm, 0), DomainError);
    }
}

TEST_CASE("conditions are slopes summed over the inputs", "[reference]") {
    // n, k, d of the film, n, k of the substrate, and d again for the wavelength; n0 and cos(theta)
    // contribute the same amount again
    const auto power = [](double n, double k, double d, double ns, double ks) {
        const Stack stack = one_film(1, {1.7 * n, 0.02 * k}, 230 * d, {2 * ns, 0.5 * ks});
        return reference_power(stack, 550, 30, Polarization::p);
    };
    for (double Power::*const quantity : {&Power::R, &Power::T, &Power::A}) {
        const double sum = slope([&](double f) { return power(f, 1, 1, 1, 1).*quantity; }) +
                           slope([&](double f) { return power(1, f, 1, 1, 1).*quantity; }) +
                           2 * slope([&](double f) { return power(1, 1, f, 1, 1).*quantity; }) +
                           slope([&](double f) { return power(1, 1, 1, f, 1).*quantity; }) +
                           slope([&](double f) { return power(1, 1, 1, 1, f).*quantity; });
        const Condition condition =
            conditioned_power(one_film(1, {1.7, 0.02}, 230, {2, 0.5}), 550, 30)[1].condition;
        const double given = quantity == &Power::R   ? condition.R
                             : quantity == &Power::T ? condition.T
                                                     : condition.A;
        CHECK(given > sum);
        CHECK(given < 3 * sum);
    }
}

TEST_CASE("conditions bound the scatter under shifted inputs, and by not too much", "[reference]") {
    Random random(62);
    for (int i = 0; i < 60; ++i) {
        const Regime& regime = regimes()[static_cast<std::size_t>(i) % regimes().size()];
        if (regime.name == "thousand_layers" || regime.name == "critical") continue;
        const StackCase c = stability_case(regime, random.bits() >> 12);
        CAPTURE(regime.name, oracle::text_of(c.stack), c.wavelength_nm, c.angle_deg);
        const ConditionedPower at = conditioned_power(c.stack, c.wavelength_nm, c.angle_deg)[0];
        const oracle::Scatter scatter =
            oracle::scatter(c.stack, {c.wavelength_nm, c.angle_deg, Polarization::s});
        // second order where the first order is large, and the last digit of a double
        const double linear = at.condition.R * kUnitRoundoff;
        if (linear < 1e-6) CHECK(scatter.R <= 1.01 * linear + kRounding * at.power.R);
        // the condition number looks at larger shifts than half an ulp: at narrow peaks it is
        // larger
        if (regime.name == "band_edge" || regime.name == "resonator") continue;
        if (linear < 1e-6 && linear > 1e-13) CHECK(scatter.R > 1e-4 * linear);
    }
}

TEST_CASE("answers nearby are those of inputs some roundings away", "[reference]") {
    // quarter waves: R is minimal, so no shift reduces it; the flank of a fringe takes any value
    const Stack quarter = one_film(1, 1.25, 120, 1.5625), flank = one_film(1, 2.1, 100000037, 1.5);
    const auto nearby = [](const Stack& stack, double R, double roundings) {
        return is_answer_nearby(stack, 600, 0, Polarization::s, &Power::R, R, roundings);
    };
    CHECK(nearby(quarter, 1e-32, 10));
    CHECK_FALSE(nearby(quarter, 1e-28, 10));
    const ConditionedPower at = conditioned_power(flank, 600, 0)[0];
    const double one = at.condition.R * kUnitRoundoff;
    REQUIRE(one > 1e-11);
    for (const double sign : {-1.0, 1.0}) {
        CHECK(nearby(flank, at.power.R + sign * one, 10));
        CHECK_FALSE(nearby(flank, at.power.R + sign * 11 * one, 10));
    }
    // fringes of 1e9 periods at the edge of a gap: rounding errors span several of them
    StackBuilder b;
    b.add(StackBuilder::group(1000000000, {b.layer(1.9414075972902767, 276.97186290031675),
                                           b.layer(1.571263563779457, 230.45921505710186)}));
    const Stack edge = b.over({2.3390270034281309, 1.8062682845058275});
    const auto at_edge = [&](double T) {
        return is_answer_nearby(edge, 591.98617818459923, 0, Polarization::s, &Power::T, T, 10);
    };
    CHECK(at_edge(3.9e-11));
    CHECK(at_edge(1e-2));
    CHECK_FALSE(at_edge(0.9));  // where sin NK = 0 only the substrate matters, T = 0.62
    CHECK_THROWS_AS(nearby(bare(1, {-1, 0}), 0.5, 10), DomainError);
}

TEST_CASE("every regime has its own name and says what it is", "[stability]") {
    std::set<std::string_view> names;
    for (const Regime& regime : regimes()) {
        CHECK(names.insert(regime.name).second);
        CHECK_FALSE(regime.summary.empty());
        CHECK(find_regime(regime.name)->make == regime.make);
    }
    CHECK(names.size() >= 13);
    CHECK(find_regime("none") == nullptr);
}

TEST_CASE("a case depends on its regime and its seed only", "[stability]") {
    for (const Regime& regime : regimes()) {
        if (regime.name == "thousand_layers") continue;
        CHECK(stability_case(regime, 5).stack == stability_case(regime, 5).stack);
        CHECK(stability_case(regime, 5).wavelength_nm == stability_case(regime, 5).wavelength_nm);
    }
    const Regime& regime = *find_regime("ordinary");
    CHECK_FALSE(stability_case(regime, 5).stack == stability_case(regime, 6).stack);
    const RegimeReport both = measure_stability(regime, 2, 5, {2});
    const RegimeReport first = measure_stability(regime, 1, 5, {1});
    const RegimeReport second = measure_stability(regime, 1, 6, {1});
    CHECK(both.count == 4);
    CHECK(both.R.worst == std::max(first.R.worst, second.R.worst));
    CHECK_THROWS_AS(measure_stability(regime, 0, 1), DomainError);
    CHECK_THROWS_AS(measure_stability(regime, 1000001, 1), DomainError);
}

TEST_CASE("a short sweep of every regime stays within its bounds", "[stability][slow]") {
    for (const SimdLevel kernel : {SimdLevel::plain, best_simd_level()}) {
        for (const Regime& regime : regimes()) {
            const std::uint64_t count = regime.name == "thousand_layers" ? 3 : 20;
            const RegimeReport report = measure_stability(regime, count, 1, {0, kernel});
            CAPTURE(regime.name, name_of(kernel), report.first_seed);
            CHECK(report.first_violation == "");
            CHECK(report.not_finite == 0);
            CHECK(report.negative == 0);
            CHECK(report.excess == 0);
            CHECK(report.beyond == 0);
            CHECK(report.count + report.thresholds == 2 * count);
            CHECK((regime.passive ? report.thresholds == 0 : report.thresholds < count));
        }
    }
}

TEST_CASE("well-posed questions are answered to 1e-13 by every instruction set", "[stability]") {
    CHECK(error_bound(0) == 1e-13);
    CHECK(error_bound(80) == 1e-13);
    CHECK_THAT(error_bound(1e6), WithinRel(1e7 * kUnitRoundoff, 1e-15));
    for (const SimdLevel level : tested_levels()) {
        const RegimeReport report = measure_stability(*find_regime("ordinary"), 40, 1, {0, level});
        CAPTURE(name_of(level));
        CHECK(report.first_violation == "");
        CHECK(report.R.worst < 1e-13);
        CHECK(report.A.worst < 1e-13);
    }
}
