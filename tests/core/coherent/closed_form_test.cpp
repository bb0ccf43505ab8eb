#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/math/constants.hpp"
#include "tests/core/coherent/ask.hpp"
#include "tests/oracle/random_stacks.hpp"

using namespace irido;
using Catch::WithinAbs;
using Catch::WithinRel;
using oracle::StackBuilder;

namespace {

/// Rounding error of a few dozen operations in double on each side.
constexpr double kRounding = 1e-14;

Stack bare(Complex incident, Complex substrate) {
    return StackBuilder(incident).over(substrate);
}

Stack one_film(Complex incident, Complex film, double thickness_nm, Complex substrate) {
    StackBuilder b(incident);
    b.add(b.layer(film, thickness_nm));
    return b.over(substrate);
}

/// n cos(theta) of a medium, Im > 0.
Complex normal_index(Complex n, double n0, double angle_deg) {
    const double sine = n0 * std::sin(angle_deg * kPi / 180);
    return std::sqrt(n * n - sine * sine);
}

/// Fresnel amplitude from medium a to b; for p, of the magnetic field.
Complex fresnel(Complex na, Complex nb, double n0, double angle_deg, Polarization polarization) {
    const Complex qa = normal_index(na, n0, angle_deg), qb = normal_index(nb, n0, angle_deg);
    if (polarization == Polarization::s) return (qa - qb) / (qa + qb);
    return (nb * nb * qa - na * na * qb) / (nb * nb * qa + na * na * qb);
}

}  // namespace

TEST_CASE("a single interface reflects as Fresnel says") {
    for (const Complex n : {Complex(1.5), Complex(2.4, 0.01), Complex(0.2, 3.4), Complex(1.2)}) {
        for (const double angle : {0.0, 10.0, 45.0, 70.0, 89.0}) {
            CAPTURE(n, angle);
            const Powers power = ask(bare(1.3, n), 550, angle);
            const double rs = std::norm(fresnel(1.3, n, 1.3, angle, Polarization::s));
            const double rp = std::norm(fresnel(1.3, n, 1.3, angle, Polarization::p));
            CHECK_THAT(power.s.R, WithinAbs(rs, kRounding));
            CHECK_THAT(power.p.R, WithinAbs(rp, kRounding));
            CHECK_THAT(power.s.T, WithinAbs(1 - rs, kRounding));
            CHECK_THAT(power.p.T, WithinAbs(1 - rp, kRounding));
            CHECK(power.s.A == 0);
        }
    }
}

TEST_CASE("nothing of p is reflected at Brewster's angle") {
    for (const double n : {1.1, 1.52, 4.0}) {
        const double angle = std::atan(n) * 180 / kPi;
        // r is proportional to the error of the angle, a few 1e-16 rad, and R to its square
        CHECK(ask(bare(1, n), 550, angle).p.R < 1e-30);
        CHECK(ask(bare(1, n), 550, angle).s.R > 1e-3);
    }
}

TEST_CASE("normal incidence on an absorber") {
    for (const Complex n : {Complex(1.5), Complex(0.05, 60), Complex(3, 1e-3)}) {
        const double k2 = n.imag() * n.imag();
        const double R = (std::pow(n.real() - 1, 2) + k2) / (std::pow(n.real() + 1, 2) + k2);
        const Powers power = ask(bare(1, n), 633, 0);
        CHECK_THAT(power.s.R, WithinAbs(R, kRounding));
        CHECK(power.s.R == power.p.R);
        CHECK_THAT(power.s.T,
                   WithinRel(4 * n.real() / (std::pow(n.real() + 1, 2) + k2), kRounding));
    }
}

TEST_CASE("quarter-wave and half-wave films") {
    const double n1 = 1.38, ns = 1.52, wavelength = 550;
    const double quarter = wavelength / 4 / n1;
    const double R = std::pow((ns - n1 * n1) / (ns + n1 * n1), 2);
    CHECK_THAT(ask(one_film(1, n1, quarter, ns), wavelength, 0).s.R, WithinAbs(R, kRounding));
    const double bare_R = std::pow((ns - 1) / (ns + 1), 2);
    CHECK_THAT(ask(one_film(1, n1, 2 * quarter, ns), wavelength, 0).s.R,
               WithinAbs(bare_R, kRounding));
    CHECK(ask(one_film(1, std::sqrt(ns), wavelength / 4 / std::sqrt(ns), ns), wavelength, 0).s.R <
          1e-30);  // the perfect antireflection film; the amplitude vanishes to 1e-16
}

TEST_CASE("one film is Airy's sum") {
    oracle::Random random(11);
    for (int i = 0; i < 300; ++i) {
        const double n0 = random.uniform(1, 1.6);
        const double absorption = i % 2 ? random.uniform(0, 1) : 0;
        const Complex n1(random.uniform(1.2, 2.7), absorption);
        const Complex n2(random.uniform(0.1, 3), random.uniform(0, 4));
        const double d = random.uniform(0, 2000), angle = random.uniform(0, 89);
        const double wavelength = random.uniform(300, 900);
        CAPTURE(n0, n1, n2, d, angle, wavelength);
        const Powers power = ask(one_film(n0, n1, d, n2), wavelength, angle);
        for (const auto& [polarization, R] :
             {std::pair(Polarization::s, power.s.R), std::pair(Polarization::p, power.p.R)}) {
            const Complex x =
                std::exp(Complex(0, 4 * kPi * d / wavelength) * normal_index(n1, n0, angle));
            const Complex r01 = fresnel(n0, n1, n0, angle, polarization);
            const Complex r12 = fresnel(n1, n2, n0, angle, polarization);
            // the phase 4 pi d n / lambda, up to 250, is rounded in both computations
            CHECK_THAT(R, WithinAbs(std::norm((r01 + r12 * x) / (1.0 + r01 * r12 * x)), 2e-13));
        }
    }
}

