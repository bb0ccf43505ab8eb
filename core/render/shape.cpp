#include "core/render/shape.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <vector>

#include "core/error.hpp"

namespace irido {

namespace {

constexpr double kRadian = std::numbers::pi / 180;
constexpr std::array<std::string_view, 5> kShapeNames{"sphere", "bubble", "plane", "ring", "gem"};

class Sphere : public Shape {
public:
    std::optional<Hit> first_hit(const Ray& ray) const override {
        const double middle = -dot(ray.origin, ray.direction);
        const double root = middle * middle - (dot(ray.origin, ray.origin) - 1);
        if (!(root > 0)) return std::nullopt;
        const double half = std::sqrt(root);
        const double distance = middle - half > ray.from ? middle - half : middle + half;
        if (!(distance > ray.from)) return std::nullopt;
        const Vector3 point = ray.origin + distance * ray.direction;
        return Hit{distance, point, normalized(point)};
    }
    double lowest() const override { return -1; }
    double depth(const Vector3& point) const override { return 1 - std::sqrt(dot(point, point)); }
};

class Plane : public Shape {
public:
    explicit Plane(double tilt_deg)
        : normal_{std::sin(tilt_deg * kRadian), 0, std::cos(tilt_deg * kRadian)} {}

    std::optional<Hit> first_hit(const Ray& ray) const override {
        const double along = dot(ray.direction, normal_);
        if (!(along < 0)) return std::nullopt;
        const double distance = -dot(ray.origin, normal_) / along;
        if (!(distance > ray.from)) return std::nullopt;
        return Hit{distance, ray.origin + distance * ray.direction, normal_};
    }
    double lowest() const override { return 0; }
    double depth(const Vector3& point) const override { return -dot(point, normal_); }

private:
    Vector3 normal_;
};

/// Rotation about the x axis: what is above comes forward.
class Turn {
public:
    explicit Turn(double angle_deg)
        : cos_(std::cos(angle_deg * kRadian)), sin_(std::sin(angle_deg * kRadian)) {}
    Vector3 to_world(const Vector3& a) const {
        return {a.x, cos_ * a.y - sin_ * a.z, sin_ * a.y + cos_ * a.z};
    }
    Vector3 to_body(const Vector3& a) const {
        return {a.x, cos_ * a.y + sin_ * a.z, cos_ * a.z - sin_ * a.y};
    }

private:
    double cos_, sin_;
};

class Ring : public Shape {
public:
    explicit Ring(double turn_deg) : turn_(turn_deg) {}

    double lowest() const override {
        return -kMinor - kMajor * std::abs(turn_.to_world({0, 0, 1}).y);
    }

    double depth(const Vector3& point) const override {
        return depth_in_body(turn_.to_body(point));
    }

    std::optional<Hit> first_hit(const Ray& ray) const override {
        constexpr double kNear = 1e-11;
        constexpr int kMostSteps = 2000;
        const Vector3 o = turn_.to_body(ray.origin), d = turn_.to_body(ray.direction);
        // between the ends of the sphere around it
        const double middle = -dot(o, d), root = middle * middle - (dot(o, o) - 1);
        if (!(root > 0)) return std::nullopt;
        const double end = middle + std::sqrt(root);
        double at = std::max(ray.from, middle - std::sqrt(root));
        // no face is nearer than the distance from it, which is known in closed form
        for (int i = 0; i < kMostSteps && at < end; ++i) {
            const Vector3 point = o + at * d;
            const double off = -depth_in_body(point);
            if (off < kNear) {
                const double across = std::hypot(point.x, point.z);
                const Vector3 spine{kMajor * point.x / across, 0, kMajor * point.z / across};
                const Vector3 normal = normalized(point - spine);
                if (dot(normal, d) >= 0) {  // leaves it
                    at += 1e-6;
                    continue;
                }
                return Hit{at, turn_.to_world(point), turn_.to_world(normal)};
            }
            at += off;
        }
        return std::nullopt;
    }

private:
    static double depth_in_body(const Vector3& point) {
        return kMinor - std::hypot(std::hypot(point.x, point.z) - kMajor, point.y);
    }

    static constexpr double kMajor = 0.7, kMinor = 0.28;
    Turn turn_;
};

class Gem : public Shape {
public:
    explicit Gem(double turn_deg) : turn_(turn_deg) {
        constexpr double kGirdle = 0.03;  // half of its height
        const auto add = [this](double slope_deg, double phi_deg, double radius, double height) {
            const double s = std::sin(slope_deg * kRadian), c = std::cos(slope_deg * kRadian);
            const double phi = phi_deg * kRadian;
            const Vector3 normal{s * std::cos(phi), c, s * std::sin(phi)};
            faces_.push_back({turn_.to_world(normal), kSize * (s * radius + c * height)});
        };
        constexpr double kTableRadius = 0.57, kCrown_deg = 34.5, kPavilion_deg = 40.8;
        const double table = kGirdle + (1 - kTableRadius) * std::tan(kCrown_deg * kRadian);
        add(0, 0, 0, table);
        for (int i = 0; i < 8; ++i) {
            const double at = 45.0 * i;
            add(kCrown_deg, at, 1, kGirdle);
            add(21.5, at + 22.5, kTableRadius * 1.005, table);  // stars
            add(180 - kPavilion_deg, at, 1, -kGirdle);
            for (const double side : {11.25, 33.75}) {
                add(41.5, at + side, 0.995, kGirdle);
                add(180 - 42.2, at + side, 0.995, -kGirdle);
                add(90, at + side, 0.99, 0);  // girdle
            }
        }
    }

