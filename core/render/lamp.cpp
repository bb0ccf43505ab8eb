#include "core/render/lamp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/math/constants.hpp"

namespace irido {

namespace {

constexpr double kMostPlace = 1e6, kMostRadiance = 1e9;
constexpr double kWholeSphere = 4 * kPi;

Vector3 cross(const Vector3& a, const Vector3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double length(const Vector3& a) {
    return std::sqrt(dot(a, a));
}

void require_place(const char* name, const Vector3& at) {
    for (const double coordinate : {at.x, at.y, at.z})
        require_in_range(name, coordinate, -kMostPlace, kMostPlace);
}

/// A direction within a cone, evenly.
Vector3 within_cone(const Vector3& axis, double versine, double u, double v) {
    const double down = versine * u, across = std::sqrt(std::max(0.0, down * (2 - down)));
    const Vector3 aside = std::abs(axis.x) < 0.9 ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
    const Vector3 x = normalized(aside - dot(aside, axis) * axis), y = cross(axis, x);
    const double phi = kTwoPi * v;
    return normalized((1 - down) * axis + across * (std::cos(phi) * x + std::sin(phi) * y));
}

double versine_of_half(double angle_deg) {
    const double quarter = std::sin(angle_deg * kDegree / 4);
    return 2 * quarter * quarter;
}

}  // namespace

Lamp::Lamp(LampShape shape) : shape_(std::move(shape)) {
    if (auto* const far = std::get_if<FarLamp>(&shape_)) {
        require_place("direction", far->direction);
        if (!(length(far->direction) > 0)) throw DomainError("direction must not be zero");
        far->direction = normalized(far->direction);
        require_in_range("angle_deg", far->angle_deg, 1e-3, 180);
        require_in_range("irradiance", far->irradiance, 0, kMostRadiance);
        const double sine = std::sin(far->angle_deg * kDegree / 2);
        radiance_ = far->irradiance / (sine * sine);
        return;
    }
    if (const auto* const ball = std::get_if<BallLamp>(&shape_)) {
        require_place("center", ball->center);
        require_in_range("radius", ball->radius, 1e-6, kMostPlace);
        require_in_range("radiance", ball->radiance, 0, kMostRadiance);
        radiance_ = ball->radiance;
        return;
    }
    const auto& flat = std::get<FlatLamp>(shape_);
    require_in_range("radiance", flat.radiance, 0, kMostRadiance);
    radiance_ = flat.radiance;
    const auto& points = flat.vertices;
    if (points.size() < 3 || points.size() > 256)
        throw DomainError("vertices must be 3 to 256 (got " + std::to_string(points.size()) + ")");
    Vector3 sum;
    double sum_of_areas = 0;
    for (const Vector3& point : points) require_place("vertices", point);
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const Vector3 twice = cross(points[i] - points[0], points[i + 1] - points[0]);
        sum = sum + twice;
        areas_.push_back(sum_of_areas += length(twice) / 2);
    }
    if (!(sum_of_areas > 0)) throw DomainError("vertices must not lie in one line");
    constexpr double kFlat = 1e-6;
    if (!(length(sum) > kFlat * sum_of_areas))
        throw DomainError("vertices must be those of a convex polygon, in order");
    normal_ = normalized(sum);
    // of a flat convex polygon all corners turn the same way about its normal
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vector3& a = points[i];
        const Vector3& b = points[(i + 1) % points.size()];
        const Vector3& c = points[(i + 2) % points.size()];
        if (std::abs(dot(b - points[0], normal_)) > kFlat * std::sqrt(sum_of_areas))
            throw DomainError("vertices must lie in one plane");
        if (dot(cross(b - a, c - b), normal_) < -kFlat * sum_of_areas)
            throw DomainError("vertices must be those of a convex polygon, in order");
    }
}

