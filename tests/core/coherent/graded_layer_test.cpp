#include "core/coherent/graded_layer.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.hpp"
#include "core/material/index_series.hpp"
#include "core/math/constants.hpp"
#include "core/spectrum/spectrum.hpp"
#include "core/stack/builder.hpp"
#include "core/stack/reversed.hpp"

using namespace irido;
using Catch::WithinAbs;

namespace {

Material constant(Complex index) {
    return {"c", RefractiveIndex{Constant{index.real()}, Constant{index.imag()}}, Outside::refuse};
}

constexpr std::array kProfiles{GradedProfile::n, GradedProfile::eps, GradedProfile::exp,
                               GradedProfile::inverse_n};

Stack graded_stack(double n0, Complex from, Complex to, GradedProfile profile, double thickness_nm,
                   Complex substrate) {
    StackBuilder b(n0);
    const GradedLayer layer =
        graded_layer(constant(from), constant(to), profile, thickness_nm, n0, "graded");
    const auto count = static_cast<double>(layer.parts.size());
    for (const Material& part : layer.parts)
        b.add(StackBuilder::layer_of(b.material(part), thickness_nm / count));
    return b.over(substrate);
}

Spectra spectra_of(const Stack& stack, double nm, double angle_deg, const Needs& needs = {}) {
    const IndexTable table(stack, {nm});
    const IncidentAngle at = incident_angle(angle_deg);
    return spectra(StackPower(stack), table, {&at, 1}, needs);
}

/// r from the field equations, dB/dz = i k0 G C, dC/dz = i k0 Q B integrated downwards in classical
/// Runge-Kutta steps; s: G = 1, Q = eps - S^2; p: G = 1 - S^2/eps, Q = eps.
Complex by_runge_kutta(double n0, Complex n1, Complex n2, GradedProfile profile, double d,
                       Complex ns, double nm, double angle_deg, bool is_s) {
    const double across = n0 * std::sin(angle_deg * kDegree), s2 = across * across;
    const double k0 = kTwoPi / nm, along = n0 * std::cos(angle_deg * kDegree);
    const Complex kz = std::sqrt(ns * ns - s2);
    std::array<Complex, 2> at{is_s ? 1.0 : kz, is_s ? kz : ns * ns};
    using Pair = std::array<Complex, 2>;
    const auto slope = [&](double t, const Pair& f) {
        const Complex eps = graded_permittivity(profile, n1, n2, t);
        const Complex g = is_s ? 1.0 : 1.0 - s2 / eps, q = is_s ? eps - s2 : eps;
        return Pair{Complex(0, -1) * k0 * g * f[1], Complex(0, -1) * k0 * q * f[0]};  // upwards
    };
    constexpr int kSteps = 20000;
    const double h = d / kSteps;
    const auto moved = [](const Pair& f, double by, const Pair& along_it) {
        return Pair{f[0] + by * along_it[0], f[1] + by * along_it[1]};
    };
    for (int i = 0; i < kSteps; ++i) {
        const double t = 1 - static_cast<double>(i) / kSteps, half = t - 0.5 / kSteps,
                     next = t - 1.0 / kSteps;
        const Pair a = slope(t, at), b = slope(half, moved(at, h / 2, a)),
                   c = slope(half, moved(at, h / 2, b)), e = slope(next, moved(at, h, c));
        for (std::size_t j = 0; j < 2; ++j)
            at[j] += h / 6 * (a[j] + 2.0 * b[j] + 2.0 * c[j] + e[j]);
    }
    const double y0 = is_s ? along : n0 * n0 / along;
    return (y0 * at[0] - at[1]) / (y0 * at[0] + at[1]);
}

}  // namespace

TEST_CASE("a layer whose 1/n is linear has a closed form", "[graded]") {
    // Lord Rayleigh, Proc. London Math. Soc. 11, 51 (1880), between media with the end indices
    const double n1 = 1.5, n2 = 2.5, d = 150, nm = 550;
    const double kappa = kTwoPi * n1 / (nm * std::abs(n1 / n2 - 1) / d);
    const double m = std::sqrt(kappa * kappa - 0.25);
    const double s = std::pow(std::sin(m * std::log(n2 / n1)), 2);
    const double expected = s / (s + 4 * m * m);
    CHECK_THAT(expected, WithinAbs(1.0394353233e-4, 1e-13));
    const Stack stack = graded_stack(n1, n1, n2, GradedProfile::inverse_n, d, n2);
    CHECK_THAT(spectra_of(stack, nm, 0).s.R[0], WithinAbs(expected, 1e-10));
}

