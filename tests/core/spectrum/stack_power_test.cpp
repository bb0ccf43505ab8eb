#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "tests/core/coherent/ask.hpp"
#include "tests/oracle/random_stacks.hpp"
#include "tests/oracle/stack_oracle.hpp"

using namespace irido;
using Catch::WithinAbs;
using oracle::incoherent;
using oracle::spread;
using oracle::StackBuilder;

namespace {

void check_same(const Power& a, const Power& b, double tolerance) {
    CHECK_THAT(a.R, WithinAbs(b.R, tolerance));
    CHECK_THAT(a.T, WithinAbs(b.T, tolerance));
    CHECK_THAT(a.A, WithinAbs(b.A, tolerance));
}

}  // namespace

TEST_CASE("a glass plate adds powers") {
    for (const double k : {0.0, 1e-7, 1e-5}) {
        StackBuilder b;
        b.add(incoherent(b.layer({1.5, k}, 1e6)));
        const Power power = ask(b.over(1), 550, 0).s;
        const double k2 = k * k;
        const double R1 = (0.25 + k2) / (6.25 + k2);
        const double T12 = std::norm(4.0 * Complex(1.5, k) / std::pow(Complex(2.5, k), 2));
        const double a = std::exp(-4 * std::numbers::pi * k * 1e6 / 550);
        CAPTURE(k);
        CHECK_THAT(power.R, WithinAbs(R1 + T12 * a * a * R1 / (1 - R1 * R1 * a * a), 1e-14));
        CHECK_THAT(power.T, WithinAbs(T12 * a / (1 - R1 * R1 * a * a), 1e-14));
        CHECK_THAT(power.R + power.T + power.A, WithinAbs(1, 1e-14));
    }
    StackBuilder b;
    b.add(incoherent(b.layer(1.5, 1e6)));
    CHECK_THAT(ask(b.over(1), 550, 0).s.R, WithinAbs(0.08 / 1.04, 1e-15));  // 2 R1 / (1 + R1)
}

TEST_CASE("an incoherent layer is the mean over its phase") {
    oracle::Random random(41);
    for (int i = 0; i < 30; ++i) {
        StackBuilder b;
        const double n1 = random.uniform(1.2, 2.2), k1 = i % 2 ? random.uniform(0, 0.2) : 0;
        b.add(b.layer({n1, k1}, random.uniform(10, 200)));
        const double n2 = random.uniform(1.3, 1.8), k2 = i % 3 ? 0 : 1e-4;
        b.add(incoherent(b.layer({n2, k2}, random.uniform(100, 1000))));
        b.add(StackBuilder::group(3, {b.layer(2.1, 50), b.layer(1.4, 70)}));
        const Stack stack = b.over(1.52);
        const double wavelength = random.uniform(400, 700), angle = random.uniform(0, 70);
        CAPTURE(oracle::text_of(stack), wavelength, angle);
        const Powers both = ask(stack, wavelength, angle);
        // R R' of the blocks stays below 0.9, and 0.9^250 below 1e-11 of its own small factor
        constexpr int points = 250;
        constexpr double tolerance = 1e-12;
        check_same(both.s, oracle::incoherent(stack, {wavelength, angle, Polarization::s}, points),
                   tolerance);
        check_same(both.p, oracle::incoherent(stack, {wavelength, angle, Polarization::p}, points),
                   tolerance);
    }
}

TEST_CASE("a pile of plates adds up as Stokes found") {
    // T = (1 - R1) / (1 + (2 N - 1) R1) of N lossless plates, G. G. Stokes, Proc. R. Soc. 11 (1862)
    for (const std::uint64_t plates : {1U, 2U, 3U, 50U}) {
        StackBuilder b;
        for (std::uint64_t i = 0; i < plates; ++i) {
            if (i > 0) b.add(incoherent(b.layer(1, 1e6)));
            b.add(incoherent(b.layer(1.5, 1e6)));
        }
        const Power power = ask(b.over(1), 550, 0).s;
        const double T = 0.96 / (1 + (2 * static_cast<double>(plates) - 1) * 0.04);
        CHECK_THAT(power.T, WithinAbs(T, 1e-14));
        CHECK_THAT(power.R, WithinAbs(1 - T, 1e-14));
    }
}

