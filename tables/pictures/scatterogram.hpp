#pragma once

#include <functional>

#include "tables/pictures/raster.hpp"

namespace irido::tables {

/// Discs of directions in rows and columns: the normal in the middle, radius theta / 90, azimuth 0
/// to the right and counted anticlockwise, with thin circles at 5, 30, 60 and 90 degrees. The
/// background is black.
///   ink       of a disc at theta in [0, 90] and phi in [0, 360) degrees
///   diameter  of a disc in pixels
Pixels scatterogram(std::size_t rows, std::size_t columns, std::size_t diameter,
                    const std::function<Ink(std::size_t row, std::size_t column, double theta_deg,
                                            double phi_deg)>& ink);

}  // namespace irido::tables
