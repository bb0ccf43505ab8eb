#pragma once

#include "core/rough/angle_series.hpp"

namespace irido {

/// How a rough layer throws the light of a Lambertian base back at it: of light that is as bright
/// in all directions the share rbar = integral R(theta_d) w(theta_d) dtheta_d returns,
///     w = 8 cos td sin td int_0^(pi/2) dtm sin tm D(tm) int_0^(pi/2) dpsi G1(i) G1(o),
///     cos i, cos o = cos tm cos td +- sin tm sin td cos psi > 0,
/// a function of the roughness alone.
class BaseLight {
public:
    /// alpha [1e-4, 1], else DomainError;  tolerance  of the table
    explicit BaseLight(double alpha, unsigned threads = 1, double tolerance = 1e-9);

    /// w per radian; theta_d [0, 90] degrees.
    double weight(double theta_d_deg) const { return series_.value(0, theta_d_deg); }
    /// Moments for series of R.
    AngleMoments moments() const;

private:
    AngleSeries series_;
};

}  // namespace irido
