#pragma once

#include "core/colorimetry/space.hpp"
#include "core/complex.hpp"

namespace irido {

/// Fourier transform of the CIE 1931 observer as Blender's Cycles tabulates it: 512 entries over
/// 60 um / (2 pi) of optical path, for linear Rec.709, each channel scaled so that white is 1.
/// Made from the observer's tables; equals the 8-digit table of the source code to 5e-8. Linear
/// between the entries, and the last entry beyond them.
/// opd_nm  optical path difference, >= 0
std::array<Complex, 3> cycles_sensitivity(double opd_nm);

}  // namespace irido
