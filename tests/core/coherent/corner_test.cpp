#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tests/core/coherent/ask.hpp"
#include "tests/oracle/random_stacks.hpp"
#include "tests/oracle/stack_oracle.hpp"

using namespace irido;
using oracle::Query;
using oracle::StackBuilder;

namespace {

/// Allowance for the kernel's own rounding, on top of the scatter of the exact result when inputs
/// shift by half an ulp: absolute for R, relative for T and A.
constexpr double kRounding = 1e-13;

/// A few random shifts do not find the worst one.
constexpr double kScatterMargin = 16;

/// Below this, A is a residue of the 100-digit computation.
constexpr double kNone = 1e-60;

void check_polarization(const Stack& stack, const Power& power, const Query& query,
                        double rounding) {
    const Power exact = oracle::coherent(stack, query);
    const oracle::Scatter scatter = oracle::scatter(stack, query);
    CAPTURE(exact.R, exact.T, exact.A, power.R, power.T, power.A);
    CAPTURE(scatter.R, scatter.T, scatter.A);
    const auto allowed = [&](double s) { return rounding + kScatterMargin * s; };
    CHECK(std::abs(power.R - exact.R) <= allowed(scatter.R) * std::max(1.0, exact.R));
    if (exact.T > 1e-290) {
        CHECK(std::abs(power.T - exact.T) <= allowed(scatter.T) * exact.T);
    } else {
        CHECK(std::abs(power.T) <= 1e-289);  // subnormal numbers have few digits
    }
    if (std::abs(exact.A) > kNone) {
        CHECK(std::abs(power.A - exact.A) <= allowed(scatter.A) * std::abs(exact.A));
    } else {
        CHECK(power.A == 0);
    }
}

void check(const Stack& stack, double wavelength_nm, double angle_deg,
           double rounding = kRounding) {
    const Powers both = ask(stack, wavelength_nm, angle_deg);
    CAPTURE(oracle::text_of(stack), wavelength_nm, angle_deg);
    {
        INFO("s");
        check_polarization(stack, both.s, {wavelength_nm, angle_deg, Polarization::s}, rounding);
    }
    {
        INFO("p");
        check_polarization(stack, both.p, {wavelength_nm, angle_deg, Polarization::p}, rounding);
    }
}

Stack one_film(Complex incident, Complex film, double thickness_nm, Complex substrate) {
    StackBuilder b(incident);
    b.add(b.layer(film, thickness_nm));
    return b.over(substrate);
}

Stack periods(std::uint64_t repeat, Complex n1, double d1, Complex n2, double d2, Complex substrate,
              Complex incident = 1) {
    StackBuilder b(incident);
    b.add(StackBuilder::group(repeat, {b.layer(n1, d1), b.layer(n2, d2)}));
    return b.over(substrate);
}

}  // namespace

TEST_CASE("random stacks agree with 100 digits") {
    oracle::Random random(21);
    for (int i = 0; i < 48; ++i) {
        const auto kind = static_cast<oracle::Kind>(static_cast<std::size_t>(i) % oracle::kKinds);
        const Stack stack = oracle::random_stack(kind, random);
        const double wavelength = random.uniform(400, 750);
        check(stack, wavelength, oracle::random_angle(random));
    }
}

TEST_CASE("the critical angle and a few ulps around it") {
    for (const double thickness : {0.0, 1.0, 500.0, 1e5}) {
        const Stack film = one_film(2, 1, thickness, 1.9);
        const Stack onto = one_film(2, 1.5, thickness, 1);
        for (const double from_critical : {-1e-6, -1e-12, -7e-15, 0.0, 7e-15, 1e-12, 1e-6}) {
            check(film, 550, 30 + from_critical);
            check(onto, 550, 30 + from_critical);
        }
        check(film, 550, std::nextafter(30.0, 31.0));
        check(film, 550, std::nextafter(30.0, 29.0));
    }
}

