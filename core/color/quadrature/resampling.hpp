#pragma once

#include <cstddef>
#include <vector>

namespace irido {

/// A matrix that interpolates between Chebyshev points of the second kind, cos(pi j / n).
struct Resampling {
    std::size_t inputs;           ///< points of the degree that is known
    std::size_t stride;           ///< number of other points, rounded up to kMostLanes
    std::vector<double> columns;  ///< one per input, of `stride` numbers, zero past the points
};

/// From the points of one degree to those of another, both indices into kDegrees.
const Resampling& resampling(std::size_t from, std::size_t to);

/// From the points of a panel to those, of the same degree, of its first half, x in [0, 1], or of
/// its second.
const Resampling& resampling_of_half(std::size_t degree, std::size_t half);

}  // namespace irido