/// The directions of a ball or of a lamp far away; nothing where the point lies inside.
std::optional<Lamp::Cone> Lamp::cone_of(const Vector3& from) const {
    if (const auto* const far = std::get_if<FarLamp>(&shape_))
        return Cone{far->direction, versine_of_half(far->angle_deg)};
    const auto& ball = std::get<BallLamp>(shape_);
    const Vector3 to = ball.center - from;
    const double square = ball.radius * ball.radius / dot(to, to);
    if (!(square < 1)) return std::nullopt;
    return Cone{normalized(to), square / (1 + std::sqrt(1 - square))};
}

std::optional<double> Lamp::distance(const Vector3& from, const Vector3& direction) const {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    if (const auto* const far = std::get_if<FarLamp>(&shape_)) {
        const Vector3 off = direction - far->direction;  // 2 versine = |off|^2
        return dot(off, off) <= 2 * versine_of_half(far->angle_deg) ? std::optional(kInfinite)
                                                                    : std::nullopt;
    }
    if (const auto* const ball = std::get_if<BallLamp>(&shape_)) {
        const Vector3 to = ball->center - from;
        const double middle = dot(to, direction);
        const Vector3 off = to - middle * direction;
        const double root = ball->radius * ball->radius - dot(off, off);
        if (!(root > 0)) return std::nullopt;
        const double half = std::sqrt(root);
        if (middle - half > 0) return middle - half;
        return middle + half > 0 ? std::optional(middle + half) : std::nullopt;
    }
    const auto& points = std::get<FlatLamp>(shape_).vertices;
    const double along = dot(direction, normal_);
    if (along == 0) return std::nullopt;
    const double at = dot(points[0] - from, normal_) / along;
    if (!(at > 0)) return std::nullopt;
    const Vector3 point = from + at * direction;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vector3& a = points[i];
        const Vector3& b = points[(i + 1) % points.size()];
        if (dot(cross(b - a, point - a), normal_) < 0) return std::nullopt;
    }
    return at;
}

Vector3 Lamp::draw(const Vector3& from, double u, double v) const {
    if (!std::holds_alternative<FlatLamp>(shape_)) {
        if (const auto cone = cone_of(from)) return within_cone(cone->axis, cone->versine, u, v);
        return within_cone({0, 0, 1}, 2, u, v);
    }
    const auto& points = std::get<FlatLamp>(shape_).vertices;
    const double area = u * areas_.back();
    const auto found = std::min(std::ranges::upper_bound(areas_, area), areas_.end() - 1);
    const auto i = static_cast<std::size_t>(found - areas_.begin());
    const double before = i == 0 ? 0 : areas_[i - 1];
    const double part = std::clamp((area - before) / (*found - before), 0.0, 1.0);
    const double root = std::sqrt(part);
    const Vector3 point = points[0] + root * (1 - v) * (points[i + 1] - points[0]) +
                          root * v * (points[i + 2] - points[0]);
    const Vector3 to = point - from;
    return dot(to, to) > 0 ? normalized(to) : normal_;
}

bool Lamp::is_within(const std::function<double(const Vector3&)>& depth) const {
    if (std::holds_alternative<FarLamp>(shape_)) return false;
    if (const auto* const ball = std::get_if<BallLamp>(&shape_))
        return depth(ball->center) >= ball->radius;
    const auto& points = std::get<FlatLamp>(shape_).vertices;
    Vector3 sum;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vector3& next = points[(i + 1) % points.size()];
        if (depth(points[i]) < 0 || depth(0.5 * (points[i] + next)) < 0) return false;
        sum = sum + points[i];
    }
    return depth(1 / static_cast<double>(points.size()) * sum) >= 0;
}

double Lamp::density(const Vector3& from, const Vector3& direction) const {
    const std::optional<double> at = distance(from, direction);
    if (!at) return 0;
    if (std::holds_alternative<FlatLamp>(shape_))
        return *at * *at / (std::abs(dot(direction, normal_)) * areas_.back());
    const auto cone = cone_of(from);
    return cone ? 1 / (kTwoPi * cone->versine) : 1 / kWholeSphere;
}

}  // namespace irido