TEST_CASE("graded layers agree with the integrated fields", "[graded]") {
    struct Case {
        double n0;
        Complex n1, n2;
        double d;
        Complex ns;
    };
    const std::vector<Case> cases{{1, 1.1, 2.3, 600, 1.5},
                                  {1, {2.2, 0.3}, 1.3, 400, {3.8, 0.02}},
                                  {1.5, 1.45, 1.2, 300, 1.0},
                                  {1, {0.3, 2.5}, {1.5, 0.5}, 80, 1.5}};
    Needs needs;
    needs.amplitudes = true;
    for (const auto& [n0, n1, n2, d, ns] : cases)
        for (const GradedProfile profile : kProfiles)
            for (const double angle : {0.0, 55.0}) {
                const Stack stack = graded_stack(n0, n1, n2, profile, d, ns);
                const Spectra found = spectra_of(stack, 450, angle, needs);
                for (const bool is_s : {true, false}) {
                    const Complex expected =
                        by_runge_kutta(n0, n1, n2, profile, d, ns, 450, angle, is_s);
                    INFO(n1 << " " << n2 << " " << static_cast<int>(profile) << " " << angle);
                    CHECK(std::abs((is_s ? found.s.r[0] : found.p.r[0]) - expected) < 1e-9);
                }
            }
}

TEST_CASE("parts keep energy and reciprocity, and their number is no more than needed",
          "[graded]") {
    for (const GradedProfile profile : kProfiles) {
        const Stack stack = graded_stack(1, 1.2, {2.4, 0.2}, profile, 500, 1.5);
        const double angle = 48, back = std::asin(std::sin(angle * kDegree) / 1.5) / kDegree;
        const Spectra down = spectra_of(stack, 500, angle);
        const Spectra up = spectra_of(reversed(stack), 500, back);
        CHECK_THAT(down.s.T[0], WithinAbs(up.s.T[0], 1e-13));
        CHECK_THAT(down.p.T[0], WithinAbs(up.p.T[0], 1e-13));
        CHECK_THAT(down.p.R[0] + down.p.T[0] + down.p.A[0], WithinAbs(1, 1e-13));
        CHECK(down.p.A[0] > 0);
    }
    const auto parts = [](Complex to, double d) {
        return graded_layer(constant(1.5), constant(to), GradedProfile::n, d, 1, "").parts.size();
    };
    CHECK(parts(1.5, 1000) == 4);
    CHECK(parts(1.52, 100) < 200);
    CHECK(parts(2.5, 100) < parts(2.5, 400));
    const GradedLayer wild = graded_layer(constant(1.2), constant(3), GradedProfile::n, 2e5, 1, "");
    CHECK(wild.parts.size() == 2 * kMostGradedSteps);
    CHECK(wild.error > kGradedError);
}

TEST_CASE("graded layers of materials with dispersion", "[graded]") {
    const Material glass{"g", RefractiveIndex{Formula{5, {1.5, 0.01, -2}, kAllWavelengths}}, {}};
    const Material table{"t", RefractiveIndex{Table{{400, 500, 700}, {2.3, 2.2, 2.1}}}, {}};
    const GradedLayer layer = graded_layer(glass, table, GradedProfile::exp, 300, 1, "/graded");
    REQUIRE(layer.parts.size() > 8);
    const Material& part = layer.parts[5];
    CHECK(is_uniaxial(part));
    CHECK_FALSE(is_constant(part));
    CHECK(range_of(part) == WavelengthRange{400, 700});
    CHECK(kinks(part, {300, 800}) == std::vector<double>{400, 500, 700});
    CHECK_THROWS_WITH(index_at(part, 800), Catch::Contains("t is known from 400 to 700 nm"));
    // at a single wavelength the same as constants
    const Material held =
        graded_layer(constant(index_at(glass, 600)), constant(index_at(table, 600)),
                     GradedProfile::exp, 300, 1, "")
            .parts[0];
    const GradedHalfStep step(5, layer.parts.size() / 2);
    const auto eps =
        step.permittivity(GradedProfile::exp, index_at(glass, 600), index_at(table, 600));
    CHECK(std::abs(index_at(part, 600) - std::sqrt(eps[0])) < 1e-15);
    CHECK(std::abs(extraordinary_index_at(part, 600) - std::sqrt(eps[1])) < 1e-15);
    CHECK(std::abs(index_at(held, 600).real() - index_at(glass, 600).real()) < 0.1);
    // derivatives of both indices
    for (const auto& [at, series] : {std::pair{&index_at, &index_series},
                                     std::pair{&extraordinary_index_at, &extraordinary_series}}) {
        const auto value = [&, f = at](double x) { return f(part, 600 / (1 + x)); };
        constexpr double h = 1e-3;
        const Complex slope =
            (8.0 * (value(h) - value(-h)) - (value(2 * h) - value(-2 * h))) / (12 * h);
        CHECK(std::abs(series(part, 600)[1] - slope) < 1e-9);
    }
}
