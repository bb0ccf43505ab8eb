#pragma once

#include <functional>

#include "tables/pictures/raster.hpp"

namespace irido::tables {

/// Discs of directions side by side: the normal in the middle, radius theta / 90, azimuth 0 on the
/// right and counted anticlockwise, with thin circles at 5, 30, 60 and 90 degrees. The background
/// is black.
///   ink       for a disc at theta in [0, 90] and phi in [0, 360) degrees
///   diameter  of each disc in pixels
Pixels scatterogram(
    std::size_t discs, std::size_t diameter,
    const std::function<Ink(std::size_t disc, double theta_deg, double phi_deg)>& ink);

}  // namespace irido::tables
