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
};

/// The unit sphere.
std::unique_ptr<const Shape> sphere_shape();

/// The endless plane through the origin, its normal tilted from the camera by rotation about the
/// y axis; tilt_deg in [-89.9, 89.9], else DomainError.
std::unique_ptr<const Shape> plane_shape(double tilt_deg);

/// A torus, seen from obliquely above, which fits into the unit sphere.
std::unique_ptr<const Shape> ring_shape();

/// A brilliant-cut gem of 33 faces, seen from obliquely above, which fits into the unit sphere.
std::unique_ptr<const Shape> gem_shape();

/// How a picture shows its shape.
enum class ShapeKind { sphere, bubble, plane, ring, gem };

/// sphere, bubble, plane, ring, gem.
std::span<const std::string_view> shape_names();

/// Throws DomainError that lists the names.
ShapeKind shape_kind(std::string_view name);

}  // namespace irido
