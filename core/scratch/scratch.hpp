#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace irido {

/// x, y and z of a unit vector; z is the surface's normal.
using UnitVector = std::array<double, 3>;

/// The direction at an angle theta from the normal and an azimuth phi from x, both in degrees.
///   theta_deg  [0, 90];  phi_deg  [-360, 360], else DomainError
UnitVector direction_of(double theta_deg, double phi_deg);

/// A place on the surface, um.
struct SurfacePoint {
    double x_um = 0, y_um = 0;
};

/// One straight groove of constant width and depth. It runs through a point at an angle from x,
/// from `start` to `end` along it, or without ends.
struct Scratch {
    double width_um = 1;   ///< (0, 100]
    double depth_um = 0;   ///< [0, 100]
    double angle_deg = 0;  ///< [-360, 360]
    SurfacePoint point{};  ///< |x|, |y| <= 1e9
    double start_um = -std::numeric_limits<double>::infinity();
    double end_um = std::numeric_limits<double>::infinity();  ///< above start

    bool is_infinite() const { return start_um < -kLongest_um && end_um > kLongest_um; }
    static constexpr double kLongest_um = 1e9;
};

/// The optical path between a groove's bottom and the surface: twice the depth as in VWH18 eq. 11,
/// or depth (cos theta_i + cos theta_o) as in Werner et al. 2017, which follows the directions.
enum class DepthPhase { slanted, vertical };

/// The waves that reach an eye or a camera from one point add coherently within a Gaussian of this
/// radius: the weight of the field is exp(-r^2/(2 sigma^2)).
struct ScratchOptics {
    double coherence_radius_um = 60;  ///< sigma, (0, 1e4]
    DepthPhase depth_phase = DepthPhase::slanted;
};

inline constexpr double kWidest_um = 100, kDeepest_um = 100, kMostCoherent_um = 1e4;

/// Throws DomainError naming the member unless all members are in range.
void require_valid(const Scratch& scratch);
void require_valid(const ScratchOptics& optics);

/// Where the model's assumptions fail, one line each: a width above a fifth of the coherence radius
/// (the weight is taken to be constant across a scratch) or a depth above the width (walls shadow).
std::vector<std::string> doubts_about(const Scratch& scratch, const ScratchOptics& optics);

}  // namespace irido
