#pragma once

namespace irido {

/// F_alpha of TransmissionFilter computed with 50 digits and rounded once: the closed form given by
/// the source in filter.hpp, in terms of the sines and cosines of theta_i and theta_d. For
/// comparisons; takes some 0.1 ms. 0 wherever TransmissionFilter is 0. Throws DomainError naming
/// the argument.
///   alpha                     roughness, [1e-4, 1]
///   theta_i_deg, theta_d_deg  [0, 90] degrees
double reference_filter(double alpha, double theta_i_deg, double theta_d_deg);

}  // namespace irido
