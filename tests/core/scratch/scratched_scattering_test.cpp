#include "core/scratch/scratched_scattering.hpp"

#include <catch2/catch.hpp>

#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/scratch/rough_base.hpp"
#include "core/spectrum/spectrum.hpp"
#include "core/stack/builder.hpp"
#include "tests/core/scratch/support.hpp"

using namespace irido;
using namespace irido::test;

namespace {

const Sensitivity& noon() {
    static const Sensitivity sensitivity(observer(2), illuminant("D65"));
    return sensitivity;
}

ScratchedSurface worked_surface() {
    return {std::nullopt, std::nullopt, kVertical, 1, {worked_scratch()}, {}};
}

ScratchedScattering seen_from(const ScratchedSurface& surface, const ScratchSight& sight,
                              const ScratchSum& sum = {}) {
    return {surface, sight, sum, Execution(1)};
}

const SkyPair kPair{direction_of(19.704, 206.496), direction_of(20, 40)};
const LightCone kLamp(SphereLight{{-303.3, -128.2, 944.2}, 60});

}  // namespace

TEST_CASE("colours of a scratch have the values of exact integrals", "[scratch]") {
    const ScratchedScattering scattering = seen_from(worked_surface(), SurfacePoint{});
    const Triple xyz = scattering.colors(std::array{kPair}, noon())[0];
    const Triple exact{65.42336721553863, 72.4667544571869, 87.2064058408174};
    for (std::size_t c = 0; c < 3; ++c) CHECK(relative(xyz[c], exact[c]) < 1e-11);
    const Triple ratio = scattering.light_colors(std::array{kLamp}, std::vector{kPair.view}, noon(),
                                                 {LightIntegral::Kind::band})[0];
    const Triple band{0.01771093295481027, 0.019305930860964205, 0.018300180568327586};
    for (std::size_t c = 0; c < 3; ++c) CHECK(relative(ratio[c], band[c]) < 1e-11);
    const std::vector<double> wavelength_nm{450, 550};
    const std::vector<double> f = scattering.brdf(std::array{kPair}, wavelength_nm);
    CHECK(relative(f[0], 80.8220661071697) < 1e-12);
    const Footprint footprint{Footprint::Kind::ellipse, {}, 150, 80, 20};
    CHECK(relative(seen_from(worked_surface(), footprint).density(), 0.012719706554316024) < 1e-12);
}

// Gauss points of a light that is almost a point against the exact integral over its arcs, which is
// right to about 1e-16 over the square of the half-angle.
TEST_CASE("lights that are almost points reflect as the exact integral says", "[scratch]") {
    Random random(29);
    const std::vector<double> wavelength_nm{430, 610};
    for (int i = 0; i < 60; ++i) {
        const Scratch scratch = random_scratch(random);
        const DepthPhase phase = i % 2 ? DepthPhase::slanted : DepthPhase::vertical;
        const ScratchOptics optics{random.uniform(20, 80), phase};
        const ScratchedScattering scattering =
            seen_from({std::nullopt, std::nullopt, optics, 1, {scratch}, {}}, SurfacePoint{});
        const VisibleScratch seen(scratch, optics, SurfacePoint{});
        // a view in which the light's mirror along the scratch is near
        const UnitVector middle = direction_of(random.uniform(0, 70), random.uniform(-180, 180));
        const auto [tx, ty] = seen.tangent();
        const double along = -(middle[0] * tx + middle[1] * ty) + random.uniform(-1e-3, 1e-3);
        const double most = std::sqrt(1 - along * along);
        const double across = random.uniform(-0.9, 0.9) * most;
        const UnitVector view{along * tx - across * ty, along * ty + across * tx,
                              std::sqrt(1 - along * along - across * across)};
        const double half_angle = random.log_uniform(3e-5, 9e-5), far = 1e4;
        AreaLight light = SphereLight{{far * middle[0], far * middle[1], far * middle[2]},
                                      far * std::sin(half_angle)};
        if (i % 3 == 0) {
            PolygonLight corners;
            for (const double turn : {0.1, 1.4, 2.9, 4.8}) {
                const double x = far * half_angle * std::cos(turn),
                             y = far * half_angle * std::sin(turn);
                corners.vertices_mm.push_back({far * middle[0] + x * middle[2],
                                               far * middle[1] + y * middle[2],
                                               far * middle[2] - x * middle[0] - y * middle[1]});
            }
            light = corners;
        }
        const LightCone cone(light);
        REQUIRE(cone.half_angle() < 1e-4);
        const std::vector<double> ratio = scattering.light_ratios(
            std::array{cone}, std::vector{view}, wavelength_nm, LightIntegral{});
        for (std::size_t w = 0; w < wavelength_nm.size(); ++w) {
            const double exact = light_ratio(seen, LightSlices(cone, seen.tangent()), phase, view,
                                             wavelength_nm[w] / 1000, {});
            CAPTURE(i, w, ratio[w], exact, half_angle);
            CHECK(std::abs(ratio[w] - exact) <= 3e-6 * exact + 1e-20);
        }
    }
}

