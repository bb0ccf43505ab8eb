#pragma once

namespace irido::tables {

/// A pair of directions above the surface: polar angles in degrees, [0, 90), and cos and sin of
/// half the azimuth between them.
struct TablePair {
    double theta_i_deg, theta_o_deg, near, far;
};

/// Half-angle coordinates of two directions i and o: theta_h of h = (i + o)/|i + o| against the
/// normal, and theta_d, phi_d of i about h, phi_d being 0 where i leans further from the normal in
/// the plane of h. Source: S. Rusinkiewicz, EGSR 1998, section 3.
struct HalfAngles {
    double theta_h_deg, theta_d_deg, phi_d_deg;
};

struct HalfAnglePair {
    TablePair pair;  ///< a direction below the horizon lifted to just above it
    HalfAngles angles;
    bool is_above;  ///< whether both directions are above the horizon
};

HalfAnglePair directions_of(const HalfAngles& angles);

}  // namespace irido::tables
