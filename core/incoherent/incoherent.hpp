#pragma once

#include "core/coherent/slab_response.hpp"

namespace irido {

/// Whether light travels in a layer: Re q2 > 0. Where it does not (beyond the critical angle, in
/// metals), it decays before its phase advances by a radian. With no phase to lose, such a layer is
/// treated as coherent even if declared incoherent.
bool travels(const Medium& layer);

/// The downward wave in an incoherent layer in which light travels. In an absorbing medium the
/// interference of the two waves also carries power, of relative magnitude |Im Y|/Re Y with Y = C/B
/// their tangential admittance. What it takes at one face it returns at the other, unless the phase
/// between the two is lost. For a layer to emit no more than it receives, whatever its phase,
///     |Im Y| <= sinh(k0 d Im kz) Re Y
/// is necessary and sufficient. Layers thicker than about wavelength/(2 pi n) satisfy it; for a
/// thinner one Im Y is clamped to this limit, so that its wave becomes real as d -> 0.
Wave wave_in_gap(const Medium& layer, double k0_d, Polarization polarization);

/// Whether the layer is thick enough for its own wave in both polarizations, without that limit.
bool has_own_wave(const Medium& layer, double k0_d);

/// Power transmitted and absorbed by an incoherent layer in one pass, and absorbed in two. An
/// amplifying layer transmits more than 1.
struct Attenuation {
    double kept, lost, lost_twice;
};
Attenuation attenuation(const Medium& medium, double k0_d);

/// A coherent block on top of an incoherent layer: its powers for light from above, and for light
/// coming up through the layer.
struct BlockPower {
    Power down, up;
};

/// Light in an incoherent layer, all round trips summed, as a fraction of that incident on the
/// block above it.
struct LightInGap {
    double entering;  ///< going down, at the top
    double arriving;  ///< going down, at the bottom
    double returned;  ///< going up, at the top
};

/// Light between `block` and `below`, the powers of everything beneath the layer as seen from it.
/// Throws DomainError if the light grows on every round trip.
LightInGap light_in_gap(const BlockPower& block, const Attenuation& gap, const Power& below);

/// Combined powers of block, incoherent layer and everything below.
Power over_gap(const BlockPower& block, const Attenuation& gap, const Power& below);

}  // namespace irido
