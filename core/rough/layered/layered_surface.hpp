#pragma once

#include <vector>

#include "core/material/material.hpp"
#include "core/stack/stack.hpp"

namespace irido {

class Sensitivity;

/// A rough layer: facets of GGX roughness, each of which is the stack.
struct RoughLayer {
    Stack stack;              ///< its incident medium is the medium inside the surface
    double alpha = 0.1;       ///< [1e-4, 1]
    bool is_passable = true;  ///< its substrate is the medium inside, too: light passes straight
};

/// Rough layers, top first, over a Lambertian base. If the media outside and inside differ, their
/// interface is a smooth coating on top. Source: FPB24 section 4.
struct LayeredSurface {
    Material outside, inside;              ///< transparent, and constant unless they are the same
    std::vector<RoughLayer> layers;        ///< all but the last must be passable
    Dispersion base_albedo = Constant{0};  ///< Constant or Table, in [0, 1]; 0 is black

    bool is_coated() const { return outside.model != inside.model; }
};

/// The surface with all materials of its layers clamped outside their range. Throws DomainError as
/// held_stack() does.
LayeredSurface held_surface(LayeredSurface surface, const Sensitivity& sensitivity);

}  // namespace irido
