#include "core/rough/albedo.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/color/stack_color.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/gauss.hpp"
#include "core/math/random.hpp"
#include "core/rough/ggx.hpp"
#include "schemas/documents/stack_document.hpp"

using namespace irido;
using namespace irido::schemas;
using Catch::Contains;
using Catch::Matchers::WithinAbs;

namespace {

/// The albedo of perfectly reflecting facets, by AlbedoNodes.
double mirror(double alpha, double theta_i_deg, double tolerance = 0) {
    double sum = 0;
    for (const double weight : AlbedoNodes(alpha, theta_i_deg, tolerance)(0, 90).weight)
        sum += weight;
    return sum;
}

/// The albedo by definition: over all directions o, by Gauss panels that concentrate towards
/// grazing, theta_o = pi/2 (1 - (1 - v)^2), and towards the plane of incidence, phi_o = pi u^3.
/// `reflectance` is a function of the half angle in degrees.
template <class Reflectance>
double over_directions(double alpha, double theta_i_deg, int panels,
                       const Reflectance& reflectance) {
    const double ci = std::cos(theta_i_deg * kDegree), si = std::sin(theta_i_deg * kDegree);
    double sum = 0;
    for (int row = 0; row < panels; ++row)
        for (int column = 0; column < panels; ++column)
            for (const GaussNode& a : gauss_legendre<8>())
                for (const GaussNode& b : gauss_legendre<8>()) {
                    const double v = (row + 0.5 + 0.5 * a.x) / panels;
                    const double u = (column + 0.5 + 0.5 * b.x) / panels;
                    const double beside = kPi / 2 * (1 - v) * (1 - v);
                    const double co = std::sin(beside), so = std::cos(beside);
                    const double io = ci * co - si * so * std::cos(kPi * u * u * u);
                    const double c_half = std::sqrt(0.5 * (1 + io));
                    const double x = std::min(1.0, (ci + co) / (2 * c_half));
                    const double brdf = ggx_distribution(alpha, x) *
                                        smith_masking_shadowing(alpha, ci, co) / (4 * ci * co) *
                                        reflectance(std::acos(c_half) / kDegree);
                    sum += a.weight * b.weight * brdf * co * so * kPi * (1 - v) * 3 * kPi * u * u;
                }
    // both halves of phi; the weights of each sum to 2
    return 2 * sum / (4 * panels * panels);
}

struct Light2 {
    Sensitivity sensitivity{observer(2), illuminant("D65")};
    ColorTables tables{sensitivity};
};

const Light2& light() {
    static const Light2 one;
    return one;
}

Stack stack_of(const std::string& text) {
    return read_stack({text, {}}).stack;
}

}  // namespace

TEST_CASE("the albedo of a mirror's facets is the integral over all directions", "[rough]") {
    for (const double alpha : {0.1, 0.3, 1.0})
        for (const double theta : {0.0, 30.0, 60.0, 80.0, 89.0})
            CHECK_THAT(mirror(alpha, theta),
                       WithinAbs(over_directions(alpha, theta, 24, [](double) { return 1; }),
                                 alpha < 0.2 && theta > 85 ? 1e-6 : 1e-10));
}

TEST_CASE("the albedo of a mirror's facets has its limits", "[rough]") {
    // alpha 1: D = 1/pi and G2 = 2 c_o/(1 + c_o), so E = 2 integral_0^1 u/(1 + u)/2 du
    CHECK_THAT(mirror(1, 0), WithinAbs(1 - std::log(2.0), 1e-12));
    for (const double alpha : {1e-4, 0.01, 0.1, 1.0})
        CHECK_THAT(mirror(alpha, 90), WithinAbs(1, 1e-11));
    for (const double theta : {0.0, 50.0, 85.0})
        CHECK_THAT(mirror(1e-4, theta), WithinAbs(1, 1e-5));
}

TEST_CASE("no surface reflects more than all light", "[rough]") {
    for (const double alpha : {1e-4, 1e-3, 0.02, 0.1, 0.5, 1.0})
        for (const double theta : {0.0, 1e-6, 20.0, 45.0, 70.0, 85.0, 89.0, 89.9, 89.9999, 90.0}) {
            const double E = mirror(alpha, theta);
            CAPTURE(alpha, theta);
            CHECK(E > 0);
            CHECK(E <= 1 + 1e-11);
            // panels cut differently give the same
            const AlbedoNodes nodes(alpha, theta);
            double parts = 0;
            for (const auto& [begin, end] :
                 {std::pair{0.0, 13.0}, {13.0, 44.4}, {44.4, 71.0}, {71.0, 90.0}})
                for (const double weight : nodes(begin, end).weight) parts += weight;
            CHECK_THAT(parts, WithinAbs(E, 1e-12));
        }
}