TEST_CASE("the farthest lights reflect the BRDF towards their middle", "[scratch]") {
    const ScratchedScattering scattering = seen_from(worked_surface(), SurfacePoint{});
    const std::vector<double> wavelength_nm{550};
    const double f = scattering.brdf(std::array{kPair}, wavelength_nm)[0];
    const UnitVector& to = kPair.light;
    for (const double far : {1e8, 1e11}) {
        const auto ratio_of = [&](const AreaLight& light) {
            return scattering.light_ratios(std::array{LightCone(light)}, std::vector{kPair.view},
                                           wavelength_nm, LightIntegral{})[0];
        };
        const double radius = 10, solid_angle = kPi * radius * radius / (far * far);
        const SphereLight ball{{far * to[0], far * to[1], far * to[2]}, radius};
        CHECK(relative(ratio_of(ball), f * to[2] * solid_angle) < 1e-6);
        PolygonLight square;  // level, so seen at the light's angle
        for (const auto& [x, y] :
             {std::pair(-150.0, -100.0), {150.0, -100.0}, {150.0, 100.0}, {-150.0, 100.0}})
            square.vertices_mm.push_back({far * to[0] + x, far * to[1] + y, far * to[2]});
        CHECK(relative(ratio_of(square), f * to[2] * 6e4 * to[2] / (far * far)) < 2e-5);
    }
}

TEST_CASE("a base multiplies by its reflectance and its share of the light", "[scratch]") {
    // a film whose reflectance depends on the angle
    StackBuilder b(1);
    b.add(b.layer(1.4, 300));
    const Stack film = b.over(Complex(2, 3));
    ScratchedSurface surface = worked_surface();
    surface.base = film;
    surface.scratches.front().width_um = 12;  // 11 % of the area
    const std::vector<double> wavelength_nm{430, 610};
    const ScratchedScattering scattering = seen_from(surface, SurfacePoint{});
    const std::vector<double> f = scattering.brdf(std::array{kPair}, wavelength_nm);
    ScratchedSurface bare = surface;
    bare.base.reset();
    const std::vector<double> alone =
        seen_from(bare, SurfacePoint{}).brdf(std::array{kPair}, wavelength_nm);
    const double both = kPair.light[0] * kPair.view[0] + kPair.light[1] * kPair.view[1] +
                        kPair.light[2] * kPair.view[2];
    const StackPower power(film);
    for (std::size_t i = 0; i < 2; ++i) {
        const IndexTable table(film, {wavelength_nm[i]});
        const std::array cosine{std::sqrt((1 + both) / 2)};
        const Spectra spectrum = spectra(power, table, cosine, {});
        const double reflectance = (spectrum.s.R[0] + spectrum.p.R[0]) / 2;
        CHECK(relative(f[i], alone[i] * reflectance * (1 - scattering.density())) < 1e-12);
    }
    // a rough base adds facets, attenuated by the light that the scratches take
    surface.alpha = 0.3;
    const std::vector<double> rough =
        seen_from(surface, SurfacePoint{}).brdf(std::array{kPair}, wavelength_nm);
    ScratchedSurface smooth_only = surface;
    smooth_only.scratches.clear();
    const std::vector<double> facets =
        seen_from(smooth_only, SurfacePoint{}).brdf(std::array{kPair}, wavelength_nm);
    const double rho = scattering.density();
    for (std::size_t i = 0; i < 2; ++i) {
        const double kept = 1 - groove_power(0.28, 1000 / wavelength_nm[i]) * rho * (1 - rho);
        CHECK(facets[i] > 0);
        CHECK(relative(rough[i] - f[i], facets[i] * kept) < 1e-10);
    }
    // for a light small enough to be a single direction
    const LightCone star(SphereLight{{kPair.light[0], kPair.light[1], kPair.light[2]}, 1e-5});
    surface.alpha.reset();
    const std::vector<double> ratio =
        seen_from(surface, SurfacePoint{})
            .light_ratios(std::array{star}, std::vector{kPair.view}, wavelength_nm, {});
    for (std::size_t i = 0; i < 2; ++i)
        CHECK(relative(ratio[i], f[i] * kPi * 1e-10 * kPair.light[2]) < 5e-5);
    CHECK_THROWS_AS(seen_from(surface, SurfacePoint{}, {ScratchSum::Kind::coherent})
                        .light_ratios(std::array{star}, std::vector{kPair.view}, wavelength_nm, {}),
                    DomainError);
}

