#include "core/render/path_tracer.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/colorimetry/illuminant.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/random.hpp"
#include "core/render/picture.hpp"
#include "core/rough/layered/layered_scattering.hpp"
#include "core/rough/layered/lobe.hpp"
#include "core/scratch/scratched_scattering.hpp"
#include "core/stack/builder.hpp"
#include "tests/support/sample_surfaces.hpp"

using namespace irido;
using namespace irido::test;
using Catch::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

const Sensitivity& day() {
    static const Sensitivity sensitivity(observer(2), illuminant("D65"));
    return sensitivity;
}

const RgbTransform& rgb_by_day() {
    static const RgbTransform transform(rgb_space("srgb"), day().white(), Adaptation::bradford);
    return transform;
}

PictureNodes picture_nodes(ColorNodes nodes, const std::vector<const Sensitivity*>& others = {}) {
    return {std::move(nodes), day().support(), others, rgb_by_day()};
}

LayeredSurface diffuser(double albedo) {
    LayeredSurface surface;
    surface.outside = surface.inside = StackBuilder().over(1).materials[0];
    surface.base_albedo = Constant{albedo};
    return surface;
}

/// A layered surface ready for pictures, its tables made to 0.02 CIEDE2000.
struct Layered {
    explicit Layered(LayeredSurface surface, const std::vector<const Sensitivity*>& others = {})
        : scattering(std::move(surface), Crossings::single, Execution(1)),
          nodes(picture_nodes(layered_nodes(scattering, day(), rgb_by_day()), others)),
          plan{&nodes, 0.02, 1, best_simd_level()} {}

    std::unique_ptr<const Scatterer> scatterer() const {
        return layered_scatterer(scattering, Paths::single, {}, {0, 1, 0, 0}, plan);
    }
    /// The picture of its surface in a scene.
    Picture draw(const PictureScene& scene) const {
        const PathTracer tracer(scene, {scatterer(), {}}, nodes, {0, 1, 0, 0}, plan);
        return Painter(scene).paint(tracer, 2, [](double) {});
    }

    LayeredScattering scattering;
    PictureNodes nodes;
    TablePlan plan;
};

PictureScene scene_in(const char* environment, ShapeKind shape = ShapeKind::sphere) {
    PictureScene scene;
    scene.camera = {24, 24};
    scene.shape = shape;
    scene.environment = named_environment(environment);
    scene.samples = 16;
    return scene;
}

Vector3 direction_at(double theta_deg, double phi_deg) {
    const double s = std::sin(theta_deg * kDegree);
    return {s * std::cos(phi_deg * kDegree), s * std::sin(phi_deg * kDegree),
            std::cos(theta_deg * kDegree)};
}

Triple mean_pixel(const Picture& picture) {
    Triple sum{};
    for (std::size_t i = 0; i < picture.rgba.size(); ++i)
        if (i % 4 != 3) sum[i % 4] += static_cast<double>(picture.rgba[i]);
    for (double& channel : sum) channel /= static_cast<double>(picture.width * picture.height);
    return sum;
}

const char* const kCoatedGreen = R"({"inside": 1.35, "layers": [{"stack":
    "1.35 | (1.35@250 | 1.5@250)^10 | 1.35", "alpha": 0.1}], "base": {"albedo": 0.5}})";
const char* const kBlueOnRed = R"({"layers": [
    {"stack": "1 | (1@125 | 1.5@375)^20 | 1", "alpha": 0.1},
    {"stack": "1 | (1@101 | 1.5@143)^20 | 1", "alpha": 0.2}], "base": {"albedo": 0.2}})";

ScratchedSurface worn_silver() {
    ScratchedSurface surface;
    StackBuilder builder;
    surface.base = builder.over(Complex{0.05, 3.3});
    ScratchField field;
    field.count_per_mm2 = 40;
    field.width_um = {0.8, 6};
    field.depth_um = {0.05, 0.6};
    surface.fields.push_back(field);
    return surface;
}

}  // namespace

