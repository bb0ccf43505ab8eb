#pragma once

#include "core/complex.hpp"

namespace irido {

/// Faddeeva function w(z) = exp(-z^2) erfc(-i z) in the upper half plane, Im z >= 0, where |w| <=
/// 1; error below 5e-15 |w|. Trapezoidal rules for
///     w(z) = (2 i z/pi) int_0^inf exp(-t^2)/(z^2 - t^2) dt
/// whose points are chosen away from the pole; its residue is added where it matters. Throws
/// DomainError if Im z < 0 or a part is NaN.
/// Source: M. Al Azah, S. N. Chandler-Wilde, SIAM J. Numer. Anal. 59, 2346 (2021), section 3.
Complex faddeeva(const Complex& z);

}  // namespace irido