TEST_CASE("coherent sums of one scratch are its power, of many at a point their interference",
          "[scratch]") {
    const std::vector<double> wavelength_nm{450, 550, 650};
    const Footprint footprint{Footprint::Kind::ellipse, {5, 5}, 90, 30, 70};
    for (const ScratchSight& sight : {ScratchSight(SurfacePoint{}), ScratchSight(footprint)}) {
        ScratchedSurface surface = worked_surface();
        surface.scratches.front().start_um = -100;
        const auto separate = seen_from(surface, sight).brdf(std::array{kPair}, wavelength_nm);
        const auto coherent = seen_from(surface, sight, {ScratchSum::Kind::coherent})
                                  .brdf(std::array{kPair}, wavelength_nm);
        for (std::size_t i = 0; i < 3; ++i) CHECK(relative(coherent[i], separate[i]) < 1e-9);
    }
    // two identical scratches at one place: twice the amplitude
    ScratchedSurface twins = worked_surface();
    twins.scratches.push_back(twins.scratches.front());
    const auto one =
        seen_from(worked_surface(), SurfacePoint{}).brdf(std::array{kPair}, wavelength_nm);
    const auto two = seen_from(twins, SurfacePoint{}, {ScratchSum::Kind::coherent})
                         .brdf(std::array{kPair}, wavelength_nm);
    CHECK(relative(two[0], 4 * one[0]) < 1e-12);
    // the colour of two at a distance, by a sum over many wavelengths
    twins.scratches.back().point = {-60, 40};
    const auto scattering = seen_from(twins, SurfacePoint{}, {ScratchSum::Kind::coherent});
    const Triple xyz = scattering.colors(std::array{kPair}, noon())[0];
    Triple sum{};
    std::vector<double> fine;
    for (int i = 0; i < 47000; ++i) fine.push_back(360.005 + 0.01 * i);
    const std::vector<double> f = scattering.brdf(std::array{kPair}, fine);
    for (std::size_t i = 0; i < fine.size(); ++i) {
        const Triple s = noon().at(fine[i]);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += 0.01 * s[c] * f[i];
    }
    for (std::size_t c = 0; c < 3; ++c) CHECK(relative(xyz[c], sum[c]) < 1e-6);
}