TEST_CASE("a perfect mirror's rough colour is its albedo times the white", "[rough]") {
    // an index so high that everything is reflected
    const RoughAlbedo albedo(light().tables, stack_of("1 | 1e-6+1e4i"), {}, 1);
    const Triple white = light().sensitivity.white();
    for (const double alpha : {0.05, 0.4, 1.0}) {
        const auto [xyz, error] = albedo(alpha, std::vector<double>{0.5})[0];
        for (std::size_t c = 0; c < 3; ++c)
            CHECK_THAT(xyz[c], WithinAbs(white[c] * mirror(alpha, 60), error + 1e-9));
    }
}

TEST_CASE("a smooth surface has the stack's colour, a rough one that of all directions",
          "[rough]") {
    const Stack stack = stack_of("1 | 1.33@380 | 1.5+3i");
    const RoughAlbedo albedo(light().tables, stack, {}, 1);
    const auto color = [&](double theta_deg) {
        return stack_color(light().tables, stack, {}, {}, {&theta_deg, 1})[0].xyz;
    };
    for (const double theta : {0.0, 35.0, 60.0, 87.0}) {
        const std::vector<double> cosine{std::cos(theta * kDegree)};
        const Triple smooth = color(theta);
        const auto zero = albedo(0, cosine)[0], tiny = albedo(1e-4, cosine)[0];
        CHECK(zero.error < 5e-6);
        for (std::size_t c = 0; c < 3; ++c) {
            CHECK_THAT(zero.xyz[c], WithinAbs(smooth[c], zero.error + 1e-6));
            CHECK_THAT(tiny.xyz[c], WithinAbs(smooth[c], 1e-4));  // alpha
        }
    }
    const double theta = 55;
    const auto rough = albedo(0.6, std::vector<double>{std::cos(theta * kDegree)})[0];
    for (std::size_t c = 0; c < 3; ++c)
        CHECK_THAT(
            rough.xyz[c],
            WithinAbs(over_directions(0.6, theta, 5, [&](double half) { return color(half)[c]; }),
                      2e-5));  // error of the Gauss panels
}

TEST_CASE("the error of an albedo falls with its tolerance", "[rough]") {
    const Stack stack = stack_of("1 | (TiO2@58.5 | SiO2@94.2)^5 | BK7");
    ColorRequest coarse, fine;
    coarse.tolerance = 1e-4;
    fine.tolerance = 1e-9;
    const std::vector<double> cosines{0.1, 0.7, 1};
    const auto a = RoughAlbedo(light().tables, stack, coarse, 1)(0.3, cosines);
    const auto b = RoughAlbedo(light().tables, stack, fine, 2)(0.3, cosines);
    for (std::size_t i = 0; i < cosines.size(); ++i) {
        CHECK(a[i].error < 3e-4);
        CHECK(b[i].error < 3e-9);
        for (std::size_t c = 0; c < 3; ++c)
            CHECK_THAT(a[i].xyz[c], WithinAbs(b[i].xyz[c], a[i].error));
    }
}

TEST_CASE("fewer nodes serve loose tolerances", "[rough]") {
    Random random(31);
    for (int i = 0; i < 500; ++i) {
        const double alpha = random.log_uniform(1e-4, 1);
        const double beside = random.log_uniform(1e-6, 90);
        const double theta = i % 2 == 0 ? beside : 90 - beside;
        CAPTURE(alpha, theta);
        CHECK_THAT(mirror(alpha, theta, 1e-6), WithinAbs(mirror(alpha, theta), 1e-7));
    }
}

TEST_CASE("albedos of narrow resonances have their error", "[rough][regression]") {
    const Stack stack = stack_of("1 | Ag@30 | 1.5@1500 | Ag@30 | 1.5");
    ColorRequest fine;
    fine.tolerance = 1e-10;
    const RoughAlbedo exact(light().tables, stack, fine, 1), albedo(light().tables, stack, {}, 1);
    Random random(32);
    for (int i = 0; i < 150; ++i) {
        const double alpha = i % 2 == 0 ? random.log_uniform(1e-4, 1) : random.uniform(0.05, 1);
        const std::vector<double> cosine{random.uniform(0, 1)};
        const auto found = albedo(alpha, cosine)[0], truth = exact(alpha, cosine)[0];
        CAPTURE(alpha, cosine, found.error);
        for (std::size_t c = 0; c < 3; ++c)
            CHECK_THAT(found.xyz[c], WithinAbs(truth.xyz[c], found.error + truth.error));
    }
}

TEST_CASE("albedos refuse what is outside their domain", "[rough][refused]") {
    CHECK_THROWS_WITH(AlbedoNodes(0, 10), Contains("alpha must be"));
    CHECK_THROWS_WITH(AlbedoNodes(0.1, 91), Contains("theta_i_deg must be"));
    const RoughAlbedo albedo(light().tables, stack_of("1 | 1.5"), {}, 1);
    const std::vector<double> normal{1}, beyond{1.1};
    CHECK_THROWS_WITH(albedo(1e-5, normal), Contains("alpha must be in [1e-04, 1]"));
    CHECK_THROWS_WITH(albedo(0.1, beyond), Contains("cos_theta_i must be in [0, 1]"));
    CHECK_THROWS_AS(albedo(std::nan(""), normal), DomainError);
}
