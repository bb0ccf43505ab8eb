#include "core/scratch/light.hpp"

#include <catch2/catch.hpp>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/sine_integral.hpp"
#include "core/scratch/diffraction.hpp"
#include "core/scratch/light_integral.hpp"
#include "tests/core/scratch/support.hpp"

using namespace irido;
using namespace irido::test;

namespace {

using Place = std::array<double, 3>;

const AreaLight kSphere = SphereLight{{-303.3, -128.2, 944.2}, 60};
const AreaLight kQuad =
    PolygonLight{{{-300, -200, -80}, {-320, 100, -60}, {-300, 120, 250}, {-280, -180, 260}}};

Place minus(const Place& a, const Place& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Place cross(const Place& a, const Place& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Place& a, const Place& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Whether a ray from the origin meets a triangle (Moeller and Trumbore), a sphere.
bool meets(const UnitVector& ray, const Place& a, const Place& b, const Place& c) {
    const Place e1 = minus(b, a), e2 = minus(c, a), p = cross(ray, e2);
    const double determinant = dot(e1, p);
    const Place from{-a[0], -a[1], -a[2]}, q = cross(from, e1);
    const double u = dot(from, p) / determinant, v = dot(ray, q) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && dot(e2, q) / determinant > 0;
}
bool meets(const UnitVector& ray, const AreaLight& light) {
    if (const auto* sphere = std::get_if<SphereLight>(&light)) {
        const double along = dot(ray, sphere->center_mm);
        const Place off = cross(ray, sphere->center_mm);
        return along > 0 && dot(off, off) <= sphere->radius_mm * sphere->radius_mm;
    }
    const auto& v = std::get<PolygonLight>(light).vertices_mm;
    for (std::size_t i = 1; i + 1 < v.size(); ++i)
        if (meets(ray, v[0], v[i], v[i + 1])) return true;
    return false;
}

/// A convex polygon: points of an ellipse in a random plane.
AreaLight random_polygon(Random& random) {
    const UnitVector a = random_direction(random), b = random_direction(random);
    const Place center{random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-1, 4)};
    PolygonLight light;
    const int corners = 3 + static_cast<int>(random.below(6));
    for (int i = 0; i < corners; ++i) {
        const double turn = kTwoPi * (i + random.uniform(0, 0.9)) / corners;
        Place vertex = center;
        for (std::size_t k = 0; k < 3; ++k)
            vertex[k] += 2 * std::cos(turn) * a[k] + 2 * std::sin(turn) * b[k];
        light.vertices_mm.push_back(vertex);
    }
    return light;
}

}  // namespace

TEST_CASE("slices of lights hold the directions that rays hit", "[scratch]") {
    Random random(21);
    std::size_t hits = 0, differences = 0, rays = 0;
    for (int i = 0; i < 500; ++i) {
        AreaLight light = random_polygon(random);
        if (i % 2)
            light =
                SphereLight{{random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-1, 4)},
                            random.log_uniform(0.05, 2)};
        std::optional<LightCone> cone;
        try {
            cone.emplace(light);
        } catch (const DomainError&) {
            continue;  // around the point
        }
        const double angle = random.uniform(0, kTwoPi);
        const std::array tangent{std::cos(angle), std::sin(angle)};
        const LightSlices slices(*cone, tangent);
        for (int k = 0; k < 240; ++k, ++rays) {
            const double tau = random.uniform(-1, 1), psi = random.uniform(-kPi / 2, kPi / 2);
            const double r = std::sqrt(1 - tau * tau), b = r * std::sin(psi);
            const UnitVector ray{tau * tangent[0] - b * tangent[1],
                                 tau * tangent[1] + b * tangent[0], r * std::cos(psi)};
            bool inside = false;
            for (const Arc& arc : slices.at(tau)) inside |= psi >= arc.from && psi <= arc.to;
            const bool hit = meets(ray, light);
            hits += hit;
            differences += inside != hit || cone->contains(ray) != hit;
            if (hit) {
                REQUIRE(!slices.breaks().empty());
                REQUIRE((tau >= slices.breaks().front() && tau <= slices.breaks().back()));
                REQUIRE(dot(ray, cone->bound().normal) >= cone->bound().least - 1e-12);
            }
        }
    }
    CHECK(rays > 100000);
    CHECK(hits > 5000);
    CHECK(differences == 0);
}

