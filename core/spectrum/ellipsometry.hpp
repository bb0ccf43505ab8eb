#pragma once

#include "core/complex.hpp"

namespace irido {

/// The angles that an ellipsometer measures, rho = r_p / r_s = tan(psi) exp(i delta).
struct EllipsometricAngles {
    double psi_deg;    ///< [0, 90]
    double delta_deg;  ///< (-180, 180]
};

/// From the amplitudes of the tangential electric fields, time factor exp(-i w t). r_p = r_s at
/// normal incidence, so that delta = 0 there for every stack; in the other common convention, where
/// r_p changes its sign, delta differs by 180 degrees. Where nothing is reflected, psi = 45 and
/// delta = 0, as at normal incidence.
/// Source: R. M. A. Azzam and N. M. Bashara, Ellipsometry and Polarized Light (1977), section 4.2.
EllipsometricAngles ellipsometric_angles(Complex r_s, Complex r_p);

}  // namespace irido
