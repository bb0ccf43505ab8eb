#pragma once

#include <string_view>

#include "core/colorimetry/space.hpp"

namespace irido {

/// XYZ under the white `white` of an sRGB colour "#rrggbb": the one that RgbTransform and hex()
/// turn into it, Bradford's adaptation in between. Throws DomainError for any other text. Source:
/// IEC 61966-2-1.
Triple xyz_of_hex(std::string_view text, const Triple& white);

}  // namespace irido
