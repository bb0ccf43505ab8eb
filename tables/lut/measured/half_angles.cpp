#include "tables/lut/measured/half_angles.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"

namespace irido::tables {

namespace {

/// Cosine of the polar angle just above the horizon.
constexpr double kJustAbove = 1e-4;

}  // namespace

HalfAnglePair directions_of(const HalfAngles& angles) {
    const double sd = sin_deg(angles.theta_d_deg), cd = cos_deg(angles.theta_d_deg);
    const double dx = sd * cos_deg(angles.phi_d_deg), dy = sd * sin_deg(angles.phi_d_deg);
    const double sh = sin_deg(angles.theta_h_deg), ch = cos_deg(angles.theta_h_deg);
    // both turned from where h is the normal
    const double ix = ch * dx + sh * cd, iz = ch * cd - sh * dx;
    const double ox = sh * cd - ch * dx, oz = ch * cd + sh * dx;
    const auto theta_deg = [](double across, double height) {
        return std::atan2(across, std::max(height, kJustAbove)) / kDegree;
    };
    const double turn = std::atan2(-ix * dy - dy * ox, ix * ox - dy * dy);
    return {{theta_deg(std::hypot(ix, dy), iz), theta_deg(std::hypot(ox, dy), oz),
             std::abs(std::cos(0.5 * turn)), std::abs(std::sin(0.5 * turn))},
            angles,
            iz > 0 && oz > 0};
}

}  // namespace irido::tables
