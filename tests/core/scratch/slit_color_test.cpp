#include "core/scratch/slit_color.hpp"

#include <catch2/catch.hpp>

#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/sine_integral.hpp"
#include "core/scratch/diffraction.hpp"
#include "tests/core/scratch/support.hpp"

using namespace irido;
using namespace irido::test;

namespace {

const Sensitivity& noon() {
    static const Sensitivity sensitivity(observer(2), illuminant("D65"));
    return sensitivity;
}

void check_near(const Triple& value, const Triple& exact, double error) {
    for (std::size_t c = 0; c < 3; ++c) CHECK(std::abs(value[c] - exact[c]) < error);
}

}  // namespace

TEST_CASE("colours of scratches have the values of exact integrals", "[scratch]") {
    const std::array u{0.731, 3.2}, depth{0.14, 0.6};
    const SlitColors colors(noon(), 3.2, 0.6);
    check_near(colors.power(u, depth)[0],
               {1.6689969692542799, 1.8044583691492815, 1.7694292367590834}, 1e-12);
    check_near(colors.slope(u, depth)[0],
               {0.19537658982328301, 0.27214729260189374, 0.27993740835571185}, 1e-12);
    check_near(colors.power(u, depth)[3],
               {0.4156353420259461, 0.6550449771428876, 1.5464618010651938}, 1e-12);
    check_near(colors.slope(u, depth)[3],
               {0.0014670795106226718, 0.002760446885569974, 0.0058327662933414775}, 1e-12);
    const Sensitivity equal(observer(2), illuminant("E"));
    const std::array u2{0.05}, depth2{1.75};
    const SlitColors flat(equal, 0.05, 1.75);
    check_near(flat.power(u2, depth2)[0],
               {0.16820487253286037, 0.17901155415884362, 0.2115609793607267}, 1e-12);
    check_near(flat.slope(u2, depth2)[0],
               {3.3042627784177623, 3.515655316919108, 4.119631374968874}, 1e-11);
}

TEST_CASE("tables of scratches agree with each other and with sums over the spectrum",
          "[scratch]") {
    Random random(31);
    const SlitColors colors(noon(), 60, 8);
    const Triple carrier = kSlitCarriers_um;
    const SensitivityPoints points = sensitivity_points(noon(), 80e3);
    for (int i = 0; i < 60; ++i) {
        const double at = random.log_uniform(1e-3, 50), deep = random.uniform(0, 8), step = 1e-4;
        const std::array u{at - step, at, at + step, -at};
        const std::array depth{deep};
        const std::array with_zero{0.0, deep};
        const std::vector<Triple> t = colors.power(u, depth);
        const Triple slope = colors.slope(std::array{at}, depth)[0];
        const auto q = colors.carried(std::array{at}, with_zero, carrier);
        Triple exact{};
        for (std::size_t k = 0; k < points.wavenumber.size(); ++k) {
            const double nu = points.wavenumber[k] * 1000;
            for (std::size_t c = 0; c < 3; ++c)
                exact[c] += points.weight[c][k] * groove_power(2 * deep, nu) *
                            slit_integral(kTwoPi * at * nu) / kPi;
        }
        check_near(t[1], exact, 1e-12);
        for (std::size_t c = 0; c < 3; ++c) {
            CHECK(t[3][c] == -t[1][c]);
            CHECK(std::abs((t[2][c] - t[0][c]) / (2 * step) - slope[c]) < 1e-5);
            const Complex back =
                2.0 * q[0][c] - 2.0 * std::polar(1.0, 4 * kPi * deep / carrier[c]) * q[1][c];
            CHECK(std::abs(back.real() - t[1][c]) < 1e-12);
        }
    }
    CHECK_THROWS_AS(SlitColors(noon(), 1001, 1), DomainError);
    CHECK_THROWS_AS(SlitColors(noon(), 1, -1), DomainError);
}

