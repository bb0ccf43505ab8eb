#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/color/quadrature/quadrature_rule.hpp"
#include "core/math/simd_level.hpp"

namespace irido {

/// One denominator on the points of a panel.
struct Denominator {
    std::span<const double> re, im, log_scale;
};

/// A denominator on a panel and its derivative: memory.
struct DenominatorSlopes {
    std::array<std::vector<double>, 2> parts, slopes;  ///< real and imaginary
};

/// chebyshev_slopes() of each of kDegrees, the stride that of the rule.
const std::vector<double>& slope_rows(std::size_t degree);

/// Marks the points next to which a denominator D has a zero that the points do not resolve:
/// Newton's step from there, -D/D', is shorter than the way to the next point.
///   parts, slopes  of D and of D', real and imaginary
void mark_hidden_zeros(const QuadratureRule& rule, std::array<const double*, 2> parts,
                       std::array<const double*, 2> slopes, std::vector<bool>& marked);

/// The same after an exponential trend, which has no zeros, is taken out of D.
///   slope_rows  of the points
void mark_hidden_zeros(const QuadratureRule& rule, std::span<const double> slope_rows,
                       const Denominator& d, SimdLevel simd, DenominatorSlopes& memory,
                       std::vector<bool>& marked);

/// How much of a point's weight a line can hide next to it that is not seen on the points. A pole
/// of the amplitude at the distance d from the point and w from the real axis has a residue of at
/// most 2 w, or the power would pass 1; it makes a line of an area of up to pi w. Where the
/// spectrum is near 0 or 1 elsewhere, as in the gap of a lossless mirror, the line leaves (w/d)^2
/// on the point. Where it is not, the stack absorbs, and the line leaves w/d times value (1 -
/// value), because it interferes with what there is without it.
///   foot   largest part of the values on the points that may be the line's
///   value  of the spectrum on the point
double hidden_share(double foot, double value);

}  // namespace irido