    std::optional<Hit> first_hit(const Ray& ray) const override {
        double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
        const Face *into = nullptr, *out = nullptr;
        for (const Face& face : faces_) {
            const double along = dot(ray.direction, face.normal);
            const double off = face.offset - dot(ray.origin, face.normal);
            if (along == 0) {
                if (off < 0) return std::nullopt;
                continue;
            }
            const double at = off / along;
            if (along < 0 && at > enter) {
                enter = at;
                into = &face;
            } else if (along > 0 && at < leave) {
                leave = at;
                out = &face;
            }
        }
        if (!(enter < leave)) return std::nullopt;
        const bool is_outside = into && enter > ray.from;
        const Face* const face = is_outside ? into : out;
        const double distance = is_outside ? enter : leave;
        if (!face || !(distance > ray.from)) return std::nullopt;
        return Hit{distance, ray.origin + distance * ray.direction, face->normal};
    }

    double depth(const Vector3& point) const override {
        double least = std::numeric_limits<double>::infinity();
        for (const Face& face : faces_)
            least = std::min(least, face.offset - dot(point, face.normal));
        return least;
    }

    /// The lowest corner: where three faces meet and no other cuts it off.
    double lowest() const override {
        double lowest = 0;
        const auto cross = [](const Vector3& a, const Vector3& b) {
            return Vector3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
        };
        for (std::size_t i = 0; i < faces_.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                for (std::size_t k = 0; k < j; ++k) {
                    const Face &a = faces_[i], &b = faces_[j], &c = faces_[k];
                    const Vector3 bc = cross(b.normal, c.normal);
                    const double volume = dot(a.normal, bc);
                    if (std::abs(volume) < 1e-9) continue;
                    const Vector3 corner = 1 / volume *
                                           (a.offset * bc + b.offset * cross(c.normal, a.normal) +
                                            c.offset * cross(a.normal, b.normal));
                    if (corner.y < lowest && std::ranges::all_of(faces_, [&](const Face& face) {
                            return dot(face.normal, corner) <= face.offset + 1e-9;
                        }))
                        lowest = corner.y;
                }
        return lowest;
    }

private:
    static constexpr double kSize = 0.97;
    struct Face {
        Vector3 normal;
        double offset;
    };
    Turn turn_;
    std::vector<Face> faces_;
};

}  // namespace

std::unique_ptr<const Shape> sphere_shape() {
    return std::make_unique<Sphere>();
}

std::unique_ptr<const Shape> plane_shape(double tilt_deg) {
    constexpr double kMostTilt_deg = 89.9;
    require_in_range("tilt", tilt_deg, -kMostTilt_deg, kMostTilt_deg);
    return std::make_unique<Plane>(tilt_deg);
}

std::unique_ptr<const Shape> ring_shape(double turn_deg) {
    return std::make_unique<Ring>(turn_deg);
}

std::unique_ptr<const Shape> gem_shape(double turn_deg) {
    return std::make_unique<Gem>(turn_deg);
}

double usual_elevation_deg(ShapeKind shape) {
    constexpr double kRing_deg = 52, kGem_deg = 38, kOthers_deg = 25;
    return shape == ShapeKind::ring ? kRing_deg : shape == ShapeKind::gem ? kGem_deg : kOthers_deg;
}

std::unique_ptr<const Shape> make_shape(ShapeKind shape, double tilt_deg, double elevation_deg) {
    const double turn_deg = usual_elevation_deg(shape) - elevation_deg;
    switch (shape) {
        case ShapeKind::plane:
            return plane_shape(tilt_deg);
        case ShapeKind::ring:
            return ring_shape(turn_deg);
        case ShapeKind::gem:
            return gem_shape(turn_deg);
        case ShapeKind::sphere:
        case ShapeKind::bubble:
            break;
    }
    return sphere_shape();
}

bool is_simple(ShapeKind shape) {
    return shape == ShapeKind::sphere || shape == ShapeKind::plane;
}

bool is_opaque(ShapeKind shape) {
    return shape != ShapeKind::bubble && shape != ShapeKind::gem;
}

std::span<const std::string_view> shape_names() {
    return kShapeNames;
}

ShapeKind shape_kind(std::string_view name) {
    const auto found = std::ranges::find(kShapeNames, name);
    if (found == kShapeNames.end()) throw DomainError(not_one_of(kShapeNames, name));
    return static_cast<ShapeKind>(found - kShapeNames.begin());
}

}  // namespace irido
