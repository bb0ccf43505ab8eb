#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "core/render/camera.hpp"

namespace irido {

/// Where a ray meets a surface.
struct Hit {
    double distance = 0;  ///< along the ray
    Vector3 point;
    Vector3 normal;  ///< of unit length, outward
};

/// A body with a smooth surface.
class Shape {
public:
    virtual ~Shape() = default;
    /// The first face that the ray meets at a distance above ray.from, from outside or inside.
    virtual std::optional<Hit> first_hit(const Ray& ray) const = 0;
    /// The height of the floor on which it stands; of an endless plane that of its centre.
    virtual double lowest() const = 0;
    /// How far a point is from the surface: positive inside, negative outside. Of a gem the least
    /// distance from the planes of its faces.
    virtual double depth(const Vector3& point) const = 0;
};

/// The unit sphere.
std::unique_ptr<const Shape> sphere_shape();

/// The endless plane through the origin, its normal tilted from the camera by rotation about the
/// y axis; tilt_deg in [-89.9, 89.9], else DomainError.
std::unique_ptr<const Shape> plane_shape(double tilt_deg);

/// A torus, turned towards the viewer by an angle about the x axis, which fits into the unit
/// sphere.
std::unique_ptr<const Shape> ring_shape(double turn_deg);

/// A brilliant-cut gem of 33 faces, turned likewise, which fits into the unit sphere.
std::unique_ptr<const Shape> gem_shape(double turn_deg);

/// How a picture shows its shape.
enum class ShapeKind { sphere, bubble, plane, ring, gem };

/// sphere, bubble, plane, ring, gem.
std::span<const std::string_view> shape_names();

/// Throws DomainError that lists the names.
ShapeKind shape_kind(std::string_view name);

/// The elevation from which a shape that stands on a floor is looked at, degrees. Without a floor
/// the ring and the gem are turned by as much instead.
double usual_elevation_deg(ShapeKind shape);

/// The shape of a picture whose camera has an elevation. tilt_deg as of plane_shape().
std::unique_ptr<const Shape> make_shape(ShapeKind shape, double tilt_deg, double elevation_deg);

/// Whether light meets the stack once per path, as far as nothing else is there: then colours are
/// ReflectedColors.
bool is_simple(ShapeKind shape);

/// Whether nothing is seen through a shape.
bool is_opaque(ShapeKind shape);

}  // namespace irido