// The facets alone: no scratch comes near.
TEST_CASE("rough bases under area lights have the totals of their facets", "[scratch]") {
    const auto facets_of = [](double alpha, const LightCone& light, const UnitVector& view) {
        const CosineRange range = half_cosines(light, view);
        double sum = 0;
        for (const double weight : facet_weights(alpha, light, view, range)) sum += weight;
        return sum;
    };
    const UnitVector view = direction_of(35, 40);
    // almost the whole sky: the albedo, by another rule
    const LightCone sky(SphereLight{{0, 0, 1000}, 999.999999999});
    for (const double alpha : {0.05, 0.2, 0.6, 1.0}) {
        double albedo = 0;
        constexpr int kRings = 400, kTurns = 800;
        for (int i = 0; i < kRings; ++i) {
            const double cosine = (i + 0.5) / kRings, flat = std::sqrt(1 - cosine * cosine);
            for (int k = 0; k < kTurns; ++k) {
                const double turn = kTwoPi * k / kTurns;
                const UnitVector light{flat * std::cos(turn), flat * std::sin(turn), cosine};
                albedo += facet_brdf(alpha, light, view) * cosine * kTwoPi / (kRings * kTurns);
            }
        }
        CAPTURE(alpha);
        CHECK(relative(facets_of(alpha, sky, view), albedo) < 1e-4);
        CHECK(albedo < 1);
    }
    // about the mirror direction of smooth facets: all of it; beside it: nothing, as D falls
    const double x = -std::sin(35 * kDegree) * std::cos(40 * kDegree),
                 y = -std::sin(35 * kDegree) * std::sin(40 * kDegree), z = std::cos(35 * kDegree);
    const LightCone lamp(SphereLight{{1000 * x, 1000 * y, 1000 * z}, 120});
    CHECK(std::abs(facets_of(1e-4, lamp, view) - 1) < 1e-5);
    CHECK(facets_of(1e-4, LightCone(SphereLight{{0, 0, 1000}, 120}), view) < 1e-6);
    // parts of a light add up, sharp facets on the edge between them
    const auto square = [&](double from, double to) {
        std::vector<std::array<double, 3>> corners;
        for (const auto& [u, v] : {std::pair(from, -200.0), std::pair(to, -200.0),
                                   std::pair(to, 200.0), std::pair(from, 200.0)})
            corners.push_back({1000 * x + u, 1000 * y + v, 1000 * z});
        return LightCone(PolygonLight{corners});
    };
    for (const double alpha : {1e-4, 3e-3, 0.1, 0.7}) {
        const double both = facets_of(alpha, square(-200, 300), view);
        for (const double cut : {-150.0, -1e-3, 0.0, 0.4, 90.0})
            CHECK(relative(facets_of(alpha, square(-200, cut), view) +
                               facets_of(alpha, square(cut, 300), view),
                           both) < 2e-7);
    }
    // a small light is one direction; a film's reflectance follows the angle
    StackBuilder b(1);
    b.add(b.layer(1.4, 300));
    ScratchedSurface surface{b.over(Complex(2, 3)), 0.2, {}, 1, {worked_scratch()}, {}};
    const std::vector<double> wavelength_nm{430, 610};
    const LightCone star(SphereLight{{kPair.light[0], kPair.light[1], kPair.light[2]}, 1e-5});
    const ScratchedScattering scattering = seen_from(surface, SurfacePoint{});
    const auto f = scattering.brdf(std::array{kPair}, wavelength_nm);
    const auto ratio =
        scattering.light_ratios(std::array{star}, std::vector{kPair.view}, wavelength_nm, {});
    for (std::size_t i = 0; i < 2; ++i)
        CHECK(relative(ratio[i], f[i] * kPi * 1e-10 * kPair.light[2]) < 5e-5);
    CHECK_THROWS_AS(facets_of(1e-5, lamp, view), DomainError);
    CHECK(facets_of(0.3, lamp, {1, 0, 0}) == 0);
}

