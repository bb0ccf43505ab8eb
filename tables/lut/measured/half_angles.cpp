#include "tables/lut/measured/half_angles.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"

namespace irido::tables {

namespace {

/// Cosine of the polar angle just above the horizon, and the half vector nearest to it.
constexpr double kJustAbove = 1e-4, kLowestHalf_deg = 89.99;

struct Heights {
    double i, o;  ///< above the surface
};

Heights heights_of(const HalfAngles& angles) {
    const double up = cos_deg(angles.theta_h_deg) * cos_deg(angles.theta_d_deg);
    const double tilt =
        sin_deg(angles.theta_h_deg) * sin_deg(angles.theta_d_deg) * cos_deg(angles.phi_d_deg);
    return {up - tilt, up + tilt};
}

/// The same half vector and phi_d with the largest theta_d at which both directions are above.
HalfAngles lifted(HalfAngles angles) {
    angles.theta_h_deg = std::min(angles.theta_h_deg, kLowestHalf_deg);
    // cos theta_h cos theta_d - sin theta_h |cos phi_d| sin theta_d = kJustAbove
    const double up = cos_deg(angles.theta_h_deg);
    const double tilt = sin_deg(angles.theta_h_deg) * std::abs(cos_deg(angles.phi_d_deg));
    const double end = std::acos(kJustAbove / std::hypot(up, tilt)) - std::atan2(tilt, up);
    angles.theta_d_deg = std::min(angles.theta_d_deg, std::max(0.0, end) / kDegree);
    return angles;
}

}  // namespace

HalfAnglePair directions_of(const HalfAngles& typed) {
    const Heights asked = heights_of(typed);
    const bool is_low = std::min(asked.i, asked.o) < kJustAbove;
    const HalfAngles angles = is_low ? lifted(typed) : typed;
    const double sd = sin_deg(angles.theta_d_deg), cd = cos_deg(angles.theta_d_deg);
    const double dx = sd * cos_deg(angles.phi_d_deg), dy = sd * sin_deg(angles.phi_d_deg);
    const double sh = sin_deg(angles.theta_h_deg), ch = cos_deg(angles.theta_h_deg);
    // horizontal parts, turned from where h is the normal
    const double ix = ch * dx + sh * cd, ox = sh * cd - ch * dx;
    const auto [iz, oz] = heights_of(angles);
    const auto theta_deg = [](double across, double height) {
        return std::atan2(across, std::max(height, kJustAbove / 2)) / kDegree;
    };
    const double turn = std::atan2(-ix * dy - dy * ox, ix * ox - dy * dy);
    return {{theta_deg(std::hypot(ix, dy), iz), theta_deg(std::hypot(ox, dy), oz),
             std::abs(std::cos(0.5 * turn)), std::abs(std::sin(0.5 * turn))},
            asked.i > 0 && asked.o > 0};
}

}  // namespace irido::tables
