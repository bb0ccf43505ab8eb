#pragma once

#include "core/colorimetry/space.hpp"
#include "core/complex.hpp"

namespace irido {

/// Fourier transform of the CIE 1931 observer as tabulated in Blender's Cycles: 512 entries over 60
/// um / (2 pi) of optical path difference, converted to linear Rec.709 and normalized per channel
/// to white = 1. Computed from the observer; matches the 8-digit table in the source code to 5e-8.
/// Linear between entries, clamped to the last one.
///   opd_nm  optical path difference, >= 0
std::array<Complex, 3> cycles_sensitivity(double opd_nm);

}  // namespace irido
