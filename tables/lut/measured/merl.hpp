#pragma once

#include <functional>
#include <string>

#include "core/colorimetry/space.hpp"
#include "tables/lut/measured/half_angles.hpp"

namespace irido::tables {

/// Counts of what the cells of a table are.
struct MerlReport {
    std::size_t cells = 0, below = 0, clamped = 0;  ///< below the horizon; colours below 0
};

/// The file format of the MERL database, isotropic and RGB: three 32-bit counts (90, 90, 180), then
/// for red, green and blue a 64-bit float for every theta_h, theta_d and phi_d, the last fastest,
/// little-endian. Cells of theta_h are equally spaced in its square root, (k + 1/2)^2 / 90 degrees;
/// a value is the BRDF per steradian divided by 1/1500, 1.15/1500, 1.66/1500, or -1 below the
/// horizon. Cells that straddle the horizon have their value just above it, and components below 0
/// are set to 0.
/// Source: W. Matusik et al., A Data-Driven Reflectance Model, SIGGRAPH 2003, and the reader that
/// comes with its data.
///   rgb(pair)  linear sRGB of the BRDF, per steradian
std::string merl_file(const std::function<Triple(const TablePair&)>& rgb, unsigned threads,
                      MerlReport& report);

}  // namespace irido::tables
