#include "core/scratch/scratch.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/math/degrees.hpp"

namespace irido {

UnitVector direction_of(double theta_deg, double phi_deg) {
    require_in_range("theta_deg", theta_deg, 0, 90);
    require_in_range("phi_deg", phi_deg, -360, 360);
    const double sine = sin_deg(theta_deg);
    return {sine * cos_deg(phi_deg), sine * sin_deg(phi_deg), sin_deg(90 - theta_deg)};
}

void require_valid(const Scratch& scratch) {
    require_in_range("width_um", scratch.width_um, std::numeric_limits<double>::min(), kWidest_um);
    require_in_range("depth_um", scratch.depth_um, 0, kDeepest_um);
    require_in_range("angle_deg", scratch.angle_deg, -360, 360);
    for (const double place : {scratch.point.x_um, scratch.point.y_um})
        require_in_range("point_um", place, -Scratch::kLongest_um, Scratch::kLongest_um);
    if (!(scratch.start_um < scratch.end_um))
        throw DomainError("start_um must be below end_um (got " + to_text(scratch.start_um) +
                          " and " + to_text(scratch.end_um) + ")");
}

void require_valid(const ScratchOptics& optics) {
    require_in_range("coherence_radius_um", optics.coherence_radius_um,
                     std::numeric_limits<double>::min(), kMostCoherent_um);
}

std::vector<std::string> doubts_about(const Scratch& scratch, const ScratchOptics& optics) {
    constexpr double kWidestShare = 0.2;
    std::vector<std::string> doubts;
    if (scratch.width_um > kWidestShare * optics.coherence_radius_um)
        doubts.push_back("width " + to_text(scratch.width_um) +
                         " um exceeds a fifth of the coherence radius, across which the weight is "
                         "taken to be constant");
    if (scratch.depth_um > scratch.width_um)
        doubts.push_back("depth " + to_text(scratch.depth_um) + " um exceeds the width " +
                         to_text(scratch.width_um) + " um: the model ignores shadows of the walls");
    return doubts;
}

}  // namespace irido
