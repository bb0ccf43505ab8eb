#pragma once

#include "core/color/color_tables.hpp"

namespace irido {

/// Linear sRGB of a bare substrate under another medium, unpolarized and clipped to [0, 1]: the
/// base color that renderers ask for. Gray, and exact, where both indices are constant, or where
/// the substrate does not absorb: the indices at 550 nm count then, as renderers have one index for
/// it.
///   held   a stack whose materials hold their end values
///   above  the medium; also holding its end values
/// cos_theta in it, (0, 1]
Triple bare_base_color(const ColorTables& tables, const Stack& held, const Material& above,
                       double cos_theta);

/// Where renderers' single indices are taken, nm.
inline constexpr double kMiddle_nm = 550;

}  // namespace irido
