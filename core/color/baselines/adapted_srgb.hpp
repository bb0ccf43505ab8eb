#pragma once

#include "core/colorimetry/space.hpp"

namespace irido {

/// Matrix from linear sRGB to XYZ under a light of this white, which r = g = b = 1 has. Throws
/// DomainError as bradford() does.
ColorMatrix xyz_from_srgb(const Triple& white);

}  // namespace irido
