#pragma once

#include <cstddef>

#include "core/render/vector3.hpp"

namespace irido {

/// A ray of sight.
struct Ray {
    Vector3 origin, direction;  ///< direction of unit length
    double from = 0;            ///< where it begins, in units of direction
};

/// Looks at the origin along -z, or down from an elevation above that. The unit sphere fills 0.9 of
/// the smaller side of the picture.
struct Camera {
    static constexpr double kFill = 0.9;
    /// Of a perspective camera: the angle that the smaller side covers, degrees.
    static constexpr double kView_deg = 35;

    std::size_t width = 512, height = 512;
    bool perspective = false;  ///< else orthographic: all rays are parallel
    double elevation_deg = 0;  ///< above the horizon, [0, 90)

    /// The ray through a place of the picture, in pixels from its top left corner.
    Ray ray(double x, double y) const;
};

}  // namespace irido
