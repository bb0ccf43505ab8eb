#pragma once

namespace irido {

/// F_alpha of TransmissionFilter in 50 digits, rounded at last: its closed form as the source of
/// filter.hpp has it, with the sines and cosines of theta_i and theta_d themselves. For
/// comparisons; some 0.1 ms. alpha [1e-4, 1];  angles in [0, 90] degrees, 0 where
/// TransmissionFilter is. Throws DomainError naming the argument.
double reference_filter(double alpha, double theta_i_deg, double theta_d_deg);

}  // namespace irido
