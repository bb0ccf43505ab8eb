#include <catch2/catch.hpp>
#include <cmath>

#include "core/colorimetry/color_terms.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/sensitivity.hpp"
#include "core/error.hpp"
#include "core/math/random.hpp"

using Catch::WithinAbs;
using namespace irido;

namespace {

const Triple kD65{0.9504706507960727, 1, 1.0888152181351773};

Triple row_of(const Observer& eye, std::size_t row) {
    return {eye.x[row], eye.y[row], eye.z[row]};
}

Triple mixed(const Triple& a, double share, const Triple& b) {
    const double of_a = share / (a[0] + a[1] + a[2]), of_b = (1 - share) / (b[0] + b[1] + b[2]);
    return {of_a * a[0] + of_b * b[0], of_a * a[1] + of_b * b[1], of_a * a[2] + of_b * b[2]};
}

}  // namespace

// Reference: the definitions of CIE 15 in 40 digits.
TEST_CASE("the terms of one colour", "[colorimetry]") {
    const Triple xyz{0.25, 0.3, 0.4};
    const Triple uv = luv(xyz, kD65);
    CHECK_THAT(uv[0], WithinAbs(61.65422220953167, 1e-12));
    CHECK_THAT(uv[1], WithinAbs(-23.86335191617877, 1e-12));
    CHECK_THAT(uv[2], WithinAbs(-11.66658911453982, 1e-12));
    const auto [chroma, hue] = chroma_hue(uv[1], uv[2]);
    CHECK_THAT(chroma, WithinAbs(26.562546305708192, 1e-12));
    CHECK_THAT(hue.value(), WithinAbs(206.05361450834192, 1e-11));
    const DominantWavelength dominant = dominant_wavelength(xyz, kD65, observer(2));
    CHECK_THAT(dominant.wavelength_nm.value(), WithinAbs(488.29197793244066, 1e-9));
    CHECK_THAT(dominant.purity, WithinAbs(0.19110885609840625, 1e-12));
    const Whiteness white = cie_whiteness(xyz, kD65, 2);
    CHECK_THAT(white.whiteness, WithinAbs(92.15612739072938, 1e-11));
    CHECK_THAT(white.tint, WithinAbs(40.96751690888257, 1e-11));
    const Triple standard{60, -15, -20}, sample = lab(xyz, kD65);
    CHECK_THAT(delta_e_76(standard, sample), WithinAbs(10.793175655549284, 1e-11));
    CHECK_THAT(ciede2000(standard, sample), WithinAbs(6.491900973722211, 1e-11));
    CHECK_THAT(delta_e_cmc(standard, sample, 2, 1), WithinAbs(7.005213861432503, 1e-11));
    CHECK_THAT(delta_e_cmc(standard, sample, 1, 1), WithinAbs(7.10721836738278, 1e-11));
}

TEST_CASE("monochromatic light has its own wavelength and purity 1", "[colorimetry]") {
    for (const int degrees : {2, 10})
        for (const std::string_view name : illuminant_names()) {
            const Observer& eye = observer(degrees);
            const Triple white = Sensitivity(eye, illuminant(name)).white();
            INFO(name << " " << degrees);
            for (double nm = 382; nm < 699; nm += 3.5) {
                const auto row = static_cast<std::size_t>(nm - kFirstRow_nm);
                const double part = nm - kFirstRow_nm - static_cast<double>(row);
                Triple pure;
                for (std::size_t c = 0; c < 3; ++c)
                    pure[c] = (1 - part) * row_of(eye, row)[c] + part * row_of(eye, row + 1)[c];
                for (const double share : {1.0, 0.3, 1e-3}) {
                    const auto found = dominant_wavelength(mixed(pure, share, white), white, eye);
                    INFO(nm << " " << share);
                    CHECK_THAT(found.wavelength_nm.value(), WithinAbs(nm, 1e-6 / share));
                    CHECK_THAT(found.purity, WithinAbs(share, 1e-9));
                }
            }
        }
}

