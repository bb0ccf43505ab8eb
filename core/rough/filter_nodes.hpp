#pragma once

#include "core/rough/angle_series.hpp"
#include "core/rough/filter.hpp"

namespace irido {

/// Quadrature of anything smooth times F_alpha over theta_d, for one theta_i.
///
/// F peaks at theta_d = theta_i within alpha, and beyond the kink at theta_k = 90 - theta_i it is a
/// smooth function of v = sqrt(theta_d - theta_k): panels are graded towards the peak, in theta_d
/// before the kink and in v behind it, where theta_d = theta_k + v^2. With T = 1 the sum over a
/// quarter turn is G1(theta_i) to 1e-13.
class FilterNodes {
public:
    /// The facets that straight light meets: those it comes in through, or from behind, with the
    /// weight TransmissionFilter::behind().
    enum class Facets { seen, behind };

    FilterNodes(const TransmissionFilter& filter, double theta_i_deg, SimdLevel simd,
                Facets facets = Facets::seen);

    /// Nodes of 16-point Gauss rules and their weights F_alpha dtheta_d, between two angles.
    WeightedAngles operator()(double begin_deg, double end_deg) const;

private:
    const TransmissionFilter& filter_;
    double theta_i_deg_, kink_deg_;
    SimdLevel simd_;
    Facets facets_;
    std::vector<double> before_, behind_;  ///< ends of panels: theta_d and v = sqrt(theta_d - kink)
};

}  // namespace irido
