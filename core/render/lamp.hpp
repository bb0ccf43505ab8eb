#pragma once

#include <array>
#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "core/render/vector3.hpp"

namespace irido {

/// Light from far away, as the sun's: from all directions of a narrow cone.
struct FarLamp {
    static constexpr double kSun_deg = 0.53;  ///< apparent diameter of the sun

    Vector3 direction{0, 1, 0};   ///< towards the lamp, of any length
    double irradiance = 1;        ///< across the light: 1 is that of radiance 1 from all around
    double angle_deg = kSun_deg;  ///< apparent diameter, [0.001, 180]
};

/// A ball that emits the same radiance from everywhere.
struct BallLamp {
    Vector3 center;
    double radius = 1;  ///< above 0
    double radiance = 1;
};

/// A flat convex polygon that emits the same radiance from both sides.
struct FlatLamp {
    std::vector<Vector3> vertices;  ///< 3 to 256, in order
    double radiance = 1;
};

using LampShape = std::variant<FarLamp, BallLamp, FlatLamp>;

/// A lamp as points of the scene see it. Radiance 1 is that of a white diffuser in `white`
/// surroundings.
class Lamp {
public:
    /// Throws DomainError, which names the member.
    explicit Lamp(LampShape shape);

    double radiance() const { return radiance_; }
    /// Distance at which a ray from a point meets the lamp, infinity for one far away.
    std::optional<double> distance(const Vector3& from, const Vector3& direction) const;
    /// A direction in which the lamp is seen, drawn by u and v in (0, 1).
    Vector3 draw(const Vector3& from, double u, double v) const;
    /// Probability of draw() per steradian.
    double density(const Vector3& from, const Vector3& direction) const;
    /// Whether the whole lamp lies inside a body. Of a polygon the corners, the middles of the
    /// edges and the centre are looked at, which decides for convex bodies.
    ///   depth  how far a point is from the body's surface, negative outside
    bool is_within(const std::function<double(const Vector3&)>& depth) const;

private:
    struct Cone {
        Vector3 axis;
        double versine;  ///< 1 - cosine of half its angle
    };
    std::optional<Cone> cone_of(const Vector3& from) const;

    LampShape shape_;
    double radiance_ = 0;
    Vector3 normal_;             ///< of a polygon
    std::vector<double> areas_;  ///< of its triangles from the first vertex, summed
};

}  // namespace irido
