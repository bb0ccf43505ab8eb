#include "core/spectrum/ellipsometry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/incoherent/cross_reflection.hpp"

namespace irido {

namespace {

constexpr double kInDegrees = 180 / std::numbers::pi;

/// [0, 360)
double whole_turn(double angle_deg) {
    const double turned = angle_deg < 0 ? angle_deg + 360 : angle_deg;
    return turned >= 360 ? 0 : turned + 0.0;
}

}  // namespace

EllipsometricAngles ellipsometric_angles(Complex r_s, Complex r_p) {
    const double s = std::abs(r_s), p = std::abs(r_p);
    if (s == 0 && p == 0) return {45, 0};
    const double psi_deg = std::atan2(p, s) * kInDegrees;
    if (s == 0 || p == 0) return {psi_deg, 0};
    const double delta_deg = std::arg((r_p / p) * std::conj(r_s / s)) * kInDegrees;
    return {psi_deg, delta_deg <= -180 ? 180 : delta_deg};
}

Ellipsometry ellipsometry(Complex r_s, Complex r_p) {
    const EllipsometricAngles angles = ellipsometric_angles(r_s, r_p);
    const double s = std::abs(r_s), p = std::abs(r_p), size = std::hypot(s, p);
    if (size == 0) return {};
    const Complex cross = -2.0 * std::conj((r_p / size) * std::conj(r_s / size));
    return {angles.psi_deg,
            whole_turn(180 - angles.delta_deg),
            (s - p) / size * ((s + p) / size),
            cross.real() + 0.0,
            cross.imag() + 0.0,
            0};
}

Ellipsometry ellipsometry(double R_s, double R_p, Complex cross) {
    const double sum = R_s + R_p;
    if (!(sum > 0)) return {};
    const double N = (R_s - R_p) / sum;
    const Complex both = -2.0 * std::conj(cross) / sum;
    const double C = both.real() + 0.0, S = both.imag() + 0.0;
    return {std::atan2(std::hypot(C, S), N) / 2 * kInDegrees,
            whole_turn(C == 0 && S == 0 ? 180 : std::atan2(S, C) * kInDegrees),
            N,
            C,
            S,
            std::clamp(1 - N * N - C * C - S * S, 0.0, 1.0)};
}

Ellipsometry ellipsometry(const StackPower& stack, std::span<const Medium> media_s,
                          std::span<const Medium> media_p, double k0) {
    const ChainLight s(*stack.chain(), media_s, k0, Polarization::s);
    const ChainLight p(*stack.chain(), media_p, k0, Polarization::p);
    if (s.last_block() == 0) return ellipsometry(s.response().r, p.response().r);
    // ChainLight::response() of several blocks has powers only
    return ellipsometry(s.response().power.R, p.response().power.R, cross_reflection(s, p));
}

}  // namespace irido
