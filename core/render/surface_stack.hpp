#pragma once

#include <cstddef>

#include "core/stack/stack.hpp"

namespace irido {

/// A stack on a surface, one of its layers perhaps of a thickness that varies from place to place.
struct SurfaceStack {
    Stack stack;
    LayerPlace varied{};  ///< the layer; none if empty
    /// The stack where that layer has a thickness.
    Stack at(double thickness_nm) const;
    /// Gives that layer another thickness, if there is one.
    void set(double thickness_nm);
};

/// From the other side; the place of the varied layer counts from there, in groups as well.
SurfaceStack reversed_surface(const SurfaceStack& surface);

/// Place of the layer with this number, from 1 on, as light meets them; those of a group count
/// once. Throws DomainError if there is none.
LayerPlace layer_number(const Stack& stack, std::size_t number);

/// The thickness of a layer.
double thickness_at(const Stack& stack, const LayerPlace& place);

/// A place of a surface as light meets it.
struct FilmPoint {
    double cosine = 1;  ///< of the angle of incidence
    double thickness_nm = 0;
};

}  // namespace irido
