#include <catch2/catch.hpp>
#include <cmath>

#include "core/math/constants.hpp"
#include "core/spectrum/ellipsometry.hpp"
#include "tests/core/coherent/ask.hpp"
#include "tests/oracle/random_stacks.hpp"

using namespace irido;
using Catch::WithinAbs;
using oracle::StackBuilder;

namespace {

EllipsometricAngles angles_of(const Stack& stack, double wavelength_nm, double angle_deg) {
    const IndexTable table(stack, {wavelength_nm});
    const double cosine = cos_of_incidence(angle_deg);
    Needs needs;
    needs.amplitudes = true;
    const Spectra at = spectra(StackPower(stack), table, std::span(&cosine, 1), needs);
    return ellipsometric_angles(at.s.r[0], at.p.r[0]);
}

}  // namespace

TEST_CASE("psi and delta of bare glass") {
    const Stack glass = StackBuilder(1).over(1.5);
    CHECK_THAT(angles_of(glass, 550, 0).psi_deg, WithinAbs(45, 1e-12));
    CHECK(angles_of(glass, 550, 0).delta_deg == 0);
    for (const double angle : {10.0, 40.0, 56.0, 57.0, 70.0, 89.0}) {
        // Fresnel: |rho| = |cos(i + t) / cos(i - t)|, and r_p changes sign at Brewster's angle
        const double i = angle * kPi / 180, t = std::asin(std::sin(i) / 1.5);
        const EllipsometricAngles at = angles_of(glass, 550, angle);
        CAPTURE(angle);
        CHECK_THAT(
            at.psi_deg,
            WithinAbs(std::atan(std::abs(std::cos(i + t) / std::cos(i - t))) * 180 / kPi, 1e-12));
        CHECK(at.delta_deg == (angle < 56.3 ? 0 : 180));
    }
    CHECK(angles_of(glass, 550, std::atan(1.5) * 180 / kPi).psi_deg < 1e-13);
}

TEST_CASE("psi and delta of a metal give back its index") {
    // eps = sin^2 (1 + tan^2 ((1 - rho)/(1 + rho))^2) for rho in the other convention, Azzam and
    // Bashara (1977), eq. 4.2; ours has the opposite sign
    const Complex index(0.27, 2.95);
    const Stack gold = StackBuilder(1).over(index);
    for (const double angle : {30.0, 60.0, 72.0}) {
        const EllipsometricAngles at = angles_of(gold, 600, angle);
        const Complex rho =
            -std::tan(at.psi_deg * kPi / 180) * std::polar(1.0, at.delta_deg * kPi / 180);
        const double sine = std::sin(angle * kPi / 180), tangent = std::tan(angle * kPi / 180);
        const Complex ratio = (1.0 - rho) / (1.0 + rho);
        const Complex eps = sine * sine * (1.0 + tangent * tangent * ratio * ratio);
        CHECK(std::abs(eps - index * index) < 1e-12);
    }
}

TEST_CASE("total reflection turns p against s as Fresnel's rhomb does") {
    // tan(D/2) = cos i sqrt(sin^2 i - 1/n^2) / sin^2 i, M. Born and E. Wolf, section 1.5.4
    const Stack glass = StackBuilder(1.51).over(1);
    for (const double angle : {48.6166, 54.6166, 70.0}) {
        const double i = angle * kPi / 180, sine = std::sin(i);
        const double turn =
            2 * std::atan(std::cos(i) * std::sqrt(sine * sine - 1 / (1.51 * 1.51)) / (sine * sine));
        const EllipsometricAngles at = angles_of(glass, 550, angle);
        CHECK_THAT(at.psi_deg, WithinAbs(45, 1e-12));
        CHECK_THAT(180 - std::abs(at.delta_deg), WithinAbs(turn * 180 / kPi, 1e-11));
    }
}

TEST_CASE("a quarter-wave film reflects half a turn") {
    // r = (n0 ns - n1^2)/(n0 ns + n1^2), real, for both polarizations at normal incidence
    StackBuilder b;
    b.add(b.layer(1.38, 550 / 4.0 / 1.38));
    const Stack stack = b.over(1.52);
    const IndexTable table(stack, {550});
    const double cosine = 1;
    Needs needs;
    needs.amplitudes = true;
    const Spectra at = spectra(StackPower(stack), table, std::span(&cosine, 1), needs);
    const double r = (1.52 - 1.38 * 1.38) / (1.52 + 1.38 * 1.38);
    CHECK(std::abs(at.s.r[0] - r) < 1e-15);
    CHECK(at.p.r[0] == at.s.r[0]);
    // |t| from T, with a phase of a quarter period: t = 2 i n0 n1 / (...)
    CHECK(std::abs(at.s.t[0] - Complex(0, 2 * 1.38 / (1.52 + 1.38 * 1.38))) < 1e-15);
}

TEST_CASE("psi and delta are never NaN") {
    CHECK(ellipsometric_angles(0, 0).psi_deg == 45);
    CHECK(ellipsometric_angles(0, 0).delta_deg == 0);
    CHECK(ellipsometric_angles(0, 1).psi_deg == 90);
    CHECK(ellipsometric_angles(0, 1).delta_deg == 0);
    CHECK(ellipsometric_angles(1, 0).psi_deg == 0);
    CHECK(ellipsometric_angles(-1, {1, -0.0}).delta_deg == 180);
    CHECK(ellipsometric_angles(-1, {1, 0.0}).delta_deg == 180);
    CHECK_THAT(ellipsometric_angles({1e-200, 0}, {0, 1e-200}).delta_deg, WithinAbs(90, 1e-13));
}
