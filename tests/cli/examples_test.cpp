// What the examples' sources say about their colours.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/colorimetry/difference.hpp"
#include "tests/support/program.hpp"

using namespace irido;
using namespace irido::test;

namespace {

/// White of D65 and the 2-degree observer, Y = 1.
const Triple kWhite{0.95045592705167, 1, 1.08905775075988};

struct Seen {
    Triple rgb, lab;

    double chroma() const { return std::hypot(lab[1], lab[2]); }
    /// CIELAB hue angle in degrees, [0, 360).
    double hue_deg() const {
        const double angle = std::atan2(lab[2], lab[1]) * (180 / std::numbers::pi);
        return angle < 0 ? angle + 360 : angle;
    }
    double Y = 0;
};

/// The reflected colour of an example, with further settings.
Seen seen(const std::string& example, const std::string& angle,
          const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"color", "schemas/examples/" + example + ".json", "-a",
                                       angle};
    for (const std::string& value : more) arguments.insert(arguments.end(), {"--set", value});
    const Outcome outcome = done(arguments);
    const std::vector<std::string> row = parse_csv(outcome.out).at(1);
    const auto three = [&](std::size_t first) {
        return Triple{std::stod(row.at(first)), std::stod(row.at(first + 1)),
                      std::stod(row.at(first + 2))};
    };
    Seen result{three(7), lab(three(2), kWhite)};
    result.Y = three(2)[1];
    return result;
}

}  // namespace

// FPB24 calls the three zones green, red and purple at normal incidence. Reflection of the first
// layer in air, 5 % at all wavelengths, desaturates all of them: only which of R, G and B is
// largest can be compared. Without it (with light incident from the first layer's index) the
// periods have the hue of their gap, at 521, 623 and 672 nm.
TEST_CASE("the jewel beetle's zones are green and red, the purple one is a deep red",
          "[cli][examples]") {
    const Seen green = seen("jewel-beetle-green", "0"), red = seen("jewel-beetle-red", "0"),
               purple = seen("jewel-beetle-purple", "0");
    CHECK(green.rgb[1] > 1.2 * std::max(green.rgb[0], green.rgb[2]));
    CHECK(red.rgb[0] > 1.1 * std::max(red.rgb[1], red.rgb[2]));
    CHECK(purple.rgb[0] > 1.3 * std::max(purple.rgb[1], purple.rgb[2]));
    // as much blue as green, unlike the other zones: the closest that a single gap comes to purple
    CHECK(purple.rgb[2] / purple.rgb[1] > 0.97);
    CHECK(red.rgb[2] / red.rgb[1] < 0.85);
    for (const Seen& zone : {green, red, purple}) CHECK(zone.chroma() < 10);

    const Seen own_green = seen("jewel-beetle-green", "0", {"incident=1.59"});
    const Seen own_red = seen("jewel-beetle-red", "0", {"incident=1.6"});
    const Seen own_purple = seen("jewel-beetle-purple", "0", {"incident=1.6"});
    // CIELAB hues called green are around 160 degrees, at most halfway to yellow or cyan; reds
    // around 25, up to halfway to yellow (90); purples from 300 (violet) to 350 (crimson)
    CHECK((own_green.hue_deg() > 125 && own_green.hue_deg() < 190));
    CHECK((own_red.hue_deg() > 0 && own_red.hue_deg() < 58));
    // 672 nm alone is red: these layers lack the blue that would make purple
    CHECK((own_purple.hue_deg() > 0 && own_purple.hue_deg() < own_red.hue_deg()));
    CHECK(own_green.chroma() > 60);
    CHECK(own_red.chroma() > 40);
    CHECK(own_purple.chroma() > 20);
    // a longer period gives a darker red, where the eye is less sensitive
    CHECK(own_purple.lab[0] < 0.5 * own_red.lab[0]);
}

TEST_CASE("the jewel beetle's green turns blue as it tilts", "[cli][examples]") {
    for (const std::string angle : {"0", "10"}) {
        const Triple rgb = seen("jewel-beetle-green", angle, {"incident=1.59"}).rgb;
        CHECK(rgb[1] > 1.5 * std::max(rgb[0], rgb[2]));
    }
    for (const std::string angle : {"25", "40"}) {
        const Triple rgb = seen("jewel-beetle-green", angle, {"incident=1.59"}).rgb;
        CHECK(rgb[2] > 1.5 * std::max(rgb[0], rgb[1]));
    }
}

// "clearly visible differences appear with mere 30nm increments. The number N of repetitions mostly
// affects the saturation and intensity of colors. The effect is subtle when the host medium is air,
// but much more noticeable under a coating" (section 5).
TEST_CASE("figure 10: 30 nm are visible, more periods change most under a coating",
          "[cli][examples]") {
    const Seen one = seen("fpb24-figure10-a", "0"), next = seen("fpb24-figure10-b", "0");
    CHECK(ciede2000(one.lab, next.lab) > 10);  // 1 is barely noticeable, 10 obvious at a glance
    const auto gain = [](const std::string& example) {
        return seen(example, "30", {"layers.0.repeat=10"}).Y / seen(example, "30").Y;
    };
    CHECK(gain("fpb24-figure10-a") < 1.5);
    CHECK(gain("fpb24-figure10-c") > 2.5);
}
