#include "core/periodic/bloch.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace irido {

namespace {

double admittance(double n, double n0, IncidentAngle incidence, Polarization polarization) {
    const double q2 = medium(n, n0, incidence).q2.real();
    if (!(q2 > 0))
        throw DomainError("there are no Bloch waves past the critical angle of an index (n = " +
                          to_text(n) + ")");
    return polarization == Polarization::s ? std::sqrt(q2) : n * n / std::sqrt(q2);
}

/// x^n by squaring.
Complex whole_power(Complex x, std::uint64_t n) {
    Complex result = 1;
    for (; n > 0; n >>= 1) {
        if (n & 1) result *= x;
        x *= x;
    }
    return result;
}

/// cos NKL and sin NKL / sin KL in a band; in a gap, both times a common factor.
struct Periods {
    double cosine, U;
    double log_scale;
};

Periods periods(const BlochPoint& at, std::uint64_t repeat) {
    const auto N = static_cast<double>(repeat);
    if (at.sin2 > 0 && at.cos2 > 0) {
        const double sine = 2 * std::sqrt(at.sin2 * at.cos2);
        const Complex z = whole_power({at.cos2 - at.sin2, sine}, repeat);
        return {z.real(), z.imag() / sine, 0};
    }
    // cos KL = cosh kappa, or -cosh kappa, which flips the sign of the matrix and of u and v
    const double x = std::max(0.0, -std::min(at.sin2, at.cos2));
    const double kappa = 2 * std::asinh(std::sqrt(x)), sinh_kappa = 2 * std::sqrt(x * (1 + x));
    const double e = std::exp(-2 * N * kappa);
    const double tanh = sinh_kappa > 0 ? -std::expm1(-2 * N * kappa) / (1 + e) / sinh_kappa : N;
    return {1, at.cos2 < at.sin2 ? -tanh : tanh, N * kappa - std::log(2) + std::log1p(e)};
}

}  // namespace

BlochMirror bloch_mirror(const RealLayer& first, const RealLayer& second, std::uint64_t repeat,
                         double n0, double n_out, IncidentAngle incidence,
                         Polarization polarization) {
    BlochMirror mirror;
    mirror.period = bragg_period(first, second, n0, incidence, polarization);
    const auto of = [&](double n) { return admittance(n, n0, incidence, polarization); };
    mirror.Y_in = of(n0);
    mirror.Y_out = of(n_out);
    mirror.Y_first = of(first.n);
    mirror.Y_second = of(second.n);
    mirror.repeat = repeat;
    return mirror;
}

BlochPoint bloch_point(const BlochMirror& mirror, double omega_per_nm) {
    const double a = omega_per_nm * mirror.period.path1_nm;
    const double b = omega_per_nm * mirror.period.path2_nm;
    const double Y1 = mirror.Y_first, Y2 = mirror.Y_second, q = Y2 / Y1;
    const double sin_h = std::sin((a + b) / 2), cos_h = std::cos((a + b) / 2);
    const double sin_g = std::sin((a - b) / 2), cos_g = std::cos((a - b) / 2);
    const auto F = [&](double r) { return ((1 + r) * sin_h + (1 - r) * sin_g) / 2; };
    const auto G = [&](double r) { return ((1 + r) * cos_h + (1 - r) * cos_g) / 2; };
    const double sin_a = sin_h * cos_g + cos_h * sin_g, cos_a = cos_h * cos_g - sin_h * sin_g;
    const double sin_b = sin_h * cos_g - cos_h * sin_g, cos_b = cos_h * cos_g + sin_h * sin_g;
    const double M12 = cos_a * sin_b / Y2 + sin_a * cos_b / Y1;
    const double M21 = Y1 * sin_a * cos_b + Y2 * cos_a * sin_b;
    return {F(q) * F(1 / q), G(q) * G(1 / q),
            (mirror.Y_in - mirror.Y_out) * (1 / q - q) / 2 * sin_a * sin_b,
            std::abs(mirror.Y_in * mirror.Y_out * M12 + M21)};
}

double bloch_phase_slope(const BraggPeriod& period, double omega_per_nm) {
    const double a = omega_per_nm * period.path1_nm, b = omega_per_nm * period.path2_nm;
    const double q = period.admittance_ratio, Q = (q + 1 / q) / 2;
    const double sin_a = std::sin(a), cos_a = std::cos(a);
    const double sin_b = std::sin(b), cos_b = std::cos(b);
    const double cosine = cos_a * cos_b - Q * sin_a * sin_b;
    const double fall = period.path1_nm * (sin_a * cos_b + Q * cos_a * sin_b) +
                        period.path2_nm * (cos_a * sin_b + Q * sin_a * cos_b);
    return fall / std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
}

double bloch_transmittance(const BlochMirror& mirror, double omega_per_nm) {
    const BlochPoint at = bloch_point(mirror, omega_per_nm);
    const auto [cosine, U, log_scale] = periods(at, mirror.repeat);
    const double P = mirror.Y_in + mirror.Y_out;
    const double down = P * cosine + at.u * U, across = at.v * U;
    return 4 * mirror.Y_in * mirror.Y_out * std::exp(-2 * log_scale) /
           (down * down + across * across);
}

BlochSeries bloch_series(const BlochMirror& mirror, double omega_per_nm) {
    const BlochPoint at = bloch_point(mirror, omega_per_nm);
    const double sine = 2 * std::sqrt(std::max(0.0, at.sin2) * std::max(0.0, at.cos2));
    const double P = mirror.Y_in + mirror.Y_out;
    // all scaled by sin(KL)^2 / (4 Y_in Y_out)
    const double p = P * sine, A = (p * p + at.u * at.u + at.v * at.v) / 2, root = p * at.v;
    const Complex B{(p * p - at.u * at.u - at.v * at.v) / 2, -p * at.u};
    return {4 * mirror.Y_in * mirror.Y_out * sine / (P * at.v),
            -B / (A + root) * whole_power({at.cos2 - at.sin2, sine}, 2 * mirror.repeat)};
}

}  // namespace irido
