#pragma once

#include <vector>

#include "core/scratch/light.hpp"

namespace irido {

/// A direction of a light, and the solid angle that it stands for.
struct LightPoint {
    UnitVector direction;
    double solid_angle;
};

/// Gauss points in the directions of a light, for functions that are smooth over it: of a sphere
/// they integrate polynomials of degree 2 order - 1 in the distance from its middle exactly, of a
/// triangle of a polygon 2 order - 1 in its plane. Precise for the smallest lights.
///   light  one that LightCone takes
///   order  [1, 64]
std::vector<LightPoint> light_points(const AreaLight& light, int order);

}  // namespace irido
