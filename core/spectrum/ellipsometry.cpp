#include "core/spectrum/ellipsometry.hpp"

#include <cmath>
#include <numbers>

namespace irido {

EllipsometricAngles ellipsometric_angles(Complex r_s, Complex r_p) {
    constexpr double degrees = 180 / std::numbers::pi;
    const double s = std::abs(r_s), p = std::abs(r_p);
    if (s == 0 && p == 0) return {45, 0};
    const double psi_deg = std::atan2(p, s) * degrees;
    if (s == 0 || p == 0) return {psi_deg, 0};
    const double delta_deg = std::arg((r_p / p) * std::conj(r_s / s)) * degrees;
    return {psi_deg, delta_deg <= -180 ? 180 : delta_deg};
}

}  // namespace irido
