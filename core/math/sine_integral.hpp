#pragma once

namespace irido {

/// The auxiliary functions of the sine integral times powers of x, for x >= kFirstAuxiliary:
///     f(x) = int_0^inf exp(-x t)/(1 + t^2) dt    = (1 - a(x)/x^2)/x,
///     g(x) = int_0^inf t exp(-x t)/(1 + t^2) dt  = b(x)/x^2,
/// so that Si(x) = pi/2 - f cos x - g sin x; a tends to 2, b to 1. Error below 4e-16 relative.
/// Throws DomainError if x < kFirstAuxiliary.
/// Source: M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions, 5.2.12, 5.2.13, 5.2.34,
/// 5.2.35; values by the continued fraction of E_1(i x), 5.1.22.
struct AuxiliarySine {
    double a, b;
};
AuxiliarySine auxiliary_sine(double x);
inline constexpr double kFirstAuxiliary = 4;

/// Si(x) = int_0^x sin(t)/t dt for any real x, infinite ones included; error below 5e-16 relative.
double sine_integral(double x);

/// F(x) = int_0^x sinc(t/2)^2/2 dt = Si(x) - (1 - cos x)/x with sinc(x) = sin(x)/x: the cumulative
/// power diffracted by a slit. Odd, increasing, F(inf) = pi/2; error below 5e-16 relative.
double slit_integral(double x);

/// F(to) - F(from) without cancellation; error below 3e-15 relative, or 3e-15 times the interval's
/// length and the largest sinc^2/2 in it, whichever is larger.
double slit_integral(double from, double to);

}  // namespace irido
