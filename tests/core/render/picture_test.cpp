#include "core/render/picture.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/color/stack_color.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/error.hpp"
#include "core/math/angle_of_cosine.hpp"
#include "core/render/facet.hpp"
#include "core/rough/ggx.hpp"
#include "core/stack/builder.hpp"
#include "tests/support/d65_tables.hpp"

using namespace irido;
using Catch::Contains;
using Catch::Matchers::WithinAbs;
using test::d65_tables;

namespace {

const RgbTransform& to_srgb() {
    static const RgbTransform transform(rgb_space("srgb"), d65_tables().sensitivity().white(),
                                        Adaptation::bradford);
    return transform;
}

Stack film_between(Complex outside, Complex film, double nm, Complex base) {
    StackBuilder builder(outside);
    builder.add(builder.layer(film, nm));
    return builder.over(base);
}

Triple color_of(const Stack& stack, double angle_deg, Side side = Side::reflected) {
    return to_srgb()(
        stack_color(d65_tables(), stack, {}, {.sides = {side}}, std::array{angle_deg})[0].xyz);
}

struct Drawing {
    PictureScene scene;
    Stack stack;
    double tolerance = 0.1;
    bool exact = false;
    unsigned threads = 2;

    Picture draw() {
        SurfaceStack surface{stack};
        if (scene.noise) surface.varied = layer_number(stack, 1);
        const Painter painter(scene);
        const Painter::Survey survey = painter.survey(threads);
        const ColorPlan plan{.range = survey.range,
                             .points = survey.points,
                             .tolerance = tolerance,
                             .exact = exact,
                             .threads = threads};
        const auto nothing = [](double) {};
        if (is_simple(scene.shape))
            return painter.paint(ReflectedColors(d65_tables(), to_srgb(), surface, plan), threads,
                                 nothing);
        return painter.paint(
            PathColors(d65_tables(), to_srgb(), surface, is_opaque(scene.shape), plan), threads,
            nothing);
    }
};

PictureScene scene_of(ShapeKind shape, const char* environment, std::size_t size = 48) {
    PictureScene scene;
    scene.camera = {size, size};
    scene.shape = shape;
    scene.environment = named_environment(environment);
    return scene;
}

std::span<const float> pixel(const Picture& picture, std::size_t x, std::size_t y) {
    return std::span(picture.rgba).subspan(4 * (y * picture.width + x), 4);
}

/// Over opaque pixels.
double largest_difference(const Picture& a, const Picture& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        CHECK(a.rgba[i + 3] == b.rgba[i + 3]);
        const auto color = [i](const Picture& of) {
            return std::array{static_cast<double>(of.rgba[i]), static_cast<double>(of.rgba[i + 1]),
                              static_cast<double>(of.rgba[i + 2])};
        };
        most = std::max(most, srgb_difference(color(a), color(b)));
    }
    return most;
}

}  // namespace

TEST_CASE("a pixel of the sphere is the stack's colour at asin(r/R)", "[render]") {
    Drawing drawing{scene_of(ShapeKind::sphere, "white"), film_between(1, 1.38, 420, {1.9, 1.5})};
    for (const bool exact : {false, true}) {
        drawing.exact = exact;
        const Picture picture = drawing.draw();
        for (std::size_t x = 0; x < 48; x += 5) {
            const double r = std::hypot(static_cast<double>(x) + 0.5 - 24, 20.5 - 24) / 21.6;
            const auto found = pixel(picture, x, 20);
            CHECK(found[3] == (r < 1 ? 1 : 0));
            if (r >= 1) continue;
            const Triple wanted = color_of(drawing.stack, std::asin(r) * 180 / kPi);
            for (std::size_t c = 0; c < 3; ++c)
                CHECK_THAT(static_cast<double>(found[c]),
                           WithinAbs(wanted[c], exact ? 2e-6 : 1e-4));
        }
    }
}

TEST_CASE("tables of angle and thickness keep to 0.1 CIEDE2000", "[render]") {
    for (const ShapeKind shape : {ShapeKind::sphere, ShapeKind::bubble}) {
        Drawing drawing{scene_of(shape, "studio", 96), film_between(1, 1.33, 400, 1)};
        drawing.scene.noise = ThicknessNoise{100, 700, 2, 3, 2};
        const Picture table = drawing.draw();
        drawing.exact = true;
        CHECK(largest_difference(table, drawing.draw()) < 0.1);
    }
}

