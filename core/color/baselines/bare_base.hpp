#pragma once

#include "core/color/color_tables.hpp"

namespace irido {

/// Linear sRGB of a bare substrate under another medium, unpolarized and clipped to [0, 1]: the
/// base colour that renderers ask for. Grey and exact if both indices are constant or the substrate
/// does not absorb; then the indices at 550 nm are used, as renderers have a single index for it.
///   held       a stack whose materials are clamped
///   above      the medium, clamped as well
///   cos_theta  cosine of incidence in that medium, (0, 1]
Triple bare_base_color(const ColorTables& tables, const Stack& held, const Material& above,
                       double cos_theta);

/// Wavelength at which renderers' single indices are taken, nm.
inline constexpr double kMiddle_nm = 550;

}  // namespace irido
