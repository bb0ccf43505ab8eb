#include "core/rough/transmissivity.hpp"

#include <algorithm>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/coherent/coherent.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/rough/filter.hpp"
#include "core/rough/ggx.hpp"
#include "schemas/documents/stack_document.hpp"

using namespace irido;
using namespace irido::schemas;
using Catch::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

Stack stack_of(const std::string& text) {
    return read_stack({text, {}}).stack;
}

double T_of(const Stack& stack, double theta_deg, double wavelength_nm) {
    const StackPower power(stack);
    const IndexTable table(stack, {wavelength_nm});
    const double cosine = cos_of_incidence(theta_deg);
    const Spectra out = spectra(power, table, {&cosine, 1}, Needs{});
    return 0.5 * (out.s.T[0] + out.p.T[0]);
}

/// The integral over theta_d by tanh-sinh between `cuts`, which are the kink and points around the
/// peak.
///   stack          the stack of the facets
///   alpha          roughness
///   theta_i        angle of incidence, degrees
///   wavelength_nm  vacuum wavelength, nm
///   cuts           ends of panels
double by_tanh_sinh(const Stack& stack, double alpha, double theta_i, double wavelength_nm,
                    std::vector<double> cuts) {
    const TransmissionFilter filter(alpha);
    for (double width = alpha / kDegree; width < 90; width *= 3)
        for (const double at : {theta_i - width, theta_i + width}) cuts.push_back(at);
    for (const double at : {0.0, 90.0, theta_i, 90 - theta_i}) cuts.push_back(at);
    std::erase_if(cuts, [](double at) { return at < 0 || at > 90; });
    std::ranges::sort(cuts);
    boost::math::quadrature::tanh_sinh<double> rule;
    double sum = 0;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        const double begin = cuts[i], end = cuts[i + 1];
        if (end - begin < 1e-9) continue;
        sum += rule.integrate(
                   [&](double x) {
                       const double theta = 0.5 * ((begin + end) + (end - begin) * x);
                       return filter(theta_i, theta) * T_of(stack, theta, wavelength_nm);
                   },
                   1e-11) *
               0.5 * (end - begin);
    }
    return sum * kDegree;
}

const std::vector<double> kGreen{550};

}  // namespace

TEST_CASE("where nothing reflects the integrated transmissivity is the masking function",
          "[rough]") {
    const RoughTransmissivity empty(stack_of("1.5 | 1.5@300 | 1.5"), Light::unpolarized);
    const std::vector<double> theta{0, 0.25, 30, 45, 80, 89.75, 89.9999};
    for (const double alpha : {1e-4, 0.01, 0.1, 0.5, 1.0}) {
        const auto values = empty(alpha, theta, kGreen);
        for (std::size_t i = 0; i < theta.size(); ++i)
            CHECK_THAT(values[i].value,
                       WithinRel(smith_masking(alpha, cos_of_incidence(theta[i])), 1e-11));
    }
    CHECK(empty(0.1, std::vector<double>{90}, kGreen)[0].value == 0);
}

TEST_CASE("integrated transmissivities are those of tanh-sinh, within their stated errors",
          "[rough]") {
    const double critical = std::asin(1 / 1.52) * 180 / std::numbers::pi;
    const std::vector<std::pair<std::string, std::vector<double>>> stacks{
        {"1 | (1@250 | 1.5@250)^10 | 1", {}},
        {"1 | 1.33@380 | 1", {}},
        {"1.52 | 1.38@100 | 1", {critical}},
        {"1 | 0.2+3.4i@20 | 1.5", {}},
    };
    for (const auto& [text, cuts] : stacks) {
        const Stack stack = stack_of(text);
        const RoughTransmissivity layer(stack, Light::unpolarized);
        for (const double alpha : {0.02, 0.4})
            for (const double theta_i : {0.0, 35.0, 80.0}) {
                const auto [value, error] = layer(alpha, std::vector<double>{theta_i}, kGreen)[0];
                const double G1 = smith_masking(alpha, cos_of_incidence(theta_i));
                CAPTURE(text, alpha, theta_i);
                CHECK(error < 1e-9);
                // tanh-sinh itself is accurate to 1e-10 here
                CHECK_THAT(value, WithinAbs(by_tanh_sinh(stack, alpha, theta_i, 550, cuts),
                                            (error + 1e-9) * G1));
            }
    }
}

TEST_CASE("a nearly smooth layer transmits as the stack does", "[rough]") {
    const Stack stack = stack_of("1 | (1@250 | 1.5@250)^4 | 1");
    const RoughTransmissivity layer(stack, Light::unpolarized);
    for (const double theta : {5.0, 40.0, 70.0})
        CHECK_THAT(layer(1e-4, std::vector<double>{theta}, kGreen)[0].value,
                   WithinAbs(T_of(stack, theta, 550), 1e-5));  // T varies within alpha
}

TEST_CASE("unpolarized light transmits as the mean of s and p", "[rough]") {
    const Stack stack = stack_of("1 | (TiO2@58.5 | SiO2@94.2)^3 | BK7");
    const std::vector<double> theta{0, 50, 85}, wavelengths{450, 550};
    const auto of = [&](Light light) {
        return RoughTransmissivity(stack, light)(0.2, theta, wavelengths);
    };
    const auto s = of(Light::s), p = of(Light::p), u = of(Light::unpolarized);
    for (std::size_t i = 0; i < u.size(); ++i)
        CHECK_THAT(u[i].value, WithinAbs(0.5 * (s[i].value + p[i].value), 1e-9));
    CHECK(p[2].value > s[2].value);
}

TEST_CASE("an integrated transmissivity depends on its own arguments only", "[rough]") {
    const Stack stack = stack_of("1 | (TiO2@58.5 | SiO2@94.2)^5 | BK7");
    const RoughTransmissivity together(stack, Light::unpolarized);
    const std::vector<double> theta{10, 20, 60}, wavelengths{430, 550, 551, 700};
    together.prepare(wavelengths, 2);
    const auto all = together(0.1, theta, wavelengths);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const RoughTransmissivity alone(stack, Light::unpolarized);
        const auto one = alone(0.1, std::vector<double>{theta[i / 4]},
                               std::vector<double>{wavelengths[i % 4]})[0];
        CHECK(one.value == all[i].value);
        CHECK(one.error == all[i].error);
    }
}

TEST_CASE("a layer with many fringes states what it cannot follow", "[rough]") {
    const std::vector<double> theta{30};
    const RoughTransmissivity thick(stack_of("1 | 2.4@200000 | 1"), Light::unpolarized);
    CHECK(thick(0.1, theta, kGreen)[0].error < 1e-9);
    const RoughTransmissivity endless(stack_of("1 | 2.4@1e8 | 1"), Light::unpolarized);
    CHECK(endless(0.1, theta, kGreen)[0].error > 1e-3);
}

TEST_CASE("integrated transmissivities refuse what is outside their domain", "[rough][refused]") {
    const RoughTransmissivity layer(stack_of("1 | 1.33@380 | 1"), Light::unpolarized);
    const std::vector<double> theta{30}, beyond{91}, nowhere{std::nan("")};
    CHECK_THROWS_WITH(layer(0, theta, kGreen), Contains("alpha must be"));
    CHECK_THROWS_WITH(layer(0.1, beyond, kGreen), Contains("theta_i_deg must be in [0, 90]"));
    CHECK_THROWS_WITH(layer(0.1, theta, nowhere), Contains("wavelength_nm must be"));
    CHECK_THROWS_AS(layer.prepare(nowhere, 1), DomainError);
}