TEST_CASE("a strongly absorbing incoherent layer conserves power") {
    for (const double k : {1e-7, 1e-3, 0.1, 1.0}) {
        StackBuilder b;
        b.add(b.layer(2.2, 80));
        b.add(incoherent(b.layer({1.5, k}, 200)));
        b.add(b.layer(1.8, 70));
        const Stack stack = b.over(1.52);
        const Powers both = ask(stack, 550, 45);
        CAPTURE(k);
        check_same(both.s, oracle::incoherent(stack, {550, 45, Polarization::s}, 64), 1e-14);
        check_same(both.p, oracle::incoherent(stack, {550, 45, Polarization::p}, 64), 1e-14);
    }
}

TEST_CASE("incoherent layers in groups are written out") {
    StackBuilder b, c;
    const auto plate = [](StackBuilder& s) { return incoherent(s.layer(1.5, 1e6)); };
    b.add(StackBuilder::group(3, {plate(b), b.layer(1, 1000)}));
    for (int i = 0; i < 3; ++i) {
        c.add(plate(c));
        c.add(c.layer(1, 1000));
    }
    check_same(ask(b.over(1), 550, 20).p, ask(c.over(1), 550, 20).p, 0);
    StackBuilder most, more;
    most.add(StackBuilder::group(5000, {plate(most), most.layer(1, 10)}));
    CHECK_NOTHROW(StackPower(most.over(1)));
    more.add(StackBuilder::group(5001, {plate(more), more.layer(1, 10)}));
    CHECK_THROWS_AS(StackPower(more.over(1)), DomainError);
    StackBuilder nested;
    const Element many = StackBuilder::group(1000000000, {plate(nested)});
    nested.add(StackBuilder::group(1000000000, {many}));
    CHECK_THROWS_AS(StackPower(nested.over(1)), DomainError);
}

TEST_CASE("a spread of thickness averages powers") {
    for (const double sigma : {0.01, 1.0, 20.0, 200.0}) {  // the last is cut at zero
        StackBuilder b;
        b.add(spread(b.layer({1.7, 0.01}, 300), sigma));
        b.add(b.layer(2.2, 60));
        const Stack stack = b.over({0.3, 3});
        CAPTURE(sigma);
        check_same(ask(stack, 550, 40).s, oracle::spread(stack, {550, 40, Polarization::s}, 60),
                   kThicknessMeanError);
        check_same(ask(stack, 550, 40).p, oracle::spread(stack, {550, 40, Polarization::p}, 60),
                   kThicknessMeanError);
    }
}

TEST_CASE("spread layers are independent, repeated ones move together") {
    StackBuilder b;
    b.add(spread(b.layer(1.5, 300), 15));
    b.add(StackBuilder::group(4, {b.layer(1.4, 90), spread(b.layer(2.3, 60), 4)}));
    b.add(incoherent(b.layer(1.5, 1e6)));
    const Stack stack = b.over(1);
    check_same(ask(stack, 550, 30).s, oracle::spread(stack, {550, 30, Polarization::s}, 5, 24),
               kThicknessMeanError);
}

TEST_CASE("a small spread bends, a large one forgets the phase") {
    const auto film = [](double thickness, double sigma) {
        StackBuilder b;
        b.add(spread(b.layer(1.5, thickness), sigma));
        return ask(b.over(3), 550, 30).s.R;
    };
    // sigma^2 R''/2, by finite differences; the next term is (2 k0 n sigma)^4 / 8 = 2e-7
    const double h = 1, sigma = 1;
    const double bend = (film(400 + h, 0) - 2 * film(400, 0) + film(400 - h, 0)) / (h * h);
    CHECK_THAT(film(400, sigma) - film(400, 0), WithinAbs(sigma * sigma / 2 * bend, 1e-6));
    CHECK(std::abs(bend) > 1e-5);
    StackBuilder b;
    b.add(incoherent(b.layer(1.5, 1000)));
    const double mean = ask(b.over(3), 550, 30).s.R;
    for (const double wide : {400.0, 1e4, 1e6})
        CHECK_THAT(film(10 * wide, wide), WithinAbs(mean, kThicknessMeanError));
}

