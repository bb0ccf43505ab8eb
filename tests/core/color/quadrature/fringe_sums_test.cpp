#include "core/color/quadrature/fringe_sums.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/color/stack_color.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/stack/builder.hpp"
#include "tests/oracle/random_stacks.hpp"
#include "tests/support/d65_tables.hpp"

using namespace irido;
using test::d65_tables;

namespace {

std::vector<StackColor> colors_of(const Stack& stack, double angle_deg, double tolerance,
                                  std::size_t evaluations) {
    return stack_color(d65_tables(), stack, color_method("quadrature"),
                       {.sides = {Side::reflected, Side::transmitted},
                        .tolerance = tolerance,
                        .evaluations = evaluations},
                       std::span(&angle_deg, 1));
}

Element random_mirror(StackBuilder& b, Random& random, double least, double most) {
    const double k = random.one_in(3) ? random.log_uniform(1e-8, 1e-6) : 0;
    const Element first = b.layer({random.uniform(1.9, 2.5), k}, random.uniform(40, 90));
    const Element second = b.layer(random.uniform(1.3, 1.6), random.uniform(60, 120));
    return StackBuilder::group(static_cast<std::uint64_t>(random.log_uniform(least, most)),
                               {first, second});
}

}  // namespace

TEST_CASE("waves are integrals of the sensitivity times themselves") {
    // one element whose reflectance is 1/4 + 2 q cos(psi) to first order, and whose phase bends
    const Sensitivity& sensitivity = d65_tables().sensitivity();
    const WavelengthRange all = sensitivity.support();
    for (const double turns : {3e3, 4e5}) {
        const auto psi = [&](double nm) { return turns * (400 / nm + std::pow(nm / 600 - 1, 2)); };
        const auto amplitude = [](double nm) { return 0.1 + nm / 1e4; };
        const FringeForms forms = [&](std::span<const double> nm, std::span<FringeForm> at) {
            for (std::size_t j = 0; j < nm.size(); ++j) {
                // r = 1/2 + a w
                at[j] = {};
                at[j].incident[0] = 1;
                at[j].reflected[0] = 0.5;
                at[j].reflected[1] = amplitude(nm[j]);
                at[j].turn[0] = psi(nm[j]);
            }
        };
        const Side side = Side::reflected;
        const std::vector<double> ends{all.first_nm, all.last_nm};
        const FringeSum sum =
            fringe_sums(sensitivity, ends, 1, std::span(&side, 1), forms, {1e-8, 1U << 18})[0];
        Triple exact{};
        const std::vector<double> cells = sensitivity.cells(all);
        for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
            const int steps = static_cast<int>(turns / 20) + 40;  // Simpson's rule
            const double width = (cells[i + 1] - cells[i]) / (2 * steps);
            for (int j = 0; j <= 2 * steps; ++j) {
                const double nm = std::min(cells[i] + width * j, cells[i + 1]);
                const double weight = j == 0 || j == 2 * steps ? 1 : j % 2 == 1 ? 4 : 2;
                const Triple s = sensitivity.at(nm);
                for (std::size_t c = 0; c < 3; ++c)
                    exact[c] += weight * width / 3 * s[c] * amplitude(nm) * std::cos(psi(nm));
            }
        }
        CAPTURE(turns, sum.error, sum.xyz[1], exact[1]);
        CHECK(sum.error < 1e-8);
        CHECK(std::abs(exact[1]) > 1e-7);
        CHECK(largest_difference(sum.xyz, exact) < sum.error + 1e-9);
    }
}

TEST_CASE("mirrors whose fringes are added as waves have the colour of all fringes", "[slow]") {
    Random random(5);
    for (int i = 0; i < 6; ++i) {
        StackBuilder b;
        if (random.one_in(2)) b.add(b.layer(random.uniform(1.4, 2.4), 100));
        b.add(random_mirror(b, random, 800, 1600));
        const Stack stack = b.over({1.5, random.one_in(2) ? 3.0 : 0.0});
        const double angle = random.uniform(0, 60);
        const auto waves = colors_of(stack, angle, 1e-6, 1U << 20);
        const auto every = colors_of(stack, angle, 1e-12, 1U << 20);
        for (std::size_t side = 0; side < 2; ++side) {
            CAPTURE(i, oracle::text_of(stack), angle, side, waves[side].error, every[side].error);
            CHECK(waves[side].error <= 1e-6);
            CHECK(2 * waves[side].evaluations < every[side].evaluations);
            CHECK(largest_difference(waves[side].xyz, every[side].xyz) <=
                  waves[side].error + every[side].error);
        }
    }
}