TEST_CASE("point lights: nodes, the transform and exact integrals give one colour", "[scratch]") {
    const PointColors colors(noon());
    const VisibleScratch seen(worked_scratch(), kVertical, SurfacePoint{});
    const ScratchPair pair =
        pair_of(seen, DepthPhase::vertical, direction_of(19.704, 206.496), direction_of(20, 40));
    Triple xyz = colors({2, pair.xi2, pair.path_um, 60 * std::abs(pair.xi1)});
    for (double& value : xyz) value *= seen.weight();
    check_near(xyz, {65.42336721553863, 72.4667544571869, 87.2064058408174}, 87e-11);
    Random random(32);
    const SensitivityPoints points = sensitivity_points(noon(), 4e5);
    for (int i = 0; i < 60; ++i) {
        PointLobe lobe{random.uniform(0.5, 8), random.uniform(-1.9, 1.9), random.uniform(0, 6),
                       i % 2 ? random.log_uniform(1e-3, 2) : 0};
        if (i % 10 == 0) lobe.width_um = 90;
        Triple exact{};
        for (std::size_t k = 0; k < points.wavenumber.size(); ++k) {
            const double nu = points.wavenumber[k] * 1000, y = kTwoPi * lobe.blur_um * nu;
            const double f = 2 * lobe.width_um * lobe.width_um * nu * nu *
                             slit_power(lobe.width_um, lobe.xi2, nu) *
                             groove_power(lobe.path_um, nu) * std::exp(-y * y);
            for (std::size_t c = 0; c < 3; ++c) exact[c] += points.weight[c][k] * f;
        }
        const double rounding = 1e-12 / (lobe.xi2 * lobe.xi2);
        check_near(colors(lobe), exact, rounding + 1e-12 * exact[1]);
        if (lobe.blur_um == 0) check_near(colors.by_transform(lobe), exact, rounding);
    }
    CHECK_THROWS_AS(colors.by_transform({1, 0, 1}), DomainError);
    CHECK_THROWS_AS(colors.by_transform({1, 1, 1, 1}), DomainError);
}

TEST_CASE("few nodes are as exact as stated", "[scratch]") {
    Random random(33);
    const std::array depth{0.0, 0.5, 1.0};
    std::vector<double> u;
    for (int i = 0; i < 60; ++i) u.push_back(random.uniform(0, 3));  // paths up to 5 um
    const std::vector<Triple> exact = SlitColors(noon(), 3, 1).power(u, depth);
    const auto worst = [&](const SpectralNodes& nodes) {
        const std::vector<Triple> rough = SlitColors(nodes).power(u, depth);
        double largest = 0;
        for (std::size_t i = 0; i < exact.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c)
                largest = std::max(largest, std::abs(rough[i][c] - exact[i][c]));
        return largest;
    };
    CHECK(worst(one_panel_nodes(noon(), 33)) < 1e-5);
    CHECK(worst(one_panel_nodes(noon(), 49)) < 1e-8);
    CHECK(worst(one_panel_nodes(noon(), 65)) < 1e-10);
    const double equal = worst(equal_nodes(noon(), 64));
    CHECK(equal > 1e-4);
    CHECK(equal < 2e-2);
}

// The fit of VWH18 eq. 29: its largest error, its slope at 0, its tail, and the share of x where it
// decreases.
TEST_CASE("the published fit of the sine integral is what it is", "[scratch]") {
    double largest = 0, falls = 0;
    constexpr double kStep = 1e-3;
    for (double x = kStep; x < 200; x += kStep) {
        largest = std::max(largest, std::abs(published_slit_integral(x) - slit_integral(x)));
        if (x > 10)
            falls += published_slit_integral(x + kStep) < published_slit_integral(x) ? kStep : 0;
    }
    CHECK(std::abs(largest - 0.051) < 5e-4);
    CHECK(std::abs(falls / 190 - 0.24) < 0.01);
    const double tail = (kPi / 2 - published_slit_integral(1e5)) * 1e5;
    CHECK(std::abs(tail - 0.661) < 1e-3);
    CHECK(std::abs(published_slit_integral(1e-5) / 0.5e-5 - 0.988) < 1e-3);
    CHECK(published_slit_integral(-2) == -published_slit_integral(2));
}
