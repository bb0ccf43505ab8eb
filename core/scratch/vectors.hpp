#pragma once

#include <array>
#include <cmath>

namespace irido {

/// A place in mm or a direction, {x, y, z}.
using Place = std::array<double, 3>;

inline double dot(const Place& a, const Place& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Place cross(const Place& a, const Place& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double length_of(const Place& a) {
    return std::hypot(a[0], a[1], a[2]);
}

}  // namespace irido