TEST_CASE("reflected area lights have the values of a 40-digit evaluation", "[scratch]") {
    struct Case {
        AreaLight light;
        double width, angle_deg;
        UnitVector view;
        double density, from, to;
        std::array<double, 3> band, exact;
    };
    const std::array cases{
        Case{kSphere,
             2,
             30,
             direction_of(20, 40),
             0.018357019694517623,
             0.040904432534922174,
             0.15866884434505762,
             {0.01667303597734873, 0.01967749166835642, 0.018080278593172173},
             {0.016671015090111742, 0.01967407608237355, 0.018075927066806746}},
        Case{kQuad,
             1,
             100,
             direction_of(55, 20),
             0.009194876968380722,
             -0.056571985093943566,
             0.18312430286462889,
             {0.014718456479109378, 0.01460806263189715, 0.01209809376212429},
             {0.014718458278368356, 0.014608061844963027, 0.012098090478382333}}};
    for (const Case& given : cases) {
        const VisibleScratch seen(worked_scratch(given.width, given.angle_deg), kVertical,
                                  SurfacePoint{});
        const LightSlices slices(LightCone(given.light), seen.tangent());
        CHECK(relative(seen.share(), given.density) < 1e-12);
        const auto intervals = band_intervals(seen, slices, given.view);
        REQUIRE(intervals.size() == 1);
        CHECK(std::abs(intervals[0].from - given.from) < 1e-13);
        CHECK(std::abs(intervals[0].to - given.to) < 1e-13);
        for (std::size_t i = 0; i < 3; ++i) {
            const double wavelength = 0.45 + 0.1 * static_cast<double>(i);
            const auto ratio = [&](const LightIntegral& method) {
                return light_ratio(seen, slices, DepthPhase::vertical, given.view, wavelength,
                                   method);
            };
            CHECK(relative(ratio({LightIntegral::Kind::band}), given.band[i]) < 1e-11);
            CHECK(relative(ratio({}), given.exact[i]) < 1e-9);
            CHECK(relative(ratio({LightIntegral::Kind::points, 32}), given.exact[i]) < 1e-4);
            CHECK(relative(ratio({LightIntegral::Kind::points, 64}), given.exact[i]) < 3e-5);
        }
    }
}

// A second way: the light's directions on a grid of xi_1 and q, against the BRDF itself.
TEST_CASE("area lights are sums of point lights", "[scratch]") {
    Random random(22);
    for (int i = 0; i < 12; ++i) {
        Scratch scratch = random_scratch(random);
        scratch.width_um = random.uniform(0.5, 3);
        scratch.depth_um = random.uniform(0.05, 0.6);
        if (i % 3 == 2) scratch.start_um = random.uniform(-30, 10);
        const ScratchOptics optics{8, i % 2 ? DepthPhase::slanted : DepthPhase::vertical};
        const UnitVector view = direction_of(random.uniform(0, 60), random.uniform(-180, 180));
        const VisibleScratch seen(scratch, optics, SurfacePoint{});
        // around the mirror direction, and somewhat off
        const AreaLight light = SphereLight{
            {-view[0] + random.uniform(-0.1, 0.1), -view[1] + random.uniform(-0.1, 0.1), view[2]},
            random.uniform(0.05, 0.3)};
        const LightCone cone(light);
        CosineSeries reflectance;
        if (i % 4 == 3) {
            const CosineRange range{0, 1};
            std::vector<double> values;
            for (const double c : CosineSeries::nodes(range)) values.push_back(0.2 + 0.7 * c * c);
            reflectance = {range, values};
        }
        const LightSlices slices(cone, seen.tangent());
        const double ratio =
            light_ratios(seen, {slices, optics.depth_phase, view}, std::array{1 / 0.55}, {},
                         reflectance, lobe_under(seen, slices, view, 0.55))[0];
        // polar grid in the cone
        const UnitVector axis = cone.bound().normal;
        const double top = std::acos(cone.bound().least);
        UnitVector side = cross(axis, {0, 1, 0});
        const double length = std::sqrt(dot(side, side));
        for (double& value : side) value /= length;
        const UnitVector up = cross(axis, side);
        constexpr int kRings = 500, kTurns = 500;
        double sum = 0;
        for (int ring = 0; ring < kRings; ++ring) {
            const double theta = top * (ring + 0.5) / kRings;
            for (int turn = 0; turn < kTurns; ++turn) {
                const double phi = kTwoPi * (turn + 0.5) / kTurns;
                UnitVector w{};
                for (std::size_t k = 0; k < 3; ++k)
                    w[k] = std::cos(theta) * axis[k] +
                           std::sin(theta) * (std::cos(phi) * side[k] + std::sin(phi) * up[k]);
                if (w[2] <= 0) continue;
                double f = scratch_brdf(seen, pair_of(seen, optics.depth_phase, w, view), 0.55);
                if (!reflectance.is_empty()) f *= reflectance(std::sqrt((1 + dot(w, view)) / 2), 0);
                sum += f * w[2] * std::sin(theta) * top / kRings * kTwoPi / kTurns;
            }
        }
        CAPTURE(i, ratio, sum);
        CHECK(std::abs(ratio - sum) < 2e-5 * sum + 1e-9);
    }
}