TEST_CASE("a layer's q2 may be anything near zero") {
    // in the kernel's own form, so that nothing is rounded beforehand
    const Medium above = medium(2, 2, 0.8), below = medium(1.9, 2, 0.8);
    for (const double q2 : {0.0, 1e-300, -1e-300, 1e-20, -1e-20, 1e-9, -1e-9}) {
        for (const double q2_imag : {0.0, 1e-30, 1e-10}) {
            const std::vector<Medium> media{{{1, q2_imag}, {q2, q2_imag}}};
            for (const double thickness : {1e-3, 100.0, 1e4}) {
                Layer layer;
                layer.thickness_nm = thickness;
                const std::vector<Element> elements{{layer}};
                for (const auto polarization : {Polarization::s, Polarization::p}) {
                    CAPTURE(q2, q2_imag, thickness, static_cast<int>(polarization));
                    const Power power =
                        coherent_response(above, elements, below, media, 0.01, polarization).power;
                    const Power exact =
                        oracle::coherent(above, elements, below, media, 0.01, polarization);
                    CHECK(std::abs(power.R - exact.R) < kRounding);
                    CHECK(std::abs(power.T - exact.T) < kRounding * exact.T);
                    // a small q2_imag with a smaller q2 absorbs by itself
                    if (q2_imag > 0)
                        CHECK(std::abs(power.A - exact.A) < kRounding * std::abs(exact.A));
                }
            }
        }
    }
}

TEST_CASE("evanescent gaps up to a millimetre") {
    for (const double gap : {1.0, 100.0, 3000.0, 1e5, 1e6})
        check(one_film(1.5, 1, gap, 1.5), 550, 60);
    const double none = ask(one_film(1.5, 1, 1e6, 1.5), 550, 60).s.T;
    CHECK(none == 0);
}

TEST_CASE("absorbers of a millimetre and of a metre") {
    for (const double thickness : {1e6, 1e9}) {
        check(one_film(1, {1.5, 1e-9}, thickness, 1.5), 550, 20);
        check(one_film(1, {1.5, 1e-5}, thickness, 1.5), 550, 80);
        check(one_film(1, {2, 2}, thickness, 1.5), 550, 60);
        check(one_film(1, {0.05, 60}, thickness, {0.2, 3}), 550, 60);
    }
    check(one_film(1, {0.05, 60}, 10, 1.5), 550, 85);
    check(one_film(1, {1e4, 1e4}, 1, 1.5), 550, 45);
    check(one_film(1, {1e-6, 0}, 100, 1.5), 550, 0);
}

TEST_CASE("the smallest absorption keeps its digits") {
    for (const double k : {1e-30, 1e-15, 1e-8, 1e-3})
        for (const double angle : {0.0, 1e-3, 60.0, 89.0}) {
            check(one_film(1, {1.5, k}, 300, 1.5), 550, angle);
            check(one_film(1, {1.5, k}, 1e-6, {0.2, 3}), 550, angle);
        }
}

TEST_CASE("grazing incidence") {
    for (const double below_90 : {1e-3, 1e-6, 1e-9, 1e-13}) {
        StackBuilder b;
        b.add(b.layer(1.5, 300));
        b.add(b.layer({2, 0.1}, 50));
        check(b.over(1.5), 550, 90 - below_90);
        check(one_film(1, 1.38, 100, {0.2, 3.4}), 550, 90 - below_90);
    }
}

TEST_CASE("layers that amplify") {
    for (const double gain : {-1e-12, -1e-3, -0.1, -0.5}) {
        check(one_film(1, {1.5, gain}, 300, 1.5), 550, 50);
        check(periods(20, {2, gain / 100}, 60, 1.5, 94, 1.5), 600, 10);
    }
}

TEST_CASE("a billion periods") {
    constexpr std::uint64_t kMany = 1000000000;
    check(periods(kMany, 2, 60, 1.5, 94, 1.5), 700, 30);           // pass band
    check(periods(kMany, 2, 60, 1.5, 94, 1.5), 520, 0);            // gap
    check(periods(kMany, {2, 1e-3}, 60, 1.5, 94, 1.5), 520, 0);    // gap, absorbing
    check(periods(kMany, {2, 1e-3}, 60, 1.5, 94, 1.5), 700, 30);   // opaque
    check(periods(kMany, {2, 1e-12}, 60, 1.5, 94, 1.5), 700, 30);  // nearly lossless
    for (const std::uint64_t repeat : {1000U, 1000000U}) {
        check(periods(repeat, 2, 60, 1.5, 94, 1.5), 700, 30);
        check(periods(repeat, {2, 1e-7}, 60, 1.5, 94, 1.5), 700, 30);
        check(periods(repeat, 1.7, 200, 1, 150, 1.9, 2), 550, 35);  // evanescent in every period
    }
}