TEST_CASE("a thick absorber follows Beer and Lambert") {
    const Complex n(2, 2);
    const double wavelength = 550;
    const auto T = [&](double d) { return ask(one_film(1, n, d, 1.5), wavelength, 0).s.T; };
    // only the leading term; the next is exp(-2 * 45.7) smaller
    const double amplitude = std::norm(2.0 / (1.0 + n) * (2.0 * n) / (n + 1.5));
    const double d = 1000;
    CHECK_THAT(T(d), WithinRel(1.5 * amplitude * std::exp(-8 * kPi * d / wavelength), 1e-12));
    // 60-digit evaluation of 1 | 2+2i@10000 | 1.5; the exponent 457 is accurate to 6e-14
    CHECK_THAT(T(10000), WithinRel(3.1897903076684135e-199, 2e-13));
    CHECK(T(1e6) == 0);
    const Power thick = ask(one_film(1, n, 1e9, 1.5), wavelength, 0).s;
    CHECK_THAT(thick.R, WithinAbs(5.0 / 13, kRounding));
    CHECK_THAT(thick.A, WithinAbs(8.0 / 13, kRounding));
}

TEST_CASE("reflectances agree with 60 digits") {
    // 60-digit evaluations, rounded to double
    StackBuilder b;
    b.add(StackBuilder::group(12, {b.layer(2.3, 60), b.layer(1.46, 94)}));
    const Stack mirror = b.over(1.52);
    CHECK_THAT(ask(mirror, 550, 0).s.R, WithinAbs(0.9999517685595919, 1e-14));
    CHECK_THAT(ask(mirror, 550, 0).s.T, WithinRel(4.823144040809519e-05, 1e-12));
    CHECK_THAT(ask(mirror, 480, 30).p.T, WithinRel(0.0018262958287518028, 1e-12));
    CHECK_THAT(ask(mirror, 550, 30).s.T, WithinRel(2.5394279637303244e-05, 1e-12));
    const Powers coated = ask(one_film(1, 1.38, 99.6, 1.52), 450, 45);
    CHECK_THAT(coated.s.R, WithinAbs(0.03735149603888593, kRounding));
    CHECK_THAT(coated.p.R, WithinAbs(0.000995610542102046, kRounding));
    CHECK_THAT(ask(one_film(1, 1.46, 120, {4.08, 0.04}), 550, 60).u.R,
               WithinAbs(0.11229789059384718, kRounding));
}

namespace {

using Wide = long double;

/// R of N two-layer periods embedded in their first material, in long double: P. Yeh, Optical Waves
/// in Layered Media (1988), eq. 6.3-9: 1/R = 1 + (sin K / sin NK)^2 / |C|^2.
Wide yeh(double n1, double d1, double n2, double d2, double wavelength, double angle_deg,
         Polarization polarization, int periods) {
    const Wide k0 = 2 * std::numbers::pi_v<Wide> / wavelength;
    const Wide angle = angle_deg * std::numbers::pi_v<Wide> / 180;
    const Wide sine = n1 * std::sin(angle);
    const Wide q1 = n1 * std::cos(angle), q2 = std::sqrt(Wide(n2) * n2 - sine * sine);
    const Wide a = k0 * d1 * q1, b = k0 * d2 * q2;
    const Wide q =
        polarization == Polarization::s ? q2 / q1 : (Wide(n1) * n1 * q2) / (Wide(n2) * n2 * q1);
    const Wide half_trace = std::cos(a) * std::cos(b) - (q + 1 / q) / 2 * std::sin(a) * std::sin(b);
    const Wide c2 = std::pow((q - 1 / q) / 2 * std::sin(b), 2);
    Wide u = 0;
    if (std::abs(half_trace) < 1) {
        const Wide bloch = std::acos(half_trace);
        u = std::sin(periods * bloch) / std::sin(bloch);
    } else {
        const Wide bloch = std::acosh(std::abs(half_trace));
        u = std::sinh(periods * bloch) / std::sinh(bloch);
    }
    if (!std::isfinite(u)) return 1;
    return c2 * u * u / (1 + c2 * u * u);
}

}  // namespace

TEST_CASE("a Bragg mirror is Yeh's closed form") {
    for (const int periods : {1, 2, 3, 10, 57, 100, 1000}) {
        StackBuilder b(1.46);
        b.add(StackBuilder::group(static_cast<std::uint64_t>(periods),
                                  {b.layer(1.46, 94), b.layer(2.3, 60)}));
        const Stack mirror = b.over(1.46);
        for (const double wavelength : {380.0, 430.5, 476.0, 520.0, 550.0, 610.0, 655.0, 800.0}) {
            for (const double angle : {0.0, 33.0, 80.0}) {
                CAPTURE(periods, wavelength, angle);
                const Powers power = ask(mirror, wavelength, angle);
                // the Bloch phase is accurate to a few 1e-16 per period, multiplied by N; next to a
                // band edge it is the square root of a rounded quantity
                const double tolerance = 1e-13 * (1 + periods);
                CHECK_THAT(power.s.R,
                           WithinAbs(static_cast<double>(yeh(1.46, 94, 2.3, 60, wavelength, angle,
                                                             Polarization::s, periods)),
                                     tolerance));
                CHECK_THAT(power.p.R,
                           WithinAbs(static_cast<double>(yeh(1.46, 94, 2.3, 60, wavelength, angle,
                                                             Polarization::p, periods)),
                                     tolerance));
            }
        }
    }
}