TEST_CASE("what does not absorb is white in white surroundings", "[render]") {
    for (const double nm : {0.0, 100.0, 1500.0}) {
        Drawing bubble{scene_of(ShapeKind::bubble, "white"), film_between(1, 1.4, nm, 1)};
        if (nm == 100) bubble.scene.noise = ThicknessNoise{100, 500, 3, 1, 1};
        const Picture picture = bubble.draw();
        for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
            for (std::size_t c = 0; c < 3 && picture.rgba[i + 3] == 1; ++c)
                REQUIRE_THAT(static_cast<double>(picture.rgba[i + c]), WithinAbs(1, 1e-5));
    }
    Drawing gem{scene_of(ShapeKind::gem, "white"), film_between(1, 1.4, 300, 1.76)};
    gem.scene.inner_index = 1.76;
    gem.scene.noise = ThicknessNoise{100, 500, 1, 1, 1};
    std::size_t inside = 0;
    const Picture jewel = gem.draw();
    for (std::size_t i = 0; i < jewel.rgba.size(); i += 4) {
        if (jewel.rgba[i + 3] == 0) continue;
        ++inside;
        REQUIRE_THAT(static_cast<double>(jewel.rgba[i]), WithinAbs(1, 1e-3));
    }
    CHECK(inside > 500);
    // a perfect mirror: a metal whose index has no real part
    Drawing ring{scene_of(ShapeKind::ring, "white", 64), film_between(1, 1.5, 100, {0, 5})};
    const Picture picture = ring.draw();
    std::size_t shown = 0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
        if (picture.rgba[i + 3] == 1) {
            ++shown;
            REQUIRE_THAT(static_cast<double>(picture.rgba[i]), WithinAbs(1, 1e-5));
        }
    CHECK(shown > 800);
}

// Along a line of sight, a bubble is two walls with an incoherent gap between them.
TEST_CASE("a bubble that absorbs is two walls with an incoherent gap", "[render]") {
    const Complex wall{1.5, 0.08};
    Drawing drawing{scene_of(ShapeKind::bubble, "white"), film_between(1, wall, 350, 1)};
    const Picture picture = drawing.draw();
    StackBuilder builder(1);
    builder.add(builder.layer(wall, 350));
    Element gap = builder.layer(1, 1e6);
    std::get<Layer>(gap.value).coherent = false;
    builder.add(gap);
    builder.add(builder.layer(wall, 350));
    const Stack walls = builder.over(1);
    for (const std::size_t x : {24U, 30U, 36U, 40U, 43U}) {
        const double r = std::hypot(static_cast<double>(x) + 0.5 - 24, 0.5) / 21.6;
        const double angle_deg = std::asin(r) * 180 / kPi;
        const Triple R = color_of(walls, angle_deg),
                     T = color_of(walls, angle_deg, Side::transmitted);
        for (std::size_t c = 0; c < 3; ++c)
            CHECK_THAT(static_cast<double>(pixel(picture, x, 24)[c]), WithinAbs(R[c] + T[c], 2e-4));
    }
}

TEST_CASE("light is refracted by Snell's law, or not at all", "[render]") {
    const Vector3 normal{0, 0, 1};
    for (const double angle_deg : {0.0, 20.0, 70.0}) {
        const double sine = std::sin(angle_deg * kDegree);
        for (const double side : {1.0, -1.0}) {
            const auto in =
                refracted({sine, 0, -side * std::cos(angle_deg * kDegree)}, normal, 1 / 1.76);
            REQUIRE(in);
            CHECK_THAT(in->x, WithinAbs(sine / 1.76, 1e-14));
            CHECK_THAT(dot(*in, *in), WithinAbs(1, 1e-14));
            CHECK(in->z * side < 0);
        }
        CHECK(refracted({sine, 0, -std::cos(angle_deg * kDegree)}, normal, 1.76).has_value() ==
              (1.76 * sine < 1));
    }
}

TEST_CASE("a perfect mirror shows its surroundings", "[render]") {
    Drawing drawing{scene_of(ShapeKind::sphere, "studio"), film_between(1, 1.5, 0, {0, 3})};
    const Picture picture = drawing.draw();
    const auto sphere = sphere_shape();
    for (std::size_t y = 4; y < 48; y += 6)
        for (std::size_t x = 4; x < 48; x += 6) {
            const Ray ray = drawing.scene.camera.ray(static_cast<double>(x) + 0.5,
                                                     static_cast<double>(y) + 0.5);
            const auto hit = sphere->first_hit(ray);
            if (!hit) continue;
            const Triple light = drawing.scene.environment(mirrored(ray.direction, hit->normal));
            for (std::size_t c = 0; c < 3; ++c)
                CHECK_THAT(static_cast<double>(pixel(picture, x, y)[c]),
                           WithinAbs(light[c], 1e-5 * light[c]));
        }
}

