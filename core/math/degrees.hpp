#pragma once

#include <cmath>

#include "core/math/constants.hpp"

namespace irido {

inline double sin_deg(double angle_deg) {
    return std::sin(angle_deg * kDegree);
}
inline double cos_deg(double angle_deg) {
    return std::cos(angle_deg * kDegree);
}

}  // namespace irido
