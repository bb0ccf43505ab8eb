#include "tables/pictures/rendered.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/math/random.hpp"
#include "tables/pictures/figure.hpp"
#include "tables/pictures/png_file.hpp"

using namespace irido;
using namespace irido::tables;
using Catch::Contains;

namespace {

Picture random_picture(std::size_t width, std::size_t height) {
    Random random(4);
    Picture picture{width, height, {}};
    for (std::size_t i = 0; i < width * height; ++i) {
        const double alpha = i % 3 == 0 ? 0 : i % 3 == 1 ? 1 : random.uniform(0, 1);
        for (int c = 0; c < 3; ++c)
            picture.rgba.push_back(static_cast<float>(alpha * random.uniform(-0.1, 1.2)));
        picture.rgba.push_back(static_cast<float>(alpha));
    }
    return picture;
}

}  // namespace

TEST_CASE("OpenEXR gives back what was drawn, to the last bit", "[pictures]") {
    const Picture picture = random_picture(86, 43);
    const std::string file = exr_file(picture, R"({"irido": "x"})");
    CHECK_THAT(file, Contains("irido.metadata") && Contains("chromaticities"));
    const EnvironmentImage image = environment_from_exr(file);
    REQUIRE((image.width == 86 && image.height == 43));
    for (std::size_t i = 0; i < 86 * 43; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            REQUIRE(image.rgb[3 * i + c] == picture.rgba[4 * i + c]);
    CHECK(exr_file(picture, R"({"irido": "x"})") == file);
}

TEST_CASE("files that are no environment are refused", "[pictures]") {
    const std::string square = exr_file(random_picture(20, 20), "{}");
    CHECK_THROWS_WITH(environment_from_exr(square),
                      Contains("twice as wide as high") && Contains("(got 20 x 20)"));
    CHECK_THROWS_WITH(environment_from_exr("nothing of the kind"),
                      Contains("this OpenEXR file cannot be read"));
    const std::string whole = exr_file(random_picture(40, 20), "{}");
    CHECK_THROWS_AS(environment_from_exr(std::string_view(whole).substr(0, whole.size() / 2)),
                    PictureError);
}

TEST_CASE("PNG has colours in sRGB that alpha is taken out of", "[pictures]") {
    Picture picture{3, 1, {0.5F, 0.25F, 0, 1, 0.25F, 0.125F, 0, 0.5F, 0, 0, 0, 0}};
    const Pixels pixels = pixels_of(picture);
    const auto level = [](double linear) {
        return std::lround(65535 * (1.055 * std::pow(linear, 1 / 2.4) - 0.055));
    };
    CHECK(pixels.inks[0].r == level(0.5));
    CHECK(pixels.inks[1] == pixels.inks[0]);
    CHECK(pixels.alpha == std::vector<std::uint16_t>{65535, 32768, 0});
    const std::string file = png_file(pixels, 8);
    CHECK(file[25] == 6);  // colour type of the header: RGBA
    const Pixels over = pixels_over(picture, {1, 1, 1});
    CHECK(over.alpha.empty());
    CHECK(over.inks[1].r == level(0.75));
    CHECK(over.inks[2].g == 65535);
    picture.rgba[7] = picture.rgba[11] = 1;
    CHECK(png_file(pixels_of(picture), 8)[25] == 2);  // opaque: RGB
}
