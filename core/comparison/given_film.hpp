#pragma once

#include <string>
#include <vector>

#include "core/color/color_tables.hpp"
#include "core/engines/engine_film.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// Wavelengths (nm) at which engines that take n and k per channel sample those of a base: r, g, b.
inline constexpr Triple kBaseWavelengths_nm{650, 550, 450};

/// A stack reduced to what engines accept: one film of one real index in air, namely the first
/// layer with its index at 550 nm, on the substrate. For an incident medium of index n0, a film of
/// index n / n0 and thickness n0 d on a base of (n + ik) / n0 in air has the same reflectance.
struct GivenFilm {
    EngineFilm film;  ///< without thickness and angle
    /// Position of that layer in the stack; empty if the stack has none.
    LayerPlace layer;
    double thickness_scale = 1;  ///< n0

    /// The reduced film and base as a stack, for `gaussian` and `smits`.
    Stack reduced;
    /// Properties of the stack that engines cannot represent, in words. Air counts as vacuum.
    std::vector<std::string> dropped;

    /// The same film with the layer thickness taken from a stack of the same structure.
    EngineFilm with_thickness_of(const Stack& stack) const;
    Stack reduced_of(const Stack& stack) const;
};

/// Reduces a stack whose materials are clamped outside their range (`held`).
///   base F0    a dielectric: from n at 550 nm; else the linear sRGB of the bare base in the
///              incident medium, clipped to [0, 1]
///   base n, k  a dielectric: at 550 nm; else at kBaseWavelengths_nm
///   F82 tint   f82_tint() of bare_base_color() at that angle
/// Throws DomainError as with_base() and bare_base_color() do.
GivenFilm given_film(const ColorTables& tables, const Stack& held);

/// Reduces a single film in air whose engine inputs are known.
GivenFilm given_film(const EngineFilm& film, const Stack& held);

}  // namespace irido