TEST_CASE("lamps are drawn evenly over the directions in which they are seen", "[render]") {
    const Vector3 from{0.1, -0.2, 0.3};
    const double a = 0.4, d = 1.5;  // of a square, seen from its axis
    const Vector3 corner{from.x, from.y + d, from.z};
    const auto square = [&] {
        std::vector<Vector3> corners;
        for (const auto& [x, z] : {std::pair{-a, -a}, {a, -a}, {a, a}, {-a, a}})
            corners.push_back({corner.x + x, corner.y, corner.z + z});
        return FlatLamp{corners, 2};
    };
    const double sine = 0.25 / 2;
    const std::vector<std::pair<Lamp, double>> lamps{
        {Lamp(FarLamp{{1, 2, 3}, 1, 20}), kTwoPi * (1 - std::cos(10 * kDegree))},
        {Lamp(BallLamp{from + Vector3{0, 0, 2}, 0.25, 3}),
         kTwoPi * (1 - std::sqrt(1 - sine * sine))},
        {Lamp(BallLamp{from, 0.25, 3}), 4 * kPi},
        {Lamp(square()), 4 * std::atan(a * a / (d * std::sqrt(d * d + 2 * a * a)))}};
    Random random(5);
    for (const auto& [lamp, solid_angle] : lamps) {
        double sum = 0;
        constexpr int kDraws = 4000;
        for (int i = 0; i < kDraws; ++i) {
            const Vector3 to = lamp.draw(from, random.uniform(0, 1), random.uniform(0, 1));
            REQUIRE_THAT(dot(to, to), WithinAbs(1, 1e-12));
            const double density = lamp.density(from, to);
            REQUIRE(density > 0);
            REQUIRE(lamp.distance(from, to));
            sum += 1 / density;
        }
        CHECK_THAT(sum / kDraws, WithinRel(solid_angle, 0.01));
        CHECK(lamp.density(from, {0, -1, 0}) == (solid_angle == 4 * kPi ? 1 / (4 * kPi) : 0));
    }
    CHECK_THROWS_WITH(Lamp(FarLamp{{0, 0, 0}, 1, 1}), "direction must not be zero");
    CHECK_THROWS_WITH(Lamp(BallLamp{{0, 0, 0}, 0, 1}), Contains("radius"));
    CHECK_THROWS_WITH(Lamp(FlatLamp{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 1}), Contains("one line"));
    CHECK_THROWS_WITH(Lamp(FlatLamp{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1}}, 1}),
                      Contains("one plane"));
    CHECK_THROWS_WITH(Lamp(FlatLamp{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, 1}),
                      Contains("convex"));
}

TEST_CASE("tables of a layered surface have the BRDF of irido brdf", "[render][layered][slow]") {
    for (const char* const json : {kCoatedGreen, kBlueOnRed}) {
        const Layered layered(surface_of(json));
        const auto scatterer = layered.scatterer();
        Scatterer::Memory memory;
        std::vector<float> spectrum(layered.nodes.count());
        Random random(3);
        for (int i = 0; i < 40; ++i) {
            const ScatterPair pair{random.uniform(0, 85), random.uniform(0, 85),
                                   random.uniform(0, 180)};
            const std::vector<double> f =
                layered.scattering.brdf({&pair, 1}, layered.nodes.wavelength_nm(), Paths::single);
            scatterer->scatter(direction_at(pair.theta_o_deg, 0),
                               direction_at(pair.theta_i_deg, pair.phi_deg), 0, spectrum, memory);
            const Triple found = layered.nodes.rgb(spectrum);
            std::vector<float> expected;
            for (const double value : f)
                expected.push_back(
                    static_cast<float>(value * std::cos(pair.theta_i_deg * kDegree)));
            const Triple exact = layered.nodes.rgb(expected);
            for (std::size_t c = 0; c < 3; ++c)
                CHECK_THAT(found[c], WithinAbs(exact[c], 2e-3 * std::max(0.05, exact[1])));
        }
    }
}