TEST_CASE("purples have the complementary wavelength", "[colorimetry]") {
    const Observer& eye = observer(2);
    for (const double violet : {0.2, 0.5, 0.8}) {
        const Triple purple = mixed(row_of(eye, 20), violet, row_of(eye, 339));
        const DominantWavelength found = dominant_wavelength(purple, kD65, eye);
        CHECK_THAT(found.purity, WithinAbs(1, 1e-12));
        REQUIRE(found.wavelength_nm.value() < 0);
        // Mixed with its complement it gives white.
        const double nm = -*found.wavelength_nm;
        const auto row = static_cast<std::size_t>(nm - kFirstRow_nm);
        const double part = nm - kFirstRow_nm - static_cast<double>(row);
        Triple green;
        for (std::size_t c = 0; c < 3; ++c)
            green[c] = (1 - part) * row_of(eye, row)[c] + part * row_of(eye, row + 1)[c];
        const Triple half = mixed(purple, 0.4, kD65);
        const DominantWavelength pale = dominant_wavelength(half, kD65, eye);
        CHECK_THAT(*pale.wavelength_nm, WithinAbs(*found.wavelength_nm, 1e-9));
        CHECK_THAT(pale.purity, WithinAbs(0.4, 1e-12));
        CHECK_THAT(*dominant_wavelength(green, kD65, eye).wavelength_nm, WithinAbs(nm, 1e-9));
    }
}

TEST_CASE("every colour has a dominant or a complementary wavelength", "[colorimetry]") {
    Random random(7);
    for (const int degrees : {2, 10})
        for (const std::string_view name : illuminant_names()) {
            const Observer& eye = observer(degrees);
            const Triple white = Sensitivity(eye, illuminant(name)).white();
            for (int i = 0; i < 300; ++i) {
                const Triple color =
                    mixed(row_of(eye, 30 + random.below(300)), random.uniform(0, 1),
                          row_of(eye, 30 + random.below(300)));
                const DominantWavelength found = dominant_wavelength(color, white, eye);
                REQUIRE(found.wavelength_nm);
                CHECK(std::abs(*found.wavelength_nm) >= 380);
                CHECK(std::abs(*found.wavelength_nm) <= 699);
                CHECK(found.purity > 0);
                CHECK(found.purity < 1 + 2e-3);  // beyond 699 nm the table lacks digits
            }
        }
}

TEST_CASE("the white and black have no hue and no wavelength", "[colorimetry]") {
    for (const Triple& grey : {kD65, Triple{0, 0, 0}, mixed(kD65, 0.2, kD65)}) {
        const DominantWavelength found = dominant_wavelength(grey, kD65, observer(2));
        CHECK_FALSE(found.wavelength_nm);
        CHECK(found.purity == 0);
        const Triple uv = luv(grey, kD65);
        CHECK_FALSE(chroma_hue(uv[1], uv[2]).hue_deg);
    }
    CHECK(cie_whiteness(kD65, kD65, 10).whiteness == 100);
    CHECK(cie_whiteness(kD65, kD65, 10).tint == 0);
    CHECK_THROWS_AS(cie_whiteness(kD65, kD65, 4), DomainError);
    CHECK(chroma_hue(1, -1e-30).hue_deg == 0);
    CHECK(chroma_hue(-3, -4).chroma == 5);
    CHECK_THAT(chroma_hue(0, -2).hue_deg.value(), WithinAbs(270, 1e-12));
}

TEST_CASE("Luv of a pure lightness, and of primaries", "[colorimetry]") {
    CHECK(luv({0, 0, 0}, kD65) == Triple{0, 0, 0});
    CHECK_THAT(luv({kD65[0] / 2, 0.5, kD65[2] / 2}, kD65)[1], WithinAbs(0, 1e-12));
    // The red of sRGB, u' = 4 x/(3 + 12 y - 2 x), v' = 9 y/(3 + 12 y - 2 x).
    const Triple white{0.3127 / 0.329, 1, 0.3583 / 0.329};
    const Triple red{0.4123908, 0.2126390, 0.0193308};
    const Triple uv = luv(red, white);
    CHECK_THAT(uv[1], WithinAbs(13 * uv[0] * (2.56 / 5.68 - 1.2508 / 6.3226), 1e-3));
    CHECK_THAT(uv[2], WithinAbs(13 * uv[0] * (2.97 / 5.68 - 2.961 / 6.3226), 1e-3));
}