TEST_CASE("pictures depend on the seed of their samples, not on threads", "[render]") {
    Drawing drawing{scene_of(ShapeKind::bubble, "sky"), film_between(1, 1.33, 300, 1)};
    drawing.scene.samples = 5;
    drawing.scene.noise = ThicknessNoise{100, 500, 3, 1, 1};
    drawing.threads = 1;
    const Picture one = drawing.draw();
    drawing.threads = 7;
    CHECK(one.rgba == drawing.draw().rgba);
    drawing.scene.seed = 2;
    CHECK(one.rgba != drawing.draw().rgba);
}

TEST_CASE("edges are partly covered where a pixel has samples", "[render]") {
    Drawing drawing{scene_of(ShapeKind::sphere, "white"), film_between(1, 1.5, 100, 1.5)};
    drawing.scene.samples = 16;
    const Picture picture = drawing.draw();
    double covered = 0;
    std::size_t partly = 0;
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4) {
        covered += static_cast<double>(picture.rgba[i]);
        partly += picture.rgba[i] > 0 && picture.rgba[i] < 1 ? 1 : 0;
    }
    CHECK(partly > 80);
    CHECK_THAT(covered, WithinAbs(kPi * 21.6 * 21.6, 3));
}

TEST_CASE("a background fills what is left", "[render]") {
    Drawing drawing{scene_of(ShapeKind::sphere, "white"), film_between(1, 1.5, 100, 1.5)};
    drawing.scene.background = Triple{0.25, 0.5, 0.75};
    const Picture picture = drawing.draw();
    CHECK(std::ranges::equal(pixel(picture, 0, 0), std::array{0.25F, 0.5F, 0.75F, 1.0F}));
    CHECK(pixel(picture, 24, 24)[3] == 1);
}

TEST_CASE("layers are counted through groups, and a missing one is refused", "[render]") {
    StackBuilder builder(1);
    builder.add(builder.layer(1.5, 10));
    builder.add(StackBuilder::group(3, {builder.layer(2, 20), builder.layer(1.4, 30)}));
    builder.add(builder.layer(1.5, 40));
    const Stack stack = builder.over(1.5);
    CHECK(layer_number(stack, 1) == LayerPlace{0});
    CHECK(layer_number(stack, 3) == LayerPlace{1, 1});
    CHECK(layer_number(stack, 4) == LayerPlace{2});
    CHECK(thickness_at(SurfaceStack{stack, {1, 1}}.at(33), {1, 1}) == 33);
    CHECK_THROWS_WITH(layer_number(stack, 5), Contains("the stack has no layer 5"));
    CHECK_THROWS_AS(layer_number(stack, 0), DomainError);
}

namespace {

/// Directional albedo of a rough stack by the midpoint rule in spherical coordinates of the light:
/// the integral of D G1 G1 R / (4 cos_o), where `colors` is R at equal steps of the half angle's
/// cosine.
Triple rough_albedo(double alpha, double theta_o, std::span<const Triple> colors) {
    constexpr int kThetas = 400, kPhis = 400;
    const double last = static_cast<double>(colors.size() - 1);
    Triple sum{};
    const Vector3 o{std::sin(theta_o), 0, std::cos(theta_o)};
    for (int i = 0; i < kThetas; ++i) {
        const double theta = (i + 0.5) * kPi / 2 / kThetas;
        const double masking = smith_masking(alpha, o.z) * smith_masking(alpha, std::cos(theta));
        for (int j = 0; j < kPhis; ++j) {
            const double phi = (j + 0.5) * kPi / kPhis;  // both halves are equal
            const Vector3 l{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                            std::cos(theta)};
            const Vector3 h = normalized(o + l);
            const double place = std::min(last - 1e-9, last * dot(o, h));
            const auto at = static_cast<std::size_t>(place);
            const double weight = std::sin(theta) * ggx_distribution(alpha, h.z) * masking;
            for (std::size_t c = 0; c < 3; ++c)
                sum[c] +=
                    weight * std::lerp(colors[at][c], colors[at + 1][c], place - std::floor(place));
        }
    }
    for (double& channel : sum) channel *= kPi * kPi / kThetas / kPhis / (4 * o.z);
    return sum;
}

}  // namespace

