#pragma once

#include <cmath>
#include <optional>

namespace irido {

/// A place or a direction in the space of pictures: x to the right, y up, z towards the viewer.
struct Vector3 {
    double x = 0, y = 0, z = 0;

    friend Vector3 operator+(const Vector3& a, const Vector3& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend Vector3 operator-(const Vector3& a, const Vector3& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend Vector3 operator*(double s, const Vector3& a) { return {s * a.x, s * a.y, s * a.z}; }
    Vector3 operator-() const { return {-x, -y, -z}; }
    friend bool operator==(const Vector3&, const Vector3&) = default;
};

inline double dot(const Vector3& a, const Vector3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline Vector3 normalized(const Vector3& a) {
    return 1 / std::sqrt(dot(a, a)) * a;
}

/// The direction of light mirrored by a face: `direction` and the result point along the ray.
inline Vector3 mirrored(const Vector3& direction, const Vector3& normal) {
    return direction - 2 * dot(direction, normal) * normal;
}

/// The direction behind a face, ratio = n before / n behind; nothing beyond the critical angle. The
/// normal, of unit length, may point either way.
inline std::optional<Vector3> refracted(const Vector3& direction, const Vector3& normal,
                                        double ratio) {
    const double along = dot(direction, normal);  // of either sign
    const double square = 1 - ratio * ratio * (1 - along * along);
    if (square < 0) return std::nullopt;
    const double behind = std::copysign(std::sqrt(square), along);
    return ratio * direction + (behind - ratio * along) * normal;
}

}  // namespace irido
