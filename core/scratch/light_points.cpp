#include "core/scratch/light_points.hpp"

#include <cmath>

#include "core/math/constants.hpp"
#include "core/scratch/light_integral.hpp"
#include "core/scratch/vectors.hpp"

namespace irido {

namespace {

Place minus(const Place& a, const Place& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Points on rings about the axis, at equal parts of 1 - cosine weighted by Gauss's rule.
std::vector<LightPoint> points_of(const SphereLight& light, int order) {
    const Place& c = light.center_mm;
    const double distance = length_of(c), sine = light.radius_mm / distance;
    const double versine = sine * sine / (1 + std::sqrt((1 - sine) * (1 + sine)));
    const Place axis{c[0] / distance, c[1] / distance, c[2] / distance};
    const Place aside = std::abs(axis[0]) < 0.9 ? Place{1, 0, 0} : Place{0, 1, 0};
    Place x = cross(axis, aside);
    const double length = length_of(x);
    for (double& value : x) value /= length;
    const Place y = cross(axis, x);
    const int turns = 2 * order;
    std::vector<LightPoint> points;
    for (const RulePoint& ring : legendre_rule(order)) {
        const double down = versine * (1 + ring.x) / 2, across = std::sqrt(down * (2 - down));
        for (int turn = 0; turn < turns; ++turn) {
            const double phi = kTwoPi * (turn + 0.5) / turns;
            LightPoint point{{}, kTwoPi * versine * ring.weight / 2 / turns};
            for (std::size_t i = 0; i < 3; ++i)
                point.direction[i] =
                    (1 - down) * axis[i] + across * (std::cos(phi) * x[i] + std::sin(phi) * y[i]);
            points.push_back(point);
        }
    }
    return points;
}

/// Points of each triangle from the first corner, as of a square with one side drawn to a point.
std::vector<LightPoint> points_of(const PolygonLight& light, int order) {
    const auto& corners = light.vertices_mm;
    const std::vector<RulePoint> rule = legendre_rule(order + 1);  // one more for the Jacobian
    std::vector<LightPoint> points;
    for (std::size_t t = 1; t + 1 < corners.size(); ++t) {
        const Place one = minus(corners[t], corners[0]), two = minus(corners[t + 1], corners[0]);
        const Place normal = cross(one, two);  // of twice the area's length
        for (const RulePoint& u : rule)
            for (const RulePoint& v : rule) {
                const double along = (1 + u.x) / 2, part = (1 + v.x) / 2;
                Place place = corners[0];
                for (std::size_t i = 0; i < 3; ++i)
                    place[i] += along * ((1 - part) * one[i] + part * two[i]);
                const double distance = length_of(place);
                const double facing = std::abs(dot(normal, place)) / distance;
                points.push_back(
                    {{place[0] / distance, place[1] / distance, place[2] / distance},
                     along * u.weight * v.weight / 4 * facing / (distance * distance)});
            }
    }
    return points;
}

}  // namespace

std::vector<LightPoint> light_points(const AreaLight& light, int order) {
    return std::visit([&](const auto& shape) { return points_of(shape, order); }, light);
}

}  // namespace irido
