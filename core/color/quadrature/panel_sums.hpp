#pragma once

#include <cstddef>

#include "core/math/simd_level.hpp"

namespace irido {

/// Dot products sums[r] = sum over j of row[r][j] (values[j] - reference).
///   rows       `count` rows of `stride` numbers each
///   count      number of rows
///   stride     a multiple of kMostLanes
///   values     `stride` numbers
///   reference  subtracted from every value
///   sums       results, one per row
///   level      instruction set
void row_sums(const double* rows, std::size_t count, std::size_t stride, const double* values,
              double reference, double* sums, SimdLevel level);

/// Where powers go that follow from denominators: T = scale times the sum of flux / |D|^2, at most
/// 1, and R = 1 - T. nullptr where one is not needed.
struct Powers {
    double scale = 1;
    double *R = nullptr, *T = nullptr;
};

/// One or two complex functions D at other points, by a matrix, and powers that follow.
///   columns       of a Resampling, with `inputs` and `stride`
///   denominators  number of functions, 1 or 2
///   from          real and imaginary part of each, `inputs` numbers
///   to            the same at the other points, `stride` numbers
///   flux          of each
///   powers        `stride` numbers each; past the points R is 0 and T is 1
///   level         instruction set
void resampled_denominators(const double* columns, std::size_t inputs, std::size_t stride,
                            std::size_t denominators, const double* const* from, double* const* to,
                            const double* flux, const Powers& powers, SimdLevel level);

/// Largest |D'|/|D| of a complex function D = exp(l) d between neighbouring points, as its
/// differences show it: (|d_(j+1) - d_j| / min(|d_j|, |d_(j+1)|) + |l_(j+1) - l_j|) / (x_j -
/// x_(j+1)). From D'/D = l' + d'/d, the mean of D'/D over a step is (l_(j+1) - l_j + log q) /
/// (x_(j+1) - x_j) with q = d_(j+1)/d_j, and |log q| <= pi/2 |q - 1| / min(1, |q|), the factor
/// being 1.05 where the right side is below 1: with |q| >= 1 (else q and 1/q change places) log |q|
/// <= |q|
/// - 1 and |q - 1|^2 = (|q| - 1)^2 + 4 |q| sin^2(arg q / 2), where sin(a/2) >= a/pi up to a = pi.
/// So no way to share D out between l and d makes this less than |D'/D|, jumps of one that the
/// other makes up for included; it is more than that where they cancel.
///   re, im           d
///   log_scale        l
///   inverse_spacing  of each point to the next one, 0 from the last point on
/// `stride` numbers are read of each, and one more of d and l; stride as in row_sums().
double steepness(const double* re, const double* im, const double* log_scale,
                 const double* inverse_spacing, std::size_t stride, SimdLevel level);

}  // namespace irido