TEST_CASE("draws of layered surfaces add up to their albedo", "[render][layered][slow]") {
    for (const char* const json : {kCoatedGreen, kBlueOnRed}) {
        const Layered layered(surface_of(json));
        const auto scatterer = layered.scatterer();
        Scatterer::Memory memory;
        std::vector<float> spectrum(layered.nodes.count()), expected;
        Random random(11);
        for (const double theta : {0.0, 50.0}) {
            const Vector3 to = direction_at(theta, 30);
            Triple sum{};
            constexpr int kDraws = 20000;
            for (int i = 0; i < kDraws; ++i) {
                const auto from = scatterer->draw(to, random.uniform(0, 1), random.uniform(0, 1),
                                                  random.uniform(0, 1));
                if (!from) continue;
                scatterer->scatter(to, *from, 0, spectrum, memory);
                const double density = scatterer->density(to, *from);
                REQUIRE(density > 0);
                const Triple rgb = layered.nodes.rgb(spectrum);
                for (std::size_t c = 0; c < 3; ++c) sum[c] += rgb[c] / density / kDraws;
            }
            const double mirror = layered.scattering.coating().inward(theta).R;
            expected.clear();
            for (const double value : layered.scattering.albedo(
                     {&theta, 1}, layered.nodes.wavelength_nm(), Paths::single))
                expected.push_back(static_cast<float>(value - mirror));
            const Triple exact = layered.nodes.rgb(expected);
            for (std::size_t c = 0; c < 3; ++c) CHECK_THAT(sum[c], WithinRel(exact[c], 0.03));
        }
    }
}

TEST_CASE("tables of scratches have the mean BRDF of their fields", "[render][scratch][slow]") {
    ScratchedSurface surface = worn_silver();
    surface.alpha = 0.1;
    const PictureNodes nodes =
        picture_nodes(scratched_nodes(surface, day(), rgb_by_day(), best_simd_level()));
    const TablePlan plan{&nodes, 0.1, 1, best_simd_level()};
    const std::unique_ptr<const Scatterer> scatterer = scratch_scatterer(surface, plan);
    const ScratchedScattering exact(surface, SurfacePoint{}, {ScratchSum::Kind::ensemble, {}},
                                    Execution(1));
    Scatterer::Memory memory;
    std::vector<float> spectrum(nodes.count()), expected;
    Random random(7);
    for (int i = 0; i < 25; ++i) {
        const Vector3 to = direction_at(random.uniform(0, 80), random.uniform(0, 360));
        const Vector3 from = direction_at(random.uniform(0, 80), random.uniform(0, 360));
        const SkyPair pair{{from.x, from.y, from.z}, {to.x, to.y, to.z}};
        expected.clear();
        for (const double value : exact.brdf({&pair, 1}, nodes.wavelength_nm()))
            expected.push_back(static_cast<float>(value * from.z));
        scatterer->scatter(to, from, 0, spectrum, memory);
        const Triple a = nodes.rgb(spectrum), b = nodes.rgb(expected);
        for (std::size_t c = 0; c < 3; ++c)
            CHECK_THAT(a[c], WithinAbs(b[c], 0.01 * std::abs(b[1]) + 1e-3));
    }
    // every draw has the density that is stated: the mean of 1 over it is the solid angle reached
    double reached = 0;
    constexpr int kDraws = 40000;
    const Vector3 to = direction_at(20, 0);
    for (int i = 0; i < kDraws; ++i)
        if (const auto from = scatterer->draw(to, random.uniform(0, 1), random.uniform(0, 1),
                                              random.uniform(0, 1)))
            reached += 1 / scatterer->density(to, *from) / kDraws;
    CHECK_THAT(reached, WithinRel(kTwoPi, 0.03));
}

TEST_CASE("a white diffuser on a white floor in white surroundings is white", "[render]") {
    PictureScene scene = scene_in("white");
    scene.floor = Triple{1, 1, 1};
    scene.camera.elevation_deg = 25;
    const Layered white(diffuser(1));
    const Picture picture = white.draw(scene);
    for (const float value : picture.rgba)
        CHECK_THAT(static_cast<double>(value), WithinAbs(1, 1e-3));
}