TEST_CASE("CMC differences", "[colorimetry]") {
    // A grey standard of L* = 50: S_L = 0.040975 50/(1 + 0.01765 50), S_C = S_H = 0.638.
    CHECK_THAT(delta_e_cmc({50, 0, 0}, {50, 3, 4}, 1, 1), WithinAbs(5 / 0.638, 1e-12));
    CHECK_THAT(delta_e_cmc({50, 0, 0}, {52, 0, 0}, 2, 1),
               WithinAbs(1 / (0.040975 * 50 / 1.8825), 1e-12));
    CHECK_THAT(delta_e_cmc({10, 0, 0}, {9, 0, 0}, 1, 1), WithinAbs(1 / 0.511, 1e-12));
    CHECK(delta_e_cmc({50, 20, 0}, {50, 30, 0}, 1, 1) >
          delta_e_cmc({50, 30, 0}, {50, 20, 0}, 1, 1));
    // The published form, with Delta H^2 = Delta a^2 + Delta b^2 - Delta C^2.
    Random random(3);
    for (int i = 0; i < 500; ++i) {
        const Triple standard{100 * random.uniform(0, 1), 160 * random.uniform(0, 1) - 80,
                              160 * random.uniform(0, 1) - 80};
        const Triple sample{100 * random.uniform(0, 1), 160 * random.uniform(0, 1) - 80,
                            160 * random.uniform(0, 1) - 80};
        const double c1 = std::hypot(standard[1], standard[2]);
        const double c2 = std::hypot(sample[1], sample[2]);
        const double h2 = std::pow(sample[1] - standard[1], 2) +
                          std::pow(sample[2] - standard[2], 2) - std::pow(c2 - c1, 2);
        constexpr double degree = 3.141592653589793 / 180;
        double h = std::atan2(standard[2], standard[1]) / degree;
        if (h < 0) h += 360;
        const double t = h >= 164 && h <= 345 ? 0.56 + std::abs(0.2 * std::cos((h + 168) * degree))
                                              : 0.36 + std::abs(0.4 * std::cos((h + 35) * degree));
        const double f = std::sqrt(std::pow(c1, 4) / (std::pow(c1, 4) + 1900));
        const double sl =
            standard[0] < 16 ? 0.511 : 0.040975 * standard[0] / (1 + 0.01765 * standard[0]);
        const double sc = 0.0638 * c1 / (1 + 0.0131 * c1) + 0.638;
        const double sh = sc * (f * t + 1 - f);
        const double expected =
            std::sqrt(std::pow((sample[0] - standard[0]) / (2 * sl), 2) +
                      std::pow((c2 - c1) / sc, 2) + std::max(0.0, h2) / (sh * sh));
        CHECK_THAT(delta_e_cmc(standard, sample, 2, 1), WithinAbs(expected, 1e-9));
    }
}

TEST_CASE("errors of Lab follow from those of XYZ", "[colorimetry]") {
    Random random(5);
    CHECK_THAT(lab_error({0, 0, 0}, {1, 1, 1}, 1e-3), WithinAbs(7.787037, 1e-6));
    for (int i = 0; i < 1000; ++i) {
        const double error = std::pow(10, -9 + 7 * random.uniform(0, 1));
        Triple xyz, moved;
        for (std::size_t c = 0; c < 3; ++c) {
            xyz[c] = std::pow(random.uniform(0, 1), 4);
            moved[c] = xyz[c] + error * (2 * random.uniform(0, 1) - 1);
        }
        const double found = largest_difference(lab(xyz, kD65), lab(moved, kD65));
        CHECK(found <= lab_error(xyz, kD65, error) + 1e-12);
        CHECK(lab_error(xyz, kD65, xyz_tolerance(kD65, 1e-4)) <= 1e-4);
    }
}