TEST_CASE("the whole sky as a light reflects the closed total", "[scratch]") {
    // six triangles around the zenith, each a light of its own
    Random random(23);
    for (int i = 0; i < 10; ++i) {
        Scratch scratch = random_scratch(random);
        const VisibleScratch seen(scratch, kVertical, SurfacePoint{});
        const UnitVector view = direction_of(random.uniform(0, 80), random.uniform(-180, 180));
        double sum = 0;
        for (int k = 0; k < 3; ++k) {
            const double a = kTwoPi * k / 3, b = kTwoPi * (k + 1) / 3;
            const LightCone cone(PolygonLight{
                {{0, 0, 1}, {std::cos(a), std::sin(a), 0}, {std::cos(b), std::sin(b), 0}}});
            sum += light_ratio(seen, LightSlices(cone, seen.tangent()), DepthPhase::vertical, view,
                               0.55, {});
        }
        const auto [tx, ty] = seen.tangent();
        const double along = view[0] * tx + view[1] * ty, across = view[1] * tx - view[0] * ty;
        const double r = std::sqrt(1 - along * along), turn = kTwoPi * scratch.width_um / 0.55;
        const double exact = seen.share() * groove_power(2 * scratch.depth_um, 1 / 0.55) / kPi *
                             slit_integral(turn * (across - r), turn * (across + r));
        CHECK(relative(sum, exact) < 1e-4);  // the lobe has a width, r changes over it
    }
}

// VWH18 eq. 31 takes a disc through the centre of the sphere, across the way to it: its half-angle
// has the tangent that the cone's has as its sine.
TEST_CASE("the published disc in the place of a sphere is too small", "[scratch]") {
    for (const auto& [angle_deg, missing] : {std::pair(10.0, 0.03), {20.0, 0.11}, {45.0, 0.37}}) {
        const double sine = std::sin(angle_deg * kPi / 180);
        const LightCone cone(SphereLight{{0, 0, 1}, sine});
        const double whole = 1 - cone.bound().least, disc = 1 - std::cos(std::atan(sine));
        CHECK(std::abs(1 - whole / (1 - std::cos(angle_deg * kPi / 180))) < 1e-12);
        CHECK(std::abs(1 - disc / whole - missing) < 0.006);
    }
}

TEST_CASE("lights that are none are refused", "[scratch]") {
    CHECK_THROWS_AS(LightCone(SphereLight{{0, 0, 1}, 1}), DomainError);
    CHECK_THROWS_AS(LightCone(SphereLight{{0, 0, 1}, 0}), DomainError);
    CHECK_THROWS_AS(LightCone(SphereLight{{0, 0, kInfinity}, 1}), DomainError);
    CHECK_THROWS_AS(LightCone(PolygonLight{{{0, 0, 1}, {1, 0, 1}}}), DomainError);
    CHECK_THROWS_AS(LightCone(PolygonLight{{{0, 0, 1}, {1, 0, 1}, {2, 0, 1}}}), DomainError);
    CHECK_THROWS_AS(LightCone(PolygonLight{{{0, 0, 1}, {2, 0, 1}, {0.2, 0.2, 1}, {0, 2, 1}}}),
                    DomainError);
    CHECK_THROWS_AS(LightCone(PolygonLight{{{0, 0, 0}, {2, 0, 1}, {0, 2, 1}}}), DomainError);
    // below the horizon there is no light
    const LightCone below(SphereLight{{0, 1, -3}, 1});
    CHECK(LightSlices(below, {1, 0}).breaks().empty());
    const VisibleScratch seen(worked_scratch(), kVertical, SurfacePoint{});
    CHECK(light_ratio(seen, LightSlices(below, seen.tangent()), DepthPhase::vertical, {0, 0, 1},
                      0.5, {}) == 0);
    CHECK_THROWS_AS(legendre_rule(0), DomainError);
    for (const int count : {1, 2, 7, 64}) {
        double sum = 0, square = 0;
        for (const RulePoint& point : legendre_rule(count)) {
            sum += point.weight;
            square += point.weight * point.x * point.x;
        }
        CHECK(std::abs(sum - 2) < 1e-14);
        if (count > 1) CHECK(std::abs(square - 2.0 / 3) < 1e-14);
    }
}
