#pragma once

#include <algorithm>
#include <cmath>

#include "core/math/constants.hpp"

namespace irido {

/// Angle in degrees, [0, 90], whose cosine is in [0, 1]; accurate near 90.
inline double angle_of_cosine(double cosine) {
    return 90 - std::asin(std::clamp(cosine, 0.0, 1.0)) * 180 / kPi;
}

}  // namespace irido
