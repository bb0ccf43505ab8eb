#pragma once

#include <string>
#include <vector>

#include "core/color/color_tables.hpp"
#include "core/engines/engine_film.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// Wavelengths at which engines that take n and k of r, g, b are given those of a base, nm.
inline constexpr Triple kBaseWavelengths_nm{650, 550, 450};

/// A stack as engines can take it. Engines know one film of one real index in air: the first layer
/// with its index at 550 nm, over the substrate. In an incident medium of index n0 the same
/// reflectance has a film of n / n0 and thickness n0 d over a base of (n + ik) / n0 in air.
struct GivenFilm {
    EngineFilm film;  ///< but for its thickness and the angle
    /// Place of the given layer in the stack; empty where the stack has no layer.
    LayerPlace layer;
    double thickness_scale = 1;  ///< n0

    /// The film over the base as a stack, for `gaussian` and `smits`.
    Stack reduced;
    /// Properties of the stack that no engine can be given, in words. Air counts as vacuum.
    std::vector<std::string> dropped;

    /// The same film with the thickness that the layer has in a stack of the same structure.
    EngineFilm with_thickness_of(const Stack& stack) const;
    Stack reduced_of(const Stack& stack) const;
};

/// `held` is a stack whose materials hold their end values outside their range.
/// base F0: n of a dielectric at 550 nm; else the linear sRGB of the bare base in the incident
///          medium, clipped to [0, 1]
/// base n, k: at 550 nm for a dielectric; else at kBaseWavelengths_nm
/// F82 tint: f82_tint() of bare_base_color() at that angle
/// Throws DomainError as with_base() and bare_base_color() do.
GivenFilm given_film(const ColorTables& tables, const Stack& held);

/// The same of a film in air, one layer, whose numbers are known.
GivenFilm given_film(const EngineFilm& film, const Stack& held);

}  // namespace irido
