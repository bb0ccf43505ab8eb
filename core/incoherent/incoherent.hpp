#pragma once

#include "core/coherent/slab_response.hpp"

namespace irido {

/// Whether light goes on in a layer: Re q2 > 0. Where it does not (past the critical angle, in
/// metals), it dies away before its phase has turned by a radian. There is no phase to be lost
/// then, and the layer is coherent whatever it is said to be.
bool travels(const Medium& layer);

/// The wave that goes down in an incoherent layer in which light travels. In an absorbing medium
/// the interference of the two waves carries power, too, by |Im Y|/Re Y of their tangential
/// admittance Y = C/B: what it takes at one face it gives back at the other, unless the phase
/// between them is lost. For a layer of any phase to give out no more than it gets,
///     |Im Y| <= sinh(k0 d Im kz) Re Y
/// is needed, and enough. Layers that are thicker than about wavelength/(2 pi n) obey that; the
/// wave of a thinner one has this limit as its Im Y, so that it ends as a real one at d = 0.
Wave wave_in_gap(const Medium& layer, double k0_d, Polarization polarization);

/// Whether the layer is not too thin for its own wave, in both polarizations.
bool has_own_wave(const Medium& layer, double k0_d);

/// What an incoherent layer leaves of the power that passes it once, and what it takes: of one
/// pass, and of two. A layer that amplifies leaves more than 1.
struct Attenuation {
    double kept, lost, lost_twice;
};
Attenuation attenuation(const Medium& medium, double k0_d);

/// A coherent block on top of an incoherent layer: its powers for light from above, and for light
/// that comes up in the layer.
struct BlockPower {
    Power down, up;
};

/// Light in an incoherent layer, all bounces summed, as part of what meets the block above it.
struct LightInGap {
    double entering;  ///< going down, at the top
    double arriving;  ///< going down, at the bottom
    double returned;  ///< going up, at the top
};

/// `below` is what lies below the layer, seen from it. Throws DomainError if the light grows with
/// every bounce.
LightInGap light_in_gap(const BlockPower& block, const Attenuation& gap, const Power& below);

/// Powers of block, incoherent layer and all that lies below.
Power over_gap(const BlockPower& block, const Attenuation& gap, const Power& below);

}  // namespace irido