TEST_CASE("a sharp resonance in a spread layer is not missed") {
    // A half-wave layer between two mirrors of p quarter-wave pairs. Seen from the layer, a mirror
    // has the admittance (1.46/2.3)^(2p), so r1 is real and T = (1 - r1^2)^2 / |1 - r1^2 exp(i
    // Phi)|^2, a geometric Fourier series in the round-trip phase Phi, with mean 2 pi. A Gaussian
    // distribution of Phi with standard deviation s damps the m-th term by exp(-m^2 s^2/2).
    const double high = 550 / 2.3 / 4, low = 550 / 1.46 / 4;
    for (const int pairs : {3, 8, 12, 20}) {
        for (const double sigma : {1e-3, 1.0, 10.0}) {
            const auto repeat = static_cast<std::uint64_t>(pairs);
            StackBuilder b;
            b.add(StackBuilder::group(repeat, {b.layer(2.3, high), b.layer(1.46, low)}));
            b.add(spread(b.layer(2.3, 4 * high), sigma));
            b.add(StackBuilder::group(repeat, {b.layer(1.46, low), b.layer(2.3, high)}));
            const long double admittance = std::pow(1.46L / 2.3L, 2 * pairs);
            const long double r1 = (2.3L - admittance) / (2.3L + admittance), r2 = r1 * r1;
            const double s = 2 * (2 * std::numbers::pi / 550) * 2.3 * sigma;
            // exp(-(m s)^2/2) ends the series at m = 9/s, r2^m at 40/(1 - r2)
            long double series = 1;
            for (long double m = 1; m * s < 9 && m < 40 / (1 - r2); ++m)
                series += 2 * std::pow(r2, m) * std::exp(-m * m * s * s / 2);
            CAPTURE(pairs, sigma);
            // a resonance's width 1 - r2 is rounded to about 1e-15, and so is T, relatively
            const double T = static_cast<double>((1 - r2) / (1 + r2) * series);
            const double rounding = T * 1e-14 / static_cast<double>(1 - r2);
            CHECK_THAT(ask(b.over(1), 550, 0).s.T, WithinAbs(T, 1e-13 + rounding));
        }
    }
}

TEST_CASE("spread absorbers, evanescent gaps and metals agree with brute force") {
    struct Case {
        Complex index;
        double thickness_nm, sigma_nm;
        int panels;
    };
    const std::vector<Case> cases{
        {{1.7, 0.01}, 300, 60, 100},  {{1.7, 0.01}, 300, 1000, 1000}, {{1.5, 1e-6}, 8e3, 800, 500},
        {{1.5, 1e-4}, 2e3, 1e3, 500}, {{0.2, 3.4}, 40, 30, 200},      {{1.5, -1e-4}, 8e3, 800, 500},
        {{1.0, 0}, 500, 50, 100},     {{1.0, 0}, 500, 3000, 500},     {{2.5, 1}, 1e4, 1e3, 500},
    };
    for (const Case& c : cases) {
        StackBuilder b(1.5);
        b.add(b.layer(2.0, 100));
        b.add(spread(b.layer(c.index, c.thickness_nm), c.sigma_nm));
        b.add(b.layer({0.2, 3.4}, 10));
        const Stack stack = b.over(1.5);
        CAPTURE(oracle::text_of(stack), c.sigma_nm);
        const Powers both = ask(stack, 550, 50);
        check_same(both.s, oracle::spread(stack, {550, 50, Polarization::s}, c.panels),
                   kThicknessMeanError);
        check_same(both.p, oracle::spread(stack, {550, 50, Polarization::p}, c.panels),
                   kThicknessMeanError);
    }
}

TEST_CASE("three spread layers, on both sides of an incoherent one") {
    StackBuilder b;
    b.add(spread(b.layer(1.5, 300), 15));
    b.add(spread(b.layer({2.1, 0.1}, 100), 5));
    b.add(spread(b.layer(1.3, 200), 10));
    const Stack three = b.over(3);
    check_same(ask(three, 550, 30).p, oracle::spread(three, {550, 30, Polarization::p}, 3),
               kThicknessMeanError);
    StackBuilder c;
    c.add(spread(c.layer(1.5, 300), 15));
    c.add(c.layer({0.2, 3.4}, 20));
    c.add(incoherent(c.layer({1.5, 1e-4}, 1000)));
    c.add(spread(c.layer(2.5, 300), 15));
    const Stack two = c.over(1);
    check_same(ask(two, 550, 30).s, oracle::spread(two, {550, 30, Polarization::s}, 4, 40),
               kThicknessMeanError);
}