TEST_CASE("periods much thinner than the wavelength") {
    // M is close to I, and only the difference matters
    check(periods(1000000, 2, 1e-4, 1.5, 1e-4, 1.5), 550, 30);
    check(periods(1000000000, 2, 1e-7, 1.5, 1e-7, 1.5), 550, 30);
    check(periods(1000000, {2, 1e-3}, 1e-4, 1.5, 1e-4, 1.5), 550, 30);
    check(periods(1000000000, {2, 1e-3}, 1e-7, 1.5, 1e-7, 1.5), 550, 30);
}

TEST_CASE("periods with a layer near its critical angle") {
    for (const double below : {1e-3, 1e-6, 1e-9, 1e-11, 1e-13, 0.0, -1e-9})
        for (const std::uint64_t repeat : {10U, 1000U})
            check(periods(repeat, 1.7, 200, 1, 150, 1.9, 2), 550, 30 - below);
}

TEST_CASE("band edges") {
    // (1@200 | 1.5@180)^N, 20 degrees, p: edges from a 60-digit evaluation of their equation
    for (const double edge : {810.7370516292337, 463.9706698284487, 437.75048963180257})
        for (const std::uint64_t repeat : {10U, 1000U})
            for (const double off : {0.0, 1e-12, -1e-9, 1e-5}) {
                CAPTURE(edge, repeat, off);
                check(periods(repeat, 1, 200, 1.5, 180, 1), edge * (1 + off), 20);
            }
}

TEST_CASE("nested and mixed groups") {
    StackBuilder b;
    const Element inner = StackBuilder::group(5, {b.layer(2.1, 40), b.layer({1.4, 1e-4}, 60)});
    b.add(StackBuilder::group(7, {inner, b.layer(1.7, 33)}));
    b.add(StackBuilder::group(1000, {b.layer(1.5, 80), b.layer(1.9, 70), b.layer(1.3, 60)}));
    check(b.over({0.3, 3}), 530, 25);
}

TEST_CASE("a thousand random layers", "[slow]") {
    for (const bool absorbing : {false, true}) {
        oracle::Random random(absorbing ? 31 : 32);
        StackBuilder b;
        for (int i = 0; i < 1000; ++i) {
            const double n = random.uniform(1.3, 1.5);
            const double k = absorbing ? random.uniform(0, 1e-4) : 0.0;
            b.add(b.layer({n, k}, random.uniform(20, 300)));
        }
        check(b.over(1.5), 550, 35, 1e-12);  // 1000 layers round more often than one
    }
}

TEST_CASE("wavelengths from 1 nm to 1 cm") {
    for (const double wavelength : {1.0, 30.0, 1e4, 1e6, 1e7}) {
        check(one_film(1, 1.38, 99.6, 1.52), wavelength, 45);
        check(one_film(1, {0.1, 4}, 20, 1.52), wavelength, 45);
        check(periods(12, 2.3, 60, 1.46, 94, 1.52), wavelength, 45);
    }
}

TEST_CASE("weak absorption over a million periods stays finite") {
    // the doubled matrices shrink as fast as their logarithm grows
    for (const double k : {1e-12, 1e-9, 1e-6, 1e-3}) {
        StackBuilder b;
        b.add(StackBuilder::group(1000000, {b.layer({2.48, k}, 58), b.layer(1.46, 94)}));
        const Powers powers = ask(b.over(1.52), 486.56, 0);
        CAPTURE(k);
        CHECK(std::abs(powers.s.R + powers.s.T + powers.s.A - 1) < 1e-13);
        CHECK(powers.s.A > 0);
    }
}
