#pragma once

#include <cstdint>
#include <span>

#include "core/interference/layer.hpp"

namespace irido {

/// Matrix of layers and groups, from the incident side to the substrate.
Matrix matrix_of(std::span<const Element> elements, std::span<const Medium> media, double k0,
                 Polarization polarization);

/// The same with the power they absorb.
Slab slab_of(std::span<const Element> elements, std::span<const Medium> media, double k0,
             Polarization polarization);

/// matrix^repeat, exact in the number of periods:
///     M^N = cos(N K) I + sin(N K)/sin(K) (M - x I),   x = cos(K) = tr(M)/2
/// with the growing exponential factored out; N in [1, 1e9] costs the same as 1. M - x I is formed
/// without a trace, so that the power keeps a determinant of 1 whatever the rounding of N K.
///   half_angle_sin2  (1 - x)/2 = sin(K/2)^2;   half_angle_cos2  (1 + x)/2 = cos(K/2)^2
/// both are given because each loses its digits where it is formed from the other.
/// Source: P. Yeh, Optical Waves in Layered Media (1988), section 4.5 and 6.2.
Matrix power(const Matrix& matrix, Complex half_angle_sin2, Complex half_angle_cos2,
             std::uint64_t repeat);

}  // namespace irido