TEST_CASE("a metre of glass with a spread is an incoherent layer") {
    StackBuilder b, c;
    b.add(b.layer(2.2, 60));
    b.add(spread(b.layer(1.5, 1e9), 1e8));
    c.add(c.layer(2.2, 60));
    c.add(incoherent(c.layer(1.5, 1e9)));
    for (const double angle : {0.0, 60.0})
        check_same(ask(b.over(1), 550, angle).p, ask(c.over(1), 550, angle).p, kThicknessMeanError);
}

TEST_CASE("repetitions of a group share the deviation, incoherent layers or not") {
    // a plate between two films with equal distributions; the mean over their thickness by the
    // trapezoid rule
    const auto film = [](StackBuilder& b, double sigma, double thickness) {
        return sigma > 0 ? spread(b.layer(2.2, thickness), sigma) : b.layer(2.2, thickness);
    };
    const auto build = [&](double sigma, double thickness) {
        StackBuilder b;
        b.add(StackBuilder::group(
            2, {film(b, sigma, thickness), incoherent(b.layer({1.5, 1e-6}, 1e5))}));
        return b.over(1.3);
    };
    Power sum;
    double weight = 0;
    for (int i = -40; i <= 40; ++i) {
        const double z = i / 5.0, w = std::exp(-z * z / 2);
        const Power at = ask(build(0, 150 + 7 * z), 550, 40).s;
        sum = {sum.R + w * at.R, sum.T + w * at.T, sum.A + w * at.A};
        weight += w;
    }
    const Power mean{sum.R / weight, sum.T / weight, sum.A / weight};
    check_same(ask(build(7, 150), 550, 40).s, mean, kThicknessMeanError);
}

TEST_CASE("an incoherent layer may amplify, up to its threshold") {
    for (const double k : {-1e-5, -1e-4}) {
        StackBuilder b;
        b.add(b.layer(2.2, 60));
        b.add(incoherent(b.layer({1.5, k}, 3000)));
        const Stack stack = b.over(1.7);
        const Powers both = ask(stack, 550, 20);
        CAPTURE(k);
        CHECK(both.s.A < 0);
        check_same(both.s, oracle::incoherent(stack, {550, 20, Polarization::s}, 200), 1e-12);
        check_same(both.p, oracle::incoherent(stack, {550, 20, Polarization::p}, 200), 1e-12);
    }
    StackBuilder b;
    b.add(incoherent(b.layer({1.5, -0.1}, 3000)));
    CHECK_THROWS_AS(ask(b.over(1), 550, 0), DomainError);
}

TEST_CASE("light between two good incoherent mirrors keeps its digits") {
    // T = T1 T2 / (1 - R1 R2) of mirrors with T of 1e-12, where 1 - R1 R2 has four digits left
    StackBuilder b, m;
    for (StackBuilder* s : {&b, &m})
        s->add(StackBuilder::group(30, {s->layer(2.3, 59.8), s->layer(1.46, 94.2)}));
    b.add(incoherent(b.layer(1.46, 1e5)));
    b.add(StackBuilder::group(30, {b.layer(1.46, 94.2), b.layer(2.3, 59.8)}));
    const double T = ask(m.over(1.46), 550, 0).s.T;
    CHECK_THAT(ask(b.over(1), 550, 0).s.T, Catch::WithinRel(T / 2, 1e-9));
}

TEST_CASE("a spread that reaches a laser threshold is refused") {
    StackBuilder b;
    b.add(spread(b.layer({1.5, -0.05}, 3000), 300));
    CHECK_THROWS_AS(ask(b.over(1), 550, 0), DomainError);
}

TEST_CASE("four spread layers are refused") {
    StackBuilder b;
    for (const double n : {1.4, 1.5, 1.6}) b.add(spread(b.layer(n, 100), 1));
    CHECK_NOTHROW(StackPower(b.over(1)));
    b.add(StackBuilder::group(2, {spread(b.layer(1.7, 100), 1)}));
    CHECK_THROWS_AS(StackPower(b.over(1)), DomainError);
}