TEST_CASE("two mirrors too fine for the wavelengths have the colour of all fringes", "[slow]") {
    Random random(6);
    for (int i = 0; i < 6; ++i) {
        StackBuilder b;
        b.add(random_mirror(b, random, 2500, 3500));
        if (random.one_in(2)) b.add(b.layer(random.uniform(1.4, 2.4), 200));
        b.add(random_mirror(b, random, 2500, 3500));
        const Stack stack = b.over(random.uniform(1, 2));
        const double angle = random.uniform(0, 60);
        const auto means = colors_of(stack, angle, 1e-4, 20000);
        const auto every = colors_of(stack, angle, 1e-7, 1U << 20);
        for (std::size_t side = 0; side < 2; ++side) {
            CAPTURE(i, oracle::text_of(stack), angle, side, means[side].error, every[side].error);
            CHECK(means[side].error <= 1e-4);
            CHECK(largest_difference(means[side].xyz, every[side].xyz) <=
                  means[side].error + every[side].error);
        }
    }
}

TEST_CASE("two mirrors of a billion periods each have their colour") {
    // both have the same optical thickness: their fringes beat slowly against each other
    StackBuilder b;
    b.add(StackBuilder::group(1000000000, {b.layer(2.3, 60), b.layer(1.4, 100)}));
    b.add(b.layer(1.7, 500));
    b.add(StackBuilder::group(1000000000, {b.layer(2.2, 65), b.layer(1.5, 90)}));
    const auto colors = colors_of(b.over(1.5), 0, 1e-6, 1U << 20);
    CHECK(colors[0].error <= 1e-6);
    CHECK(colors[1].error <= 1e-6);
    CHECK(std::abs(colors[0].xyz[1] + colors[1].xyz[1] - 1) < 2e-6);
}

// Indices are constant and the phases whole multiples of one: R is a function of that, whose mean
// is Y.
TEST_CASE("beats of phases that are multiples of one another are in the colour or in its error",
          "[color][regression][slow]") {
    struct Case {
        double n1, n2, substrate;
        int turns1, turns2;
    };
    int answered = 0;
    for (const Case& c : {Case{1.5, 3, 1, 1, 1},
                          {1.5, 2, 2.5, 3, 4},
                          {1.5, 3, 1, 1, 2},
                          {4, 1.2, 4, 1, 1},
                          {4, 1, 4, 4, 1},
                          {3, 1, 3, 7, 1}}) {
        StackBuilder b;
        b.add(b.layer(c.n1, 1e8 * c.turns1 / c.n1));
        b.add(b.layer(c.n2, 1e8 * c.turns2 / c.n2));
        const StackColor got = colors_of(b.over(c.substrate), 0, 1e-6, 1U << 20).front();
        const auto face = [](double above, double below) {
            return Complex((above - below) / (above + below));
        };
        constexpr int kPhases = 20000;
        double mean = 0;
        for (int i = 0; i < kPhases; ++i) {
            const double phase = 2 * std::numbers::pi * i / kPhases;
            Complex r = face(c.n2, c.substrate) * std::polar(1.0, c.turns2 * phase);
            r = (face(c.n1, c.n2) + r) / (1.0 + face(c.n1, c.n2) * r);
            r *= std::polar(1.0, c.turns1 * phase);
            mean += std::norm((face(1, c.n1) + r) / (1.0 + face(1, c.n1) * r)) / kPhases;
        }
        CAPTURE(c.n1, c.n2, c.turns1, c.turns2, got.error);
        CHECK(std::abs(got.xyz[1] - mean) <= got.error + 1e-12);
        answered += got.error <= 1e-6;
    }
    CHECK(answered >= 3);
}

TEST_CASE("beats of random layers with phases that are multiples of one another are in the error",
          "[color][slow]") {
    Random random(12);
    int answered = 0;
    for (int i = 0; i < 12; ++i) {
        const std::size_t count = 2 + random.below(2);
        StackBuilder b;
        std::vector<double> n{1};
        std::vector<int> turns{0};
        for (std::size_t j = 0; j < count; ++j) {
            n.push_back(random.uniform(1, 4));
            turns.push_back(static_cast<int>(1 + random.below(9)));
            b.add(b.layer(n.back(), std::pow(10.0, 6 + i % 3) * turns.back() / n.back()));
        }
        n.push_back(random.uniform(1, 4));
        const Stack stack = b.over(n.back());
        const StackColor got = colors_of(stack, 0, 1e-6, 1U << 18).front();
        constexpr int kPhases = 20000;
        double mean = 0;
        for (int k = 0; k < kPhases; ++k) {
            Complex r = 0;
            for (std::size_t j = count + 1; j-- > 0;) {
                const double face = (n[j] - n[j + 1]) / (n[j] + n[j + 1]);
                r = (face + r) / (1.0 + face * r);
                r *= std::polar(1.0, 2 * std::numbers::pi * k * turns[j] / kPhases);
            }
            mean += std::norm(r) / kPhases;
        }
        CAPTURE(i, oracle::text_of(stack), got.error);
        CHECK(std::abs(got.xyz[1] - mean) <= got.error + 1e-8);
        answered += got.error <= 1e-6;
    }
    CHECK(answered >= 2);
}
