#pragma once

#include <array>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "core/scratch/scratch.hpp"

namespace irido {

/// Lights relative to the shaded point, z along the normal; they emit the same radiance from every
/// point in every direction.
struct SphereLight {
    std::array<double, 3> center_mm{};
    double radius_mm = 1;  ///< (0, 1e12], below the distance of the centre
};
struct PolygonLight {
    std::vector<std::array<double, 3>> vertices_mm;  ///< 3 to 256, in order, of a convex polygon
};
using AreaLight = std::variant<SphereLight, PolygonLight>;

/// Directions w with n.w >= c.
struct HalfSpace {
    UnitVector normal;
    double least;
};

/// The directions of a light, as an intersection of half-spaces; the horizon is not among them.
class LightCone {
public:
    /// Throws DomainError for a point inside the sphere, fewer than 3 or more than 256 vertices, a
    /// polygon seen edge-on from the point or one that is not convex.
    explicit LightCone(const AreaLight& light);

    std::span<const HalfSpace> half_spaces() const { return half_spaces_; }
    /// Directions to the vertices of a polygon; empty for a sphere.
    std::span<const UnitVector> corners() const { return corners_; }
    /// Whether a direction above the horizon belongs to it.
    bool contains(const UnitVector& direction) const;
    /// A circular cone around all of its directions: the axis and the cosine of its half-angle.
    const HalfSpace& bound() const { return bound_; }
    /// The half-angle of that cone, radians, precise for the smallest lights.
    double half_angle() const { return half_angle_; }
    const AreaLight& light() const { return light_; }

private:
    void set_sphere(const SphereLight& light);
    void set_polygon(const PolygonLight& light);

    AreaLight light_;
    std::vector<HalfSpace> half_spaces_;
    std::vector<UnitVector> corners_;
    HalfSpace bound_{};
    double half_angle_ = 0;
};

/// Arcs psi of a circle w = (tau, r sin psi, r cos psi), r = sqrt(1 - tau^2), in the frame of a
/// scratch (tangent, bitangent, normal).
struct Arc {
    double from = 0, to = 0;  ///< -pi/2 <= from < to <= pi/2: above the horizon
};

/// A light cut along planes across a scratch: exact intervals of directions without quadratics.
class LightSlices {
public:
    LightSlices(const LightCone& cone, std::array<double, 2> tangent);

    /// The light's arcs at w_t = tau in (-1, 1), ascending.
    std::vector<Arc> at(double tau) const;
    /// Values of tau between which the arcs' ends are smooth, ascending, the first and the last one
    /// those where the light begins and ends; none if it is below the horizon.
    std::span<const double> breaks() const { return breaks_; }

private:
    struct Cut {
        double along, middle, across;  ///< n_t, atan2(n_b, n_n), hypot(n_b, n_n)
        double least;
    };
    void set_breaks(const LightCone& cone, std::array<double, 2> tangent);

    std::vector<Cut> cuts_;
    std::vector<double> breaks_;
};

}  // namespace irido
