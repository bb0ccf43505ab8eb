#pragma once

#include <limits>
#include <numbers>

namespace irido {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTwoPi = 2 * kPi;
inline constexpr double kDegree = kPi / 180;  // in radians
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace irido
