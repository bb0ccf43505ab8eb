#include "core/math/faddeeva.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/error.hpp"
#include "core/math/constants.hpp"

namespace irido {

namespace {

constexpr std::size_t kSteps = 12;
const double kStep = std::sqrt(kPi / static_cast<double>(kSteps + 1));

/// Points (k + shift) kStep of a rule, squared, with the integrand's numerator there.
struct WaveRule {
    explicit WaveRule(double shift) {
        for (std::size_t k = 0; k < kSteps; ++k) {
            const double t = (static_cast<double>(k) + shift) * kStep;
            square[k] = t * t;
            weight[k] = std::exp(-t * t);
        }
    }
    std::array<double, kSteps> square{}, weight{};
};

Complex sum_of(const WaveRule& rule, const Complex& z) {
    const double re = z.real() * z.real() - z.imag() * z.imag(), im = 2 * z.real() * z.imag();
    double real = 0, imaginary = 0;
    for (std::size_t k = kSteps; k-- > 0;) {
        const double d = re - rule.square[k], scale = rule.weight[k] / (d * d + im * im);
        real += scale * d;
        imaginary -= scale * im;
    }
    return Complex(0, 2 * kStep / kPi) * z * Complex(real, imaginary);
}

/// w for x, y >= 0.
Complex first_quadrant(double x, double y) {
    static const WaveRule midpoints(0.5), trapezoid(1);
    constexpr double kFar = 1e7;  // i/(sqrt(pi) z) (1 + 1/(2 z^2) ...)
    const Complex z(x, y);
    if (x > kFar || y > kFar) return Complex(0, 1 / std::sqrt(kPi)) / z;
    if (y >= std::max(x, kPi / kStep)) return sum_of(midpoints, z);
    const double turns = x / kStep, place = turns - std::floor(turns);
    const bool near_midpoint = y < x && place >= 0.25 && place <= 0.75;
    const Complex sum =
        near_midpoint ? Complex(0, kStep / kPi) / z + sum_of(trapezoid, z) : sum_of(midpoints, z);
    if (y >= kPi / kStep) return sum;
    const Complex residue = std::exp(-z * z);
    const Complex wave = std::exp(Complex(0, -kTwoPi / kStep) * z);
    return sum + 2.0 * residue / (near_midpoint ? 1.0 - wave : 1.0 + wave);
}

}  // namespace

Complex faddeeva(const Complex& z) {
    require_in_range("Im z", z.imag(), 0, kInfinity);
    require_in_range("Re z", z.real(), -kInfinity, kInfinity);
    if (std::isinf(z.real()) || std::isinf(z.imag())) return 0;
    const Complex w = first_quadrant(std::abs(z.real()), z.imag());
    return z.real() < 0 ? std::conj(w) : w;
}

}  // namespace irido
