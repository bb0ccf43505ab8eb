#pragma once

#include "core/stack/stack.hpp"

namespace irido {

/// BB17's index of a film that vanishes for artists: it goes to the incident medium's as the path
/// 2 n d goes to 0,
///     n' = n1 + (n - n1) t^2 (3 - 2t),   t = min(1, 2 n d / width).
/// Physically a film of no thickness has no effect whatever its index is; this hides the colours of
/// the thinnest films. Source: BB17 section 5, Parametric Control; its supplemental code has a
/// width of 30 nm.
///   n1, n         indices of the incident medium and of the film, above 0
///   thickness_nm  d >= 0
///   width_nm      >= 0; 0: n' = n
double remapped_index(double n1, double n, double thickness_nm, double width_nm);

/// The stack with that index of its film; n of t is the one at 550 nm, n1 and n are those of each
/// wavelength. Throws DomainError unless the stack is one film of real index, see film_fault().
Stack with_remapped_film(Stack stack, double width_nm);

}  // namespace irido
