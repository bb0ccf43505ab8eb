#pragma once

#include "core/incoherent/chain.hpp"

namespace irido {

/// Mean of r_p conj(r_s) over the phases of the chain's incoherent layers, an element of the
/// averaged Mueller matrix. Every light path contributes a_p conj(a_s) where powers would take
/// |a|^2, and the round trips in an incoherent layer are summed:
///     K = r_p r_s* + (t t')_p (t t')_s* P^2 K_b / (1 - r'_p r'_s* P^2 K_b)
/// from the last layer up, with t' and r' for light from below, K_b of everything below, and P the
/// power transmitted by one pass.
///   s, p  the chain in each polarization, at one wavelength and angle
/// This is the sum in over_gap() with products of amplitudes in place of powers.
Complex cross_reflection(const ChainLight& s, const ChainLight& p);

}  // namespace irido
