#pragma once

#include <cstddef>

#include "core/math/simd_level.hpp"

namespace irido {

/// sums[r] = sum over j of row[r][j] (values[j] - reference) for `count` rows of `stride` numbers
/// each, a multiple of kMostLanes; as many values are read.
void row_sums(const double* rows, std::size_t count, std::size_t stride, const double* values,
              double reference, double* sums, SimdLevel level);

/// Largest |D'|/|D| of a complex function between neighbouring points, as its differences show it.
///   inverse_spacing  of each point to the next one, 0 from the last point on
///   log_scale        logarithm of a factor of re and im; infinite if it is not the same everywhere
/// `stride` numbers are read of each, and one more of re and im; stride as in row_sums().
double steepness(const double* re, const double* im, const double* log_scale,
                 const double* inverse_spacing, std::size_t count, std::size_t stride,
                 SimdLevel level);

}  // namespace irido
