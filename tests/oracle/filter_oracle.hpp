#pragma once

namespace irido::oracle {

/// F_alpha(theta_i, theta_d) of FPB24 eq. 29, angles in degrees strictly between 0 and 90: the
/// integral over psi by tanh-sinh on panels whose width doubles away from the peak, in 50 digits.
double transmission_filter(double alpha, double theta_i_deg, double theta_d_deg);

}  // namespace irido::oracle
