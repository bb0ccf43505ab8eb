#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.hpp"
#include "tests/core/coherent/ask.hpp"
#include "tests/oracle/layer_oracle.hpp"
#include "tests/oracle/random_stacks.hpp"

using namespace irido;
using Catch::WithinAbs;
using Catch::WithinRel;
using oracle::incoherent;
using oracle::Query;
using oracle::spread;
using oracle::StackBuilder;

namespace {

std::vector<double> layers_of(const Stack& stack, const Query& query) {
    const IndexTable table(stack, {query.wavelength_nm});
    const double cosine = cos_of_incidence(query.angle_deg);
    Needs needs;
    needs.layers = true;
    const Spectra at = spectra(StackPower(stack), table, std::span(&cosine, 1), needs);
    return query.polarization == Polarization::s ? at.s.A_layers : at.p.A_layers;
}

double sum(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Compares every layer with 100 digits, relatively; `scale` is the reference size for sums that
/// cancel.
void check_layers(const Stack& stack, const Query& query, double relative) {
    const std::vector<double> got = layers_of(stack, query);
    const std::vector<double> exact = oracle::layer_absorption(stack, query);
    REQUIRE(got.size() == exact.size());
    for (std::size_t i = 0; i < got.size(); ++i) {
        CAPTURE(oracle::text_of(stack), query.wavelength_nm, query.angle_deg, i, got[i], exact[i]);
        // without absorption, 100 digits leave a difference of 1e-90; subnormal numbers have few
        // digits
        if (std::abs(exact[i]) < 1e-80) {
            CHECK(std::abs(got[i]) < 1e-80);
        } else {
            CHECK(std::abs(got[i] - exact[i]) <= relative * std::abs(exact[i]));
        }
    }
}

void check_both(const Stack& stack, double wavelength_nm, double angle_deg, double relative) {
    for (const auto polarization : {Polarization::s, Polarization::p})
        check_layers(stack, {wavelength_nm, angle_deg, polarization}, relative);
}

/// Rounding error of a few dozen operations and of phases of some hundred radians.
constexpr double kRelative = 1e-12;

}  // namespace

TEST_CASE("absorption of every layer agrees with fluxes in 100 digits") {
    oracle::Random random(71);
    for (int i = 0; i < 24; ++i) {
        StackBuilder b(random.uniform(1, 1.5));
        for (int j = 0; j < 5; ++j) {
            const double k = j % 2 ? 0 : std::pow(10, random.uniform(-12, 0.5));
            b.add(b.layer({random.uniform(0.3, 2.6), k}, random.uniform(1, 300)));
        }
        const Stack stack = b.over({random.uniform(0.2, 3), i % 3 ? 0 : 2.0});
        check_both(stack, random.uniform(400, 800), i == 0 ? 0 : random.uniform(0, 89), kRelative);
    }
}

TEST_CASE("a layer that takes 1e-12 of the light keeps its digits") {
    StackBuilder b;
    b.add(b.layer({1.5, 1e-13}, 100));
    b.add(b.layer({2.2, 1e-3}, 60));
    b.add(b.layer({1.38, 3e-14}, 1));
    b.add(b.layer({0.2, 3.4}, 200));  // hardly any light reaches the last one
    b.add(b.layer({1.5, 1e-6}, 100));
    const Stack stack = b.over(1.52);
    const std::vector<double> layers = layers_of(stack, {550, 50, Polarization::s});
    CHECK(layers[2] < 1e-15);
    CHECK(layers[4] < 1e-10);
    check_both(stack, 550, 50, 1e-13);
}

TEST_CASE("thick absorbers, gain and total reflection layer by layer") {
    StackBuilder thick;
    thick.add(thick.layer({1.5, 0.1}, 20000));
    thick.add(thick.layer({2, 2}, 3000));
    thick.add(thick.layer({1.2, 0.01}, 500));
    check_both(thick.over(1.5), 550, 30, 1e-12);
    StackBuilder gain;
    gain.add(gain.layer({1.6, -0.01}, 300));
    gain.add(gain.layer({1.4, 0.02}, 200));
    check_both(gain.over(1.5), 550, 30, 1e-12);
    CHECK(layers_of(gain.over(1.5), {550, 30, Polarization::p})[0] < 0);
    StackBuilder gap(1.8);
    gap.add(gap.layer({1, 1e-9}, 2000));  // total reflection, with tunnelling
    gap.add(gap.layer({0.2, 3.4}, 30));
    check_both(gap.over(1.8), 550, 60, 1e-12);
    check_both(gap.over(1), 550, 60, 1e-12);
}

TEST_CASE("repeated groups are written out") {
    StackBuilder b;
    b.add(b.layer(1.7, 40));
    b.add(StackBuilder::group(
        3, {b.layer({2.3, 1e-4}, 60),
            StackBuilder::group(2, {b.layer(1.46, 40), b.layer({1.5, 1e-7}, 3)})}));
    const Stack stack = b.over(1.52);
    CHECK(StackPower(stack).layer_count() == 16);
    check_both(stack, 550, 20, 1e-12);
    StackBuilder many;
    many.add(StackBuilder::group(500, {many.layer({2.3, 1e-3}, 60), many.layer(1.46, 94)}));
    // 1000 layers deep, where the light in the gap is 1e-190
    check_both(many.over(1.52), 550, 20, 1e-11);
    StackBuilder more;
    more.add(StackBuilder::group(1001, {more.layer({2.3, 1e-3}, 60)}));
    CHECK_THROWS_AS(layers_of(more.over(1), {}), DomainError);
    StackBuilder most;
    const Element all = StackBuilder::group(1000000000, {most.layer(2, 1), most.layer(2, 1)});
    most.add(StackBuilder::group(1000000000, {all, all}));
    most.add(StackBuilder::group(1000000000, {StackBuilder::group(1000000000, {all})}));
    CHECK(StackPower(most.over(1)).layer_count() > 1000);
}

TEST_CASE("the layers' absorptions are all of A") {
    oracle::Random random(72);
    for (int i = 0; i < 40; ++i) {
        StackBuilder b;
        b.add(b.layer({random.uniform(1.3, 2.5), random.uniform(0, 0.1)}, random.uniform(10, 400)));
        b.add(incoherent(b.layer({1.5, i % 2 ? 1e-4 : 0}, 3000)));
        b.add(b.layer({random.uniform(1.3, 2.5), random.uniform(0, 0.01)}, 100));
        b.add(b.layer({0.2, 3.4}, random.uniform(1, 20)));
        b.add(incoherent(b.layer({1.6, i % 3 ? 0 : 1e-5}, 1e5)));
        if (i % 5 == 0) b.add(spread(b.layer({1.8, 1e-3}, 300), 20));
        const Stack stack = b.over(1.5);
        const double angle = random.uniform(0, 89);
        const Powers power = ask(stack, 550, angle);
        CAPTURE(oracle::text_of(stack), angle);
        CHECK_THAT(sum(layers_of(stack, {550, angle, Polarization::s})),
                   WithinAbs(power.s.A, 1e-14));
        CHECK_THAT(sum(layers_of(stack, {550, angle, Polarization::p})),
                   WithinAbs(power.p.A, 1e-14));
    }
}

TEST_CASE("layers around an incoherent one are means over its phase") {
    // coherent results at thicknesses distributed over one fringe; R R' is below 0.6, 0.6^64 is
    // 1e-14
    constexpr int points = 64;
    const double angle = 35, n = 1.5;
    const double fringe =
        550 / (2 * std::sqrt(n * n - std::pow(std::sin(angle * std::numbers::pi / 180), 2)));
    const auto build = [&](double thickness, bool coherent) {
        StackBuilder b;
        b.add(b.layer({2.2, 0.05}, 80));
        Element plate = b.layer(n, thickness);
        b.add(coherent ? plate : incoherent(plate));
        b.add(b.layer({0.2, 3.4}, 15));
        b.add(b.layer({1.9, 1e-9}, 70));
        return b.over(1.5);
    };
    for (const auto polarization : {Polarization::s, Polarization::p}) {
        const Query query{550, angle, polarization};
        std::vector<double> mean(4);
        for (int i = 0; i < points; ++i) {
            const auto at = layers_of(build(1000 + fringe * i / points, true), query);
            for (std::size_t j = 0; j < 4; ++j) mean[j] += at[j] / points;
        }
        const auto got = layers_of(build(1000, false), query);
        for (std::size_t j = 0; j < 4; ++j) {
            CAPTURE(j);
            CHECK_THAT(got[j], WithinRel(mean[j], 1e-12) || WithinAbs(0, 1e-30));
        }
    }
}

TEST_CASE("layers of a spread stack are means over the thickness") {
    const auto build = [](double thickness, double sigma) {
        StackBuilder b;
        b.add(b.layer({2.2, 0.05}, 80));
        b.add(spread(b.layer(1.5, thickness), sigma));
        b.add(b.layer({0.2, 3.4}, 15));
        return b.over(1.5);
    };
    const Query query{550, 35, Polarization::p};
    // trapezoid rule over 8 standard deviations, accurate to 1e-16 for such a smooth function
    std::vector<double> mean(3);
    double weight = 0;
    for (int i = -40; i <= 40; ++i) {
        const double z = i / 5.0, w = std::exp(-z * z / 2);
        const auto at = layers_of(build(400 + 10 * z, 0), query);
        for (std::size_t j = 0; j < 3; ++j) mean[j] += w * at[j];
        weight += w;
    }
    const auto got = layers_of(build(400, 10), query);
    for (std::size_t j = 0; j < 3; ++j) CHECK_THAT(got[j], WithinAbs(mean[j] / weight, 1e-12));
}

TEST_CASE("no light, no absorption") {
    StackBuilder b;
    b.add(b.layer({2, 1}, 100));
    b.add(incoherent(b.layer({2, 1}, 100)));
    for (const double a : layers_of(b.over(1), {550, 90, Polarization::s})) CHECK(a == 0);
}

TEST_CASE("amplitudes agree with 100 digits") {
    oracle::Random random(73);
    for (int i = 0; i < 16; ++i) {
        const auto kind = static_cast<oracle::Kind>(static_cast<std::size_t>(i) % oracle::kKinds);
        const Stack stack = oracle::random_stack(kind, random);
        const double wavelength = random.uniform(400, 750), angle = oracle::random_angle(random);
        const IndexTable table(stack, {wavelength});
        const double cosine = cos_of_incidence(angle);
        Needs needs;
        needs.amplitudes = true;
        const Spectra at = spectra(StackPower(stack), table, std::span(&cosine, 1), needs);
        for (const auto polarization : {Polarization::s, Polarization::p}) {
            const Spectrum& spectrum = polarization == Polarization::s ? at.s : at.p;
            const auto exact = oracle::amplitudes(stack, {wavelength, angle, polarization});
            CAPTURE(oracle::text_of(stack), wavelength, angle);
            // the phase of t, up to some hundred radians, is rounded
            CHECK(std::abs(spectrum.r[0] - exact.r) < 2e-12);
            CHECK(std::abs(spectrum.t[0] - exact.t) < 2e-12 * (1 + std::abs(exact.t)));
        }
    }
}

TEST_CASE("groups of groups in gaps absorb what their layers absorb") {
    // fields cancel when the inner groups, deep in a gap, act on a band of the outer one
    StackBuilder b(2);
    const Element inner = StackBuilder::group(
        8, {b.layer({1.8663439197464142, 1.2593598230183976e-06}, 226.61934406930504),
            b.layer(1.171990289343589, 330.71217009574275)});
    b.add(StackBuilder::group(10, {inner, b.layer(1.5423832780065041, 116.30752486570692)}));
    const Stack stack = b.over(1.5);
    for (const auto polarization : {Polarization::s, Polarization::p}) {
        const Query query{643.77437147418436, 57.576985353219506, polarization};
        const Powers powers = ask(stack, query.wavelength_nm, query.angle_deg);
        const double A = polarization == Polarization::s ? powers.s.A : powers.p.A;
        CHECK_THAT(A, WithinRel(sum(layers_of(stack, query)), 1e-9));
    }
}

TEST_CASE("a spread layer over deep absorbers lets T reach 1e-293") {
    const auto stack_of = [](double sigma_nm) {
        StackBuilder b;
        b.add(spread(b.layer(1.5, 100), sigma_nm));
        for (int i = 0; i < 700; ++i) {
            b.add(b.layer({0.05, 3}, 40));
            b.add(b.layer(2.5, 80));
        }
        return b.over(1.5);
    };
    const double sharp = ask(stack_of(0), 550, 0).s.T;
    CHECK(sharp > 1e-294);
    CHECK_THAT(ask(stack_of(1e-7), 550, 0).s.T, WithinRel(sharp, 1e-9));
}