// Each scratch's integral is as exact as the sum needs, not as exact as its own light would.
TEST_CASE("lights on many scratches are the sums of those on each", "[scratch]") {
    Random random(31);
    ScratchedSurface surface;
    for (int i = 0; i < 30; ++i) {
        Scratch scratch = random_scratch(random);
        scratch.start_um = random.uniform(-400, 0);
        scratch.end_um = scratch.start_um + random.uniform(40, 600);
        surface.scratches.push_back(scratch);
    }
    surface.scratches.push_back(worked_scratch());
    const Footprint footprint{Footprint::Kind::ellipse, {}, 90, 40, 20};
    const std::vector<double> wavelength_nm{420, 550, 680};
    const auto all = seen_from(surface, footprint)
                         .light_ratios(std::array{kLamp}, std::vector{kPair.view}, wavelength_nm,
                                       LightIntegral{});
    std::vector<double> sum(3, 0.0);
    for (const Scratch& scratch : surface.scratches) {
        ScratchedSurface one;
        one.scratches = {scratch};
        const auto part = seen_from(one, footprint)
                              .light_ratios(std::array{kLamp}, std::vector{kPair.view},
                                            wavelength_nm, LightIntegral{});
        for (std::size_t i = 0; i < 3; ++i) sum[i] += part[i];
    }
    for (std::size_t i = 0; i < 3; ++i) CHECK(relative(all[i], sum[i]) < 1e-8);
}

TEST_CASE("the mean over places of a field is its ensemble", "[scratch]") {
    ScratchedSurface surface;
    surface.optics = {30, DepthPhase::slanted};
    surface.fields = {{60, {2000, 2000}, {0.8, 2}, {0.1, 0.3}, {-90, 90}}};
    const std::vector<double> wavelength_nm{550};
    // so far from the mirror direction that lobes are much wider than the gaps between angles
    const SkyPair pair{{-kPair.view[0] + 0.02, -kPair.view[1] + 0.01, kPair.light[2]}, kPair.view};
    const ScratchedScattering mean =
        seen_from(surface, SurfacePoint{}, {ScratchSum::Kind::ensemble});
    const double expected = mean.brdf(std::array{pair}, wavelength_nm)[0];
    double sum = 0, density = 0;
    constexpr int kPlaces = 1500;
    Random random(61);
    for (int i = 0; i < kPlaces; ++i) {
        const SurfacePoint at{random.uniform(-2e4, 2e4), random.uniform(-2e4, 2e4)};
        const ScratchedScattering scattering = seen_from(surface, at);
        sum += scattering.brdf(std::array{pair}, wavelength_nm)[0] / kPlaces;
        density += scattering.density() / kPlaces;
    }
    CHECK(relative(mean.density(), 60e-6 * 2000 * 1.4) < 1e-12);
    CHECK(relative(density, mean.density()) < 0.05);
    CHECK(relative(sum, expected) < 0.3);
}

TEST_CASE("spectra of an ensemble are those of its wavelengths one by one", "[scratch]") {
    Random random(62);
    for (int i = 0; i < 6; ++i) {
        ScratchedSurface surface;
        surface.optics = {random.log_uniform(5, 100), DepthPhase::slanted};
        const double angle = random.uniform(-90, 60);
        surface.fields = {
            {60, {2000, 2000}, {0.8, random.uniform(1, 20)}, {0.1, 2}, {angle, angle + 30}}};
        const double tilt = random.one_in(2) ? 0 : random.uniform(0, 0.5);
        const SkyPair pair{{-kPair.view[0] + tilt, -kPair.view[1], kPair.light[2]}, kPair.view};
        const ScratchedScattering mean =
            seen_from(surface, SurfacePoint{}, {ScratchSum::Kind::ensemble});
        std::vector<double> many;
        for (double nm = 360; nm <= 830; nm += 0.5) many.push_back(nm);
        const std::vector<double> together = mean.brdf(std::array{pair}, many);
        const double largest = std::ranges::max(together);
        for (std::size_t j = 0; j < many.size(); j += 94) {
            const double alone = mean.brdf(std::array{pair}, {many[j]})[0];
            CAPTURE(i, tilt, many[j]);
            CHECK(std::abs(together[j] - alone) <= 1e-12 * largest);
        }
    }
}