TEST_CASE("a rough plane in white surroundings has the albedo of its BRDF", "[render]") {
    Drawing drawing{scene_of(ShapeKind::plane, "white", 8), film_between(1, 1.38, 420, {1.9, 1.5})};
    std::vector<Triple> colors;
    for (int i = 0; i <= 200; ++i)
        colors.push_back(color_of(drawing.stack, angle_of_cosine(i / 200.0)));
    drawing.scene.samples = 2048;
    for (const double alpha : {0.15, 0.5, 1.0})
        for (const double tilt_deg : {0.0, 40.0, 75.0}) {
            drawing.scene.alpha = alpha;
            drawing.scene.tilt_deg = tilt_deg;
            const Picture picture = drawing.draw();
            const Triple wanted = rough_albedo(alpha, tilt_deg * kDegree, colors);
            for (std::size_t c = 0; c < 3; ++c) {
                double mean = 0;
                for (std::size_t i = 0; i < 64; ++i)
                    mean += static_cast<double>(picture.rgba[4 * i + c]) / 64;
                INFO(alpha << ", " << tilt_deg);
                CHECK_THAT(mean, WithinAbs(wanted[c], 2e-3));
            }
        }
}

TEST_CASE("a rough sphere becomes the smooth one", "[render]") {
    Drawing drawing{scene_of(ShapeKind::sphere, "sky", 32), film_between(1, 1.38, 420, {1.9, 1.5})};
    drawing.scene.samples = 16;
    const Picture smooth = drawing.draw();
    drawing.scene.alpha = 1e-4;
    const Picture rough = drawing.draw();
    for (std::size_t i = 0; i < smooth.rgba.size(); i += 4)
        if (smooth.rgba[i + 3] == 1)
            CHECK_THAT(static_cast<double>(rough.rgba[i]),
                       WithinAbs(static_cast<double>(smooth.rgba[i]), 0.02));
    drawing.scene.samples = 0;
    CHECK_THROWS_WITH(drawing.draw(), Contains("samples of a rough surface must be at least 1"));
    drawing.scene.shape = ShapeKind::bubble;
    CHECK_THROWS_WITH(drawing.draw(), Contains("only spheres and planes can be rough"));
}

// The light is sampled by facets, by its own brightness or by both: the mean is the same.
TEST_CASE("a rough sphere under the sky has the light of its BRDF", "[render]") {
    Drawing drawing{scene_of(ShapeKind::plane, "sky", 4), film_between(1, 1.38, 420, {1.9, 1.5})};
    drawing.scene.alpha = 0.4;
    drawing.scene.tilt_deg = -30;
    drawing.scene.samples = 16384;
    const Picture picture = drawing.draw();
    std::array<double, 3> mean{}, wanted{};
    for (std::size_t i = 0; i < 64; ++i)
        if (i % 4 < 3) mean[i % 4] += static_cast<double>(picture.rgba[i]) / 16;
    // midpoint rule over the sphere of directions
    const Vector3 n = plane_shape(-30)->first_hit(drawing.scene.camera.ray(1, 1))->normal;
    const Vector3 to{0, 0, 1};
    std::vector<Triple> colors;
    for (int i = 0; i <= 100; ++i)
        colors.push_back(color_of(drawing.stack, angle_of_cosine(i / 100.0)));
    constexpr int kSteps = 1200;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const double y = 1 - 2 * (i + 0.5) / kSteps, phi = kTwoPi * (j + 0.5) / kSteps;
            const double across = std::sqrt(1 - y * y);
            const Vector3 from{across * std::sin(phi), y, across * std::cos(phi)};
            const FacetLight facet = facet_light(n, to, from, 0.4);
            if (facet.density == 0) continue;
            const double place = std::min(99.999, 100 * facet.cosine);
            const auto at = static_cast<std::size_t>(place);
            const Triple light = drawing.scene.environment(from);
            for (std::size_t c = 0; c < 3; ++c)
                wanted[c] +=
                    std::lerp(colors[at][c], colors[at + 1][c], place - std::floor(place)) *
                    facet.density * facet.visible_part * light[c] * 4 * kPi / (kSteps * kSteps);
        }
    for (std::size_t c = 0; c < 3; ++c) CHECK_THAT(mean[c], WithinAbs(wanted[c], 0.01 * wanted[c]));
}
