#pragma once

#include "core/interference/coherent.hpp"

namespace irido {

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
