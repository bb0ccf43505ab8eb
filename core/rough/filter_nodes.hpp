#pragma once

#include "core/rough/angle_series.hpp"
#include "core/rough/filter.hpp"

namespace irido {

/// Quadrature over theta_d, for one theta_i, of smooth functions times F_alpha.
///
/// F has a peak of width alpha at theta_d = theta_i, and beyond the kink at theta_k = 90 - theta_i
/// it is a smooth function of v = sqrt(theta_d - theta_k). Panels are therefore graded towards the
/// peak, in theta_d before the kink and in v beyond it (theta_d = theta_k + v^2). For T = 1 the sum
/// over a quarter turn is G1(theta_i) to 1e-13.
class FilterNodes {
public:
    /// Facets that straight light meets: from the front (seen), or from behind, with the weight
    /// TransmissionFilter::behind().
    enum class Facets { seen, behind };

    /// Quadrature for one angle of incidence.
    ///   filter       must outlive this object
    ///   theta_i_deg  [0, 90] degrees
    ///   simd         instruction set
    ///   facets       which weight to use
    FilterNodes(const TransmissionFilter& filter, double theta_i_deg, SimdLevel simd,
                Facets facets = Facets::seen);

    /// Nodes of 16-point Gauss rules between two angles, with weights F_alpha dtheta_d.
    WeightedAngles operator()(double begin_deg, double end_deg) const;

private:
    const TransmissionFilter& filter_;
    double theta_i_deg_, kink_deg_;
    SimdLevel simd_;
    Facets facets_;
    std::vector<double> before_, behind_;  ///< panel ends: theta_d, and v = sqrt(theta_d - kink)
};

}  // namespace irido
