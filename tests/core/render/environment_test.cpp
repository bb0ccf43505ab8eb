#include "core/render/environment_sampler.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/random.hpp"

using namespace irido;
using Catch::Contains;
using Catch::Matchers::WithinAbs;

namespace {

std::shared_ptr<EnvironmentImage> image_of(std::size_t height, float value) {
    auto image = std::make_shared<EnvironmentImage>(EnvironmentImage{2 * height, height, {}});
    image->rgb.assign(2 * height * height * 3, value);
    return image;
}

}  // namespace

TEST_CASE("environments by name are light, everywhere", "[render]") {
    Random random(2);
    for (const std::string_view name : environment_names()) {
        const Environment environment = named_environment(name);
        for (int i = 0; i < 2000; ++i) {
            const Vector3 d =
                normalized({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
            for (const double c : environment(d)) {
                REQUIRE((name == "none" ? c == 0 : c > 0));
                REQUIRE(c < 100);
                if (name == "white") REQUIRE(c == 1);
            }
        }
    }
    CHECK_THROWS_WITH(named_environment("cave"), Contains("must be one of studio, sky, white"));
}

TEST_CASE("an image has its middle ahead of the camera and its top above", "[render]") {
    const auto image = image_of(64, 0);
    const auto value = [&](std::size_t row, std::size_t column) -> float& {
        return image->rgb[(row * image->width + column) * 3];
    };
    value(31, 63) = value(32, 63) = value(31, 64) = value(32, 64) = 8;  // ahead
    for (std::size_t column = 0; column < 128; ++column) value(0, column) = 3;
    value(31, 95) = value(32, 95) = value(31, 96) = value(32, 96) = 5;  // to the right
    value(31, 0) = value(32, 0) = value(31, 127) = value(32, 127) = 2;  // behind the camera
    const Environment environment = image_environment(image);
    CHECK_THAT(environment({0, 0, -1})[0], WithinAbs(8, 1e-6));
    CHECK_THAT(environment({0, 1, 0})[0], WithinAbs(3, 1e-6));
    CHECK_THAT(environment({1, 0, 0})[0], WithinAbs(5, 1e-6));
    CHECK_THAT(environment({0, 0, 1})[0], WithinAbs(2, 1e-6));
    CHECK_THAT(environment({0, -1, 0})[0], WithinAbs(0, 1e-6));
    CHECK(environment({0, 0, -1})[1] == 0);
}

TEST_CASE("images that are no environment are refused", "[render]") {
    CHECK_THROWS_WITH(image_environment(std::make_shared<EnvironmentImage>(
                          EnvironmentImage{30, 10, std::vector<float>(900)})),
                      Contains("twice as wide as high (got 30 x 10)"));
    CHECK_THROWS_AS(image_environment(std::make_shared<EnvironmentImage>()), DomainError);
    for (const float bad :
         {-1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        auto image = image_of(8, 1);
        image->rgb[3 * 16 + 2] = bad;
        CHECK_THROWS_WITH(image_environment(image), Contains("in row 1, column 0"));
    }
}

TEST_CASE("directions are drawn as their density says, and more often where it is bright",
          "[render]") {
    const EnvironmentSampler white(named_environment("white")), sky(named_environment("sky"));
    CHECK(white.is_uniform());
    CHECK_FALSE(sky.is_uniform());
    Random random(8);
    const Environment light = named_environment("sky");
    // the mean of 1 / density is the whole sphere, that of light / density the total light
    double sphere = 0, drawn = 0, even = 0, even_square = 0, drawn_square = 0;
    constexpr int kDraws = 200'000;
    for (int i = 0; i < kDraws; ++i) {
        const double u = random.uniform(0, 1), v = random.uniform(0, 1);
        const Vector3 d = sky.direction(u, v), e = white.direction(u, v);
        CHECK_THAT(dot(d, d), WithinAbs(1, 1e-12));
        REQUIRE(sky.density(d) > 0);
        const double by_light = light(d)[0] / sky.density(d), evenly = light(e)[0] * 4 * kPi;
        sphere += 1 / sky.density(d) / kDraws;
        drawn += by_light / kDraws;
        drawn_square += by_light * by_light / kDraws;
        even += evenly / kDraws;
        even_square += evenly * evenly / kDraws;
        if (i < 1000) CHECK_THAT(white.density(e), WithinAbs(1 / (4 * kPi), 1e-10));
    }
    CHECK_THAT(sphere, WithinAbs(4 * kPi, 0.1));
    CHECK_THAT(drawn, WithinAbs(even, 0.02 * even));
    CHECK(drawn_square - drawn * drawn < 0.1 * (even_square - even * even));
}
