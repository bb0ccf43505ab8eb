#include "core/render/facet.hpp"

#include <algorithm>

#include "core/math/constants.hpp"
#include "core/rough/ggx.hpp"

namespace irido {

FacetLight facet_light(const Vector3& normal, const Vector3& to, const Vector3& from,
                       double alpha) {
    const double out = dot(to, normal), in = dot(from, normal);
    if (!(out > 0 && in > 0)) return {};
    const Vector3 facet = normalized(to + from);
    const double cosine = std::min(1.0, dot(to, facet));
    const double upright = std::clamp(dot(facet, normal), 0.0, 1.0);
    const double seen = smith_masking(alpha, std::min(1.0, out));
    return {cosine, ggx_distribution(alpha, upright) * seen / (4 * out),
            smith_masking(alpha, std::min(1.0, in))};
}

Vector3 facet_direction(const Vector3& normal, const Vector3& to, double alpha, double u,
                        double v) {
    // axes on the surface
    const Vector3 aside = std::abs(normal.x) < 0.9 ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
    const Vector3 x = normalized(aside - dot(aside, normal) * normal);
    const Vector3 y{normal.y * x.z - normal.z * x.y, normal.z * x.x - normal.x * x.z,
                    normal.x * x.y - normal.y * x.x};
    // the direction where the surface is stretched until its facets are those of a hemisphere
    const Vector3 seen =
        normalized({alpha * dot(to, x), alpha * dot(to, y), std::max(0.0, dot(to, normal))});
    const double across2 = seen.x * seen.x + seen.y * seen.y;
    const Vector3 first =
        across2 > 0 ? 1 / std::sqrt(across2) * Vector3{-seen.y, seen.x, 0} : Vector3{1, 0, 0};
    const Vector3 second{seen.y * first.z - seen.z * first.y, seen.z * first.x - seen.x * first.z,
                         seen.x * first.y - seen.y * first.x};
    // a point of the disc that the hemisphere shows, part of it hidden behind its rim
    const double r = std::sqrt(u), phi = kTwoPi * v;
    const double a = r * std::cos(phi), lower = 0.5 * (1 + seen.z);
    const double b = std::lerp(std::sqrt(1 - a * a), r * std::sin(phi), lower);
    const double c = std::sqrt(std::max(0.0, 1 - a * a - b * b));
    const Vector3 stretched = a * first + b * second + c * seen;
    const Vector3 facet =
        normalized({alpha * stretched.x, alpha * stretched.y, std::max(1e-12, stretched.z)});
    const Vector3 m = facet.x * x + facet.y * y + facet.z * normal;
    return 2 * dot(to, m) * m - to;
}

}  // namespace irido
