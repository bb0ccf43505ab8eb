#pragma once

#include <cmath>

#include "core/math/random.hpp"
#include "core/scratch/scratch.hpp"

namespace irido::test {

/// The scratch, the directions and the footprint of the worked cases.
inline Scratch worked_scratch(double width_um = 2, double angle_deg = 30) {
    Scratch scratch;
    scratch.width_um = width_um;
    scratch.depth_um = 0.14;
    scratch.angle_deg = angle_deg;
    scratch.point = {10, -5};
    return scratch;
}
inline constexpr ScratchOptics kVertical{60, DepthPhase::vertical};

inline double relative(double value, double exact) {
    return std::abs(value - exact) / std::abs(exact);
}

inline UnitVector random_direction(Random& random) {
    return direction_of(random.uniform(0, 89), random.uniform(-180, 180));
}

inline Scratch random_scratch(Random& random) {
    Scratch scratch;
    scratch.width_um = random.log_uniform(0.5, 8);
    scratch.depth_um = random.uniform(0, 1);
    scratch.angle_deg = random.uniform(-180, 180);
    scratch.point = {random.uniform(-50, 50), random.uniform(-50, 50)};
    return scratch;
}

}  // namespace irido::test
