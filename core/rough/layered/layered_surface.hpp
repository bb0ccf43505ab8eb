#pragma once

#include <vector>

#include "core/material/material.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// Facets of GGX roughness that each are the stack.
struct RoughLayer {
    Stack stack;              ///< its incident medium is the one inside the surface
    double alpha = 0.1;       ///< [1e-4, 1]
    bool is_passable = true;  ///< its substrate is the medium inside, too: light goes on straight
};

/// Rough layers, the top one first, over a Lambertian base; a smooth coating lies over them where
/// the media outside and inside differ. Source: FPB24 section 4.
struct LayeredSurface {
    Material outside, inside;              ///< transparent, and constant unless they are the same
    std::vector<RoughLayer> layers;        ///< all but the last are passable
    Dispersion base_albedo = Constant{0};  ///< Constant or Table, in [0, 1]; 0 is a black base

    bool is_coated() const { return outside.model != inside.model; }
};

}  // namespace irido
