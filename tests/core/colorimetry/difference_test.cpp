#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/sensitivity.hpp"
#include "core/error.hpp"

using Catch::WithinAbs;
using namespace irido;

namespace {

struct Pair {
    Triple lab1, lab2;
    double difference;
};

/// G. Sharma, W. Wu, E. N. Dalal, Color Res. Appl. 30, 21 (2005), table I: the 34 pairs, four
/// decimals. Pairs 9 to 15 are on either side of opposite hues, 10 and 14 exactly opposite.
constexpr std::array<Pair, 34> kPairs{{
    {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
    {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
    {{50, 2.8361, -74.02}, {50, 0, -82.7485}, 3.4412},
    {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
    {{50, -1.1848, -84.8006}, {50, 0, -82.7485}, 1.0000},
    {{50, -0.9009, -85.5211}, {50, 0, -82.7485}, 1.0000},
    {{50, 0, 0}, {50, -1, 2}, 2.3669},
    {{50, -1, 2}, {50, 0, 0}, 2.3669},
    {{50, 2.49, -0.001}, {50, -2.49, 0.0009}, 7.1792},
    {{50, 2.49, -0.001}, {50, -2.49, 0.001}, 7.1792},
    {{50, 2.49, -0.001}, {50, -2.49, 0.0011}, 7.2195},
    {{50, 2.49, -0.001}, {50, -2.49, 0.0012}, 7.2195},
    {{50, -0.001, 2.49}, {50, 0.0009, -2.49}, 4.8045},
    {{50, -0.001, 2.49}, {50, 0.001, -2.49}, 4.8045},
    {{50, -0.001, 2.49}, {50, 0.0011, -2.49}, 4.7461},
    {{50, 2.5, 0}, {50, 0, -2.5}, 4.3065},
    {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
    {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
    {{50, 2.5, 0}, {56, -27, -3}, 31.9030},
    {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
    {{50, 2.5, 0}, {50, 3.1736, 0.5854}, 1.0000},
    {{50, 2.5, 0}, {50, 3.2972, 0}, 1.0000},
    {{50, 2.5, 0}, {50, 1.8634, 0.5757}, 1.0000},
    {{50, 2.5, 0}, {50, 3.2592, 0.335}, 1.0000},
    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
    {{61.2901, 3.7196, -5.3901}, {61.4292, 2.248, -4.962}, 1.8731},
    {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
    {{22.7233, 20.0904, -46.694}, {23.0331, 14.973, -42.5619}, 2.0373},
    {{36.4612, 47.858, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
    {{90.8027, -2.0831, 1.441}, {91.1528, -1.6435, 0.0447}, 1.4441},
    {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
    {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
    {{2.0776, 0.0795, -1.135}, {0.9033, -0.0636, -0.5514}, 0.9082},
}};

}  // namespace

TEST_CASE("CIEDE2000 gives the differences of Sharma, Wu and Dalal", "[color]") {
    for (const Pair& pair : kPairs) {
        INFO("pair " << &pair - kPairs.data() + 1);
        CHECK_THAT(ciede2000(pair.lab1, pair.lab2), WithinAbs(pair.difference, 5e-5));
    }
}

TEST_CASE("CIEDE2000 is symmetric and zero only between equals", "[color]") {
    for (const Pair& pair : kPairs) {
        CHECK(ciede2000(pair.lab2, pair.lab1) == ciede2000(pair.lab1, pair.lab2));
        CHECK(ciede2000(pair.lab1, pair.lab1) == 0);
        CHECK(ciede2000(pair.lab1, pair.lab2) > 0.5);
    }
}

TEST_CASE("CIEDE2000 of greys is their weighted lightness difference", "[color]") {
    // Mean lightness 50: weight 1. Mean 60: 1 + 0.015 * 100 / sqrt(120).
    CHECK_THAT(ciede2000({45, 0, 0}, {55, 0, 0}), WithinAbs(10, 1e-14));
    CHECK_THAT(ciede2000({100, 0, 0}, {0, 0, 0}), WithinAbs(100, 1e-13));
    CHECK_THAT(ciede2000({58, 0, 0}, {62, 0, 0}),
               WithinAbs(4 / (1 + 1.5 / std::sqrt(120.0)), 1e-14));
    // Zeros of either sign have no hue.
    CHECK(ciede2000({50, 0, 0}, {50, -1, 2}) == ciede2000({50, -0.0, -0.0}, {50, -1, 2}));
    CHECK(ciede2000({50, -0.0, 0}, {50, 0, -0.0}) == 0);
}

TEST_CASE("exactly opposite hues are 180 degrees apart whatever the rounding", "[color]") {
    // The formula jumps where the hues are opposite; exactly opposite ones belong to the lower
    // side.
    for (int i = 1; i < 90; ++i) {
        const double a = 3 * std::cos(i * 0.0349), b = 3 * std::sin(i * 0.0349);
        const double opposite = ciede2000({50, a, b}, {50, -a, -b});
        const double before = ciede2000({50, a, b}, {50, -a - 1e-9 * b, -b + 1e-9 * a});
        const double beyond = ciede2000({50, a, b}, {50, -a + 1e-9 * b, -b - 1e-9 * a});
        CHECK_THAT(opposite, WithinAbs(before, 1e-7));
        if (i == 60) CHECK(std::abs(opposite - beyond) > 0.1);
    }
}

TEST_CASE("nearly equal hues are on no jump", "[color]") {
    // Also where a hue passes from 360 to 0 degrees (i = 0).
    for (int i = 0; i < 180; ++i) {
        const double a = 3 * std::cos(i * 0.0349), b = 3 * std::sin(i * 0.0349);
        const double same = ciede2000({50, a, b}, {50, 2.1 * a, 2.1 * b});
        const double left = ciede2000({50, a, b}, {50, 2.1 * a - 1e-9 * b, 2.1 * b + 1e-9 * a});
        const double right = ciede2000({50, a, b}, {50, 2.1 * a + 1e-9 * b, 2.1 * b - 1e-9 * a});
        CHECK_THAT(same, WithinAbs(left, 1e-7));
        CHECK_THAT(same, WithinAbs(right, 1e-7));
    }
}

TEST_CASE("CIELAB of white, black and the mid grey", "[color]") {
    const Triple white{0.9504, 1, 1.0888};
    CHECK(lab(white, white) == Triple{100, 0, 0});
    const Triple black = lab({0, 0, 0}, white);
    CHECK_THAT(black[0], WithinAbs(0, 1e-14));
    CHECK(black[1] == 0);
    CHECK(black[2] == 0);
    // L* = 50 where Y = (66/116)^3.
    const double y = std::pow(66.0 / 116, 3);
    CHECK_THAT(lab({y * 0.9504, y, y * 1.0888}, white)[0], WithinAbs(50, 1e-13));
    // L* = 8 and slope 24389/27 where the cube root joins the line, Y = (6/29)^3 = 216/24389.
    CHECK_THAT(lab({0, 216.0 / 24389, 0}, white)[0], WithinAbs(8, 1e-13));
    CHECK_THAT(lab({0, 0.001, 0}, white)[0], WithinAbs(24.389 / 27, 1e-14));
    CHECK_THAT(lab({0, 216.0 / 24389 + 1e-9, 0}, white)[0] - 8,
               WithinAbs(1e-9 * 24389 / 27, 1e-12));
}

TEST_CASE("CIELAB under an illuminant's own white has neutral greys", "[color]") {
    for (const std::string_view name : illuminant_names()) {
        const Triple white = Sensitivity(observer(2), illuminant(name)).white();
        CHECK(lab(white, white) == Triple{100, 0, 0});
        const Triple grey = lab({white[0] / 4, white[1] / 4, white[2] / 4}, white);
        CHECK_THAT(grey[0], WithinAbs(116 * std::cbrt(0.25) - 16, 1e-13));
        CHECK_THAT(grey[1], WithinAbs(0, 1e-13));
        CHECK_THAT(grey[2], WithinAbs(0, 1e-13));
    }
}

TEST_CASE("CIELAB of single stimuli", "[color]") {
    // f(1) = 1, f(0) = 4/29: X alone, Y alone, Z alone.
    const Triple white{0.9504, 1, 1.0888};
    const double step = 25.0 / 29;
    CHECK_THAT(lab({white[0], 0, 0}, white)[1], WithinAbs(500 * step, 1e-12));
    CHECK_THAT(lab({0, 1, 0}, white)[1], WithinAbs(-500 * step, 1e-12));
    CHECK_THAT(lab({0, 1, 0}, white)[2], WithinAbs(200 * step, 1e-12));
    CHECK_THAT(lab({0, 0, white[2]}, white)[2], WithinAbs(-200 * step, 1e-12));
}

TEST_CASE("CIELAB refuses a white that is none", "[color]") {
    CHECK_THROWS_AS(lab({0.5, 0.5, 0.5}, {0.95, 1, 0}), DomainError);
    CHECK_THROWS_AS(lab({0.5, 0.5, 0.5}, {-0.95, 1, 1}), DomainError);
    CHECK_THROWS_AS(lab({0.5, 0.5, 0.5}, {0.95, std::numeric_limits<double>::quiet_NaN(), 1}),
                    DomainError);
}
