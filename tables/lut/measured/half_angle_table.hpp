#pragma once

#include <functional>
#include <vector>

#include "core/colorimetry/space.hpp"
#include "tables/lut/lut_kind.hpp"
#include "tables/lut/measured/half_angles.hpp"

namespace irido::tables {

/// A BRDF of a surface that looks the same from every azimuth, over half-angle coordinates.
struct HalfAngleTable {
    /// Samples, degrees, strictly monotonic; none: as many as there are by default. theta_h then
    /// lies equally spaced in theta_h / (theta_h + scale), closest in the lobe.
    std::vector<double> theta_h_deg, theta_d_deg, phi_d_deg;
    double alpha = 0.1;                               ///< of the narrowest lobe
    std::function<Triple(const HalfAnglePair&)> xyz;  ///< of the BRDF, per steradian; thread-safe
    RgbTransform transform;                           ///< to the table's values
    Triple white;                                     ///< of the illuminant
    bool is_xyz = false;                              ///< whether values are X, Y, Z
};

/// Axes phi_d, theta_h, theta_d. f(phi_d) = f(-phi_d) = f(phi_d + 180), so that phi_d from 0 to 90
/// is all. Samples with a direction below the horizon continue those above it; the error, CIEDE2000
/// of pi times the BRDF, is measured where both directions are up to 85 degrees from the normal.
LutPlan half_angle_plan(HalfAngleTable table);

/// half_at of the axis of theta_h for a roughness, degrees: between alpha and the quarter turn, so
/// that neither the lobe nor its tail has too few of 128 samples.
double half_angle_scale_deg(double alpha);

}  // namespace irido::tables
