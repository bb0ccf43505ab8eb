#pragma once

#include "core/incoherent/chain.hpp"

namespace irido {

/// Mean of r_p conj(r_s) over the phases of the chain's incoherent layers: Mueller matrices add.
/// Every path of light takes the factor a_p conj(a_s), as its powers take |a|^2, and round trips
/// of an incoherent layer are summed:
///     K = r_p r_s* + (t t')_p (t t')_s* P^2 K_b / (1 - r'_p r'_s* P^2 K_b)
/// from the last layer up, with t' and r' from below, K_b of all that lies below and the power P
/// that one pass leaves.
///   s, p  the chain's light in the two polarizations, at one wavelength and angle
/// Source: the sum of over_gap(), of products of amplitudes in place of powers.
Complex cross_reflection(const ChainLight& s, const ChainLight& p);

}  // namespace irido
