#include "tables/pictures/inks.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/colorimetry/difference.hpp"

using namespace irido;
using namespace irido::tables;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using Catch::Matchers::WithinAbs;

namespace {

double decoded(std::uint16_t component) {
    const double c = component / 65535.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// X, Y, Z of an ink.
Triple xyz_of(const Ink& one) {
    const ColorMatrix matrix = xyz_from_rgb(rgb_space("srgb"));
    const Triple rgb{decoded(one.r), decoded(one.g), decoded(one.b)};
    Triple xyz{};
    for (std::size_t i = 0; i < 3; ++i)
        xyz[i] = matrix[i][0] * rgb[0] + matrix[i][1] * rgb[1] + matrix[i][2] * rgb[2];
    return xyz;
}

}  // namespace

TEST_CASE("inks of colours inside sRGB are their encoding", "[pictures]") {
    for (const GamutMapping mapping : {GamutMapping::clip, GamutMapping::compress}) {
        InkMixer mixer(mapping);
        const Ink mixed = mixer({0.5, 0.25, 0.75});
        CHECK_THAT(decoded(mixed.r), WithinAbs(0.5, 2e-5));
        CHECK_THAT(decoded(mixed.g), WithinAbs(0.25, 2e-5));
        CHECK_THAT(decoded(mixed.b), WithinAbs(0.75, 2e-5));
        CHECK(mixer({1, 1, 1}) == ink(0xffffff));
        CHECK(mixer({1 + 1e-12, 0, -1e-12}) == ink(0xff0000));  // rounding
        CHECK(mixer.note().empty());
    }
}

TEST_CASE("colours brighter than white are not taken for colours outside sRGB", "[pictures]") {
    for (const GamutMapping mapping : {GamutMapping::clip, GamutMapping::compress}) {
        InkMixer bright(mapping), both(mapping);
        for (InkMixer* mixer : {&bright, &both}) {
            (*mixer)({0.5, 0.5, 0.5});
            (*mixer)({3, 2, 1});
            (*mixer)({1, 1, 1.001});
            (*mixer)({9, 0, 0});
        }
        CHECK_THAT(bright.note(), StartsWith("75 % of the colours are brighter than white"));
        both({1.1, 0.5, 0.5});  // not as bright as white
        both({2, 2, -0.1});     // brighter, but yellower than sRGB's yellow
        both({0.2, 0.1, -0.1});
        both({0, 0, 0});
        CHECK_THAT(both.note(), StartsWith("37.5 % of the colours lie outside sRGB, 37.5 % are "
                                           "brighter than white: "));
    }
}

TEST_CASE("compressed colours keep their luminance and reach the edge of sRGB", "[pictures]") {
    const Triple weight = xyz_from_rgb(rgb_space("srgb"))[1];
    for (const Triple& rgb : {Triple{-0.2, 0.5, 0.1}, {1.4, 0.2, 0.1}, {0.3, -0.1, 1.2}}) {
        InkMixer mixer(GamutMapping::compress);
        const Ink mixed = mixer(rgb);
        const double y = weight[0] * rgb[0] + weight[1] * rgb[1] + weight[2] * rgb[2];
        CHECK_THAT(xyz_of(mixed)[1], WithinAbs(y, 2e-5));
        const auto [least, most] = std::minmax({mixed.r, mixed.g, mixed.b});
        CHECK((least <= 1 || most >= 65534));
        CHECK_THAT(mixer.note(), Contains("100 %") && Contains("grey of their luminance"));
    }
    InkMixer mixer(GamutMapping::compress);
    CHECK(mixer({2, 2, 0.5}) == ink(0xffffff));
    CHECK(mixer({-1, -1, 0.5}) == ink(0x000000));
}

TEST_CASE("the share of colours outside is said", "[pictures]") {
    InkMixer mixer;
    CHECK(mixer({-0.2, 0.5, 2}) == mixer({0, 0.5, 1}));
    CHECK_THAT(mixer.note(), Contains("50 % of the colours") && Contains("clipped"));
}

TEST_CASE("the inks of values grow evenly lighter", "[pictures]") {
    const Triple white = rgb_space("srgb").white;
    for (int i = 0; i <= 100; ++i) {
        const double lightness = lab(xyz_of(value_ink(i / 100.0)), white)[0];
        CAPTURE(i);
        CHECK_THAT(lightness, WithinAbs(15 + 0.78 * i, 2.5));  // some blues are clipped
    }
    CHECK(value_ink(-1) == value_ink(0));
    CHECK(value_ink(2) == value_ink(1));
}

TEST_CASE("wavelengths have their hues", "[pictures]") {
    const Ink blue = wavelength_ink(450), green = wavelength_ink(535), red = wavelength_ink(640);
    CHECK((blue.b > blue.r && blue.b > blue.g));
    CHECK((green.g > green.r && green.g > green.b));
    CHECK((red.r > red.g && red.r > red.b));
    CHECK(wavelength_ink(379) == ink(0xffffff));
    CHECK(wavelength_ink(1e7) == ink(0xffffff));
    CHECK(wavelength_ink(780) != ink(0));
}