TEST_CASE("a diffuser has the radiance that its lamp's irradiance gives", "[render]") {
    const Sensitivity warm(observer(2), illuminant("A"));
    const Layered white(diffuser(0.5), {&warm});
    PictureScene scene = scene_in("none", ShapeKind::plane);
    const auto lit_by = [&](Lamp lamp, std::size_t number = 0) {
        scene.lamps.clear();
        scene.lamps.push_back({std::move(lamp), number});
        return mean_pixel(white.draw(scene));
    };
    scene.samples = 64;
    // at 60 degrees from the normal
    const Triple far = lit_by(Lamp(FarLamp{{std::sqrt(3.0), 0, 1}, 4, 1}));
    for (const double channel : far) CHECK_THAT(channel, WithinRel(0.5 * 4 * 0.5, 0.02));
    // draws of a narrow lamp weigh next to nothing, its radiance is enormous
    const Triple narrow = lit_by(Lamp(FarLamp{{0, 0, 1}, 2, 0.001}));
    for (const double channel : narrow) CHECK_THAT(channel, WithinRel(1.0, 0.02));
    // a ball far enough for the plane to be even
    const Triple ball = lit_by(Lamp(BallLamp{{0, 0, 100}, 10, 30}));
    for (const double channel : ball) CHECK_THAT(channel, WithinRel(0.5 * 30 * 0.01, 0.02));
    const Triple flat =
        lit_by(Lamp(FlatLamp{{{-5, -5, 100}, {5, -5, 100}, {5, 5, 100}, {-5, 5, 100}}, 30}));
    for (const double channel : flat)
        CHECK_THAT(channel, WithinRel(0.5 * 30 * 100 / (kPi * 1e4), 0.02));
    const Triple lamp = lit_by(Lamp(FarLamp{{0, 0, 1}, 2, 1}), 1);
    const Triple expected = rgb_by_day()(warm.white());
    for (std::size_t c = 0; c < 3; ++c) CHECK_THAT(lamp[c], WithinRel(expected[c], 0.02));
}

TEST_CASE("a smooth sphere shows a lamp of the radiance and the colour it reflects", "[render]") {
    // a lamp that fills the half space before the sphere
    StackBuilder builder;
    const SurfaceStack stack{builder.over(1.5)};
    PictureScene scene = scene_in("none", ShapeKind::plane);
    scene.camera = {4, 4};
    scene.samples = 0;
    scene.lamps.push_back({Lamp(FlatLamp{{{-9, -9, 5}, {9, -9, 5}, {9, 9, 5}, {-9, 9, 5}}, 10})});
    const PictureNodes nodes =
        picture_nodes(smooth_nodes(stack, {0, 1, 0, 0}, day(), rgb_by_day(), best_simd_level()));
    const TablePlan plan{&nodes, 0.02, 1, best_simd_level()};
    const PathTracer tracer(scene, {nullptr, stack}, nodes, {0, 1, 0, 0}, plan);
    const Picture picture = Painter(scene).paint(tracer, 1, [](double) {});
    for (std::size_t i = 0; i < picture.rgba.size(); ++i)
        CHECK_THAT(static_cast<double>(picture.rgba[i]), WithinAbs(i % 4 == 3 ? 1 : 0.4, 1e-4));
}

TEST_CASE("a shadow falls on the floor on the far side of the lamp", "[render]") {
    PictureScene scene = scene_in("none");
    scene.camera = {32, 32, false, 60};
    scene.floor = Triple{0.5, 0.5, 0.5};
    scene.lamps.push_back({Lamp(FarLamp{{-1, 1, 0}, 1, 0.5})});
    const Layered grey(diffuser(0.5));
    const Picture picture = grey.draw(scene);
    const auto at = [&](std::size_t x) {
        return static_cast<double>(picture.rgba[4 * (20 * picture.width + x)]);
    };
    CHECK_THAT(at(0), WithinRel(0.5 * std::cos(45 * kDegree), 0.15));
    CHECK(at(31) < 0.1);
}

TEST_CASE("a bubble by paths is the bubble by sums over its walls", "[render]") {
    StackBuilder builder;
    builder.add(builder.layer(1.33, 400));
    const SurfaceStack stack{builder.over(1)};
    PictureScene scene = scene_in("studio", ShapeKind::bubble);
    scene.camera = {12, 12};
    scene.samples = 256;
    const ColorTables tables(day());
    const Painter painter(scene);
    const Painter::Survey survey = painter.survey(2);
    const PathColors colors(tables, rgb_by_day(), stack, false,
                            {.range = survey.range, .points = survey.points, .threads = 2});
    const Picture sums = painter.paint(colors, 2, [](double) {});
    const PictureNodes nodes =
        picture_nodes(smooth_nodes(stack, {0, 1, 0, 0}, day(), rgb_by_day(), best_simd_level()));
    const TablePlan plan{&nodes, 0.02, 1, best_simd_level()};
    const PathTracer tracer(scene, {nullptr, stack}, nodes, {0, 1, 0, 0}, plan);
    const Picture paths = painter.paint(tracer, 2, [](double) {});
    const Triple a = mean_pixel(sums), b = mean_pixel(paths);
    for (std::size_t c = 0; c < 3; ++c) CHECK_THAT(b[c], WithinRel(a[c], 0.02));
}
