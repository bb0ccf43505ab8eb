#include "core/render/camera.hpp"

#include <algorithm>
#include <numbers>

namespace irido {

Ray Camera::ray(double x, double y) const {
    constexpr double kFar = 1e3;
    const double half = 0.5 * static_cast<double>(std::min(width, height));
    const double right = (x - 0.5 * static_cast<double>(width)) / half;
    const double up = (0.5 * static_cast<double>(height) - y) / half;
    const double tilt = elevation_deg * std::numbers::pi / 180;
    const double c = std::cos(tilt), s = std::sin(tilt);
    const auto turned = [&](const Vector3& a) {
        return Vector3{a.x, c * a.y + s * a.z, c * a.z - s * a.y};
    };
    // the plane z = 0 is where parallel rays have no rounding from a distance
    if (!perspective) return {turned({right / kFill, up / kFill, 0}), turned({0, 0, -1}), -kFar};
    const double slope = std::tan(kView_deg / 2 * std::numbers::pi / 180);
    // the cone that touches the unit sphere has the slope kFill * slope
    const double touching = kFill * slope;
    const double distance = std::sqrt(1 + 1 / (touching * touching));
    return {turned({0, 0, distance}), turned(normalized({slope * right, slope * up, -1})), 0};
}

}  // namespace irido
