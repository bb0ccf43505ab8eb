#include "core/rough/layered/layered_surface.hpp"

#include "core/color/held_stack.hpp"

namespace irido {

LayeredSurface held_surface(LayeredSurface surface, const Sensitivity& sensitivity) {
    for (RoughLayer& layer : surface.layers) layer.stack = held_stack(layer.stack, sensitivity);
    return surface;
}

}  // namespace irido
