#include "core/render/shape.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.hpp"
#include "core/math/random.hpp"

using namespace irido;
using Catch::Contains;
using Catch::Matchers::WithinAbs;

namespace {

Vector3 random_direction(Random& random) {
    for (;;) {
        const Vector3 v{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        const double square = dot(v, v);
        if (square > 0.01 && square < 1) return normalized(v);
    }
}

/// A ray that begins outside the unit sphere and passes through it.
Ray random_ray(Random& random) {
    const Vector3 from = 3 * random_direction(random), to = 0.6 * random_direction(random);
    return {from, normalized(to - from), 0};
}

}  // namespace

TEST_CASE("pixel centres of the orthographic camera have theta = asin(r/R)", "[render]") {
    const Camera camera{200, 120};
    const auto sphere = sphere_shape();
    constexpr double kRadius = 0.9 * 60;
    for (std::size_t y = 0; y < 120; y += 7)
        for (std::size_t x = 0; x < 200; x += 7) {
            const double px = static_cast<double>(x) + 0.5, py = static_cast<double>(y) + 0.5;
            const double r = std::hypot(px - 100, py - 60) / kRadius;
            const Ray ray = camera.ray(px, py);
            const auto hit = sphere->first_hit(ray);
            CHECK(hit.has_value() == (r < 1));
            if (!hit) continue;
            const double cosine = -dot(ray.direction, hit->normal);
            CHECK_THAT(std::atan2(r, cosine), WithinAbs(std::asin(r), 1e-14));
        }
}

TEST_CASE("the perspective camera sees the sphere as large", "[render]") {
    const Camera camera{300, 200, true};
    const auto sphere = sphere_shape();
    CHECK(sphere->first_hit(camera.ray(150 + 0.899 * 100, 100)));
    CHECK_FALSE(sphere->first_hit(camera.ray(150 + 0.901 * 100, 100)));
}

TEST_CASE("hits lie on their shapes, met from outside", "[render]") {
    Random random(5);
    const auto on_torus = [](const Vector3& p) {  // its implicit equation, in its own axes
        constexpr double kTilt = 52 * 3.14159265358979323846 / 180;
        const double y = std::cos(kTilt) * p.y + std::sin(kTilt) * p.z;
        const double z = std::cos(kTilt) * p.z - std::sin(kTilt) * p.y;
        const double sum = p.x * p.x + y * y + z * z + 0.7 * 0.7 - 0.28 * 0.28;
        return sum * sum - 4 * 0.7 * 0.7 * (p.x * p.x + z * z);
    };
    std::size_t hits = 0;
    for (const auto& shape : {sphere_shape(), ring_shape(), gem_shape()})
        for (int i = 0; i < 2000; ++i) {
            const Ray ray = random_ray(random);
            const auto hit = shape->first_hit(ray);
            if (!hit) continue;
            ++hits;
            const Vector3 off = ray.origin + hit->distance * ray.direction - hit->point;
            CHECK_THAT(dot(off, off), WithinAbs(0, 1e-20));
            CHECK_THAT(dot(hit->normal, hit->normal), WithinAbs(1, 1e-12));
            CHECK(dot(hit->normal, ray.direction) < 0);
            CHECK(dot(hit->point, hit->point) < 1 + 1e-9);
        }
    CHECK(hits > 3000);
    const auto ring = ring_shape();
    for (int i = 0; i < 2000; ++i)
        if (const auto hit = ring->first_hit(random_ray(random)))
            CHECK_THAT(on_torus(hit->point), WithinAbs(0, 1e-9));
}

TEST_CASE("a ray inside a convex shape meets it once more, from inside", "[render]") {
    Random random(6);
    for (const auto& shape : {sphere_shape(), gem_shape()})
        for (int i = 0; i < 500; ++i) {
            const Ray ray = random_ray(random);
            const auto in = shape->first_hit(ray);
            if (!in) continue;
            const auto out = shape->first_hit({in->point, ray.direction, 1e-9});
            if (!out) continue;  // a graze
            CHECK(dot(out->normal, ray.direction) > 0);
            CHECK_FALSE(shape->first_hit({out->point, ray.direction, 1e-9}));
        }
}

TEST_CASE("a tilted plane shows one angle, and names are checked", "[render]") {
    const auto plane = plane_shape(30);
    const auto hit = plane->first_hit(Camera{}.ray(10, 20));
    REQUIRE(hit);
    CHECK_THAT(hit->normal.z, WithinAbs(std::sqrt(0.75), 1e-15));
    CHECK_THROWS_AS(plane_shape(90), DomainError);
    CHECK(shape_kind("bubble") == ShapeKind::bubble);
    CHECK_THROWS_WITH(shape_kind("cube"),
                      Contains("must be one of sphere, bubble, plane, ring, gem (got 'cube')"));
}
