#include "core/rough/layered/refracted_light.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/random.hpp"
#include "core/rough/ggx.hpp"
#include "core/rough/layered/refraction_lobe.hpp"
#include "core/stack/builder.hpp"

using namespace irido;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

Stack film_over(Complex base) {
    StackBuilder builder{Complex(1)};
    builder.add(builder.layer(Complex(1.33), 400));
    return builder.over(base);
}

/// Cosine with the lower normal of light that a facet refracts; below 0 where it goes nowhere down.
double refracted_cosine(double n_i, double n_o, double cos_i, double tilt_cos, double facet_cos) {
    const double ratio = n_i / n_o;
    const double inside = 1 - ratio * ratio * (1 - facet_cos * facet_cos);
    if (inside <= 0) return -1;
    return ratio * cos_i - (ratio * facet_cos - std::sqrt(inside)) * tilt_cos;
}

}  // namespace

// Light through facets that let all of it through: a sum over facets, which knows no half-vector.
TEST_CASE("refracted lobes hold the light that their facets refract", "[rough][layered]") {
    constexpr int kPolar = 400, kAzimuths = 200;
    constexpr double kAlpha = 0.4;
    for (const double n_o : {1.5, 0.8})
        for (const double theta : {10.0, 70.0}) {
            double lobe = 0, facets = 0;
            const double ci = std::cos(theta * kDegree), si = std::sin(theta * kDegree);
            for (int i = 0; i < kPolar; ++i) {
                const double c = (i + 0.5) / kPolar, s = std::sqrt(1 - c * c);
                for (int j = 0; j < kAzimuths; ++j) {
                    const double phi = 180 * (j + 0.5) / kAzimuths;
                    const double area = 2 * kPi / kPolar / kAzimuths;
                    const double theta_o = std::acos(c) / kDegree;
                    lobe += area * c *
                            refraction_lobe(kAlpha, n_o, theta, theta_o,
                                            refracting_facet(1, n_o, theta, theta_o, phi));
                    const double facing = ci * c + si * s * std::cos(phi * kDegree);
                    if (facing <= 0) continue;
                    const double co = refracted_cosine(1, n_o, ci, c, facing);
                    if (co <= 0) continue;
                    facets += area * ggx_distribution(kAlpha, c) * facing / ci *
                              smith_masking(kAlpha, ci) * smith_masking(kAlpha, std::min(1.0, co));
                }
            }
            INFO(n_o << ", " << theta);
            CHECK_THAT(lobe, WithinRel(facets, 2e-3));
        }
}

TEST_CASE("light is refracted both ways alike but for the indices", "[rough][layered]") {
    Random random(5);
    int there = 0;
    for (int k = 0; k < 200; ++k) {
        const double n_i = random.uniform(1, 2), n_o = random.uniform(1, 2);
        const double a = random.uniform(0, 89), b = random.uniform(0, 89);
        const double phi = random.uniform(0, 180), alpha = random.uniform(0.01, 1);
        const RefractingFacet down = refracting_facet(n_i, n_o, a, b, phi);
        const RefractingFacet up = refracting_facet(n_o, n_i, b, a, phi);
        CHECK(down.is_there == up.is_there);
        const double f = refraction_lobe(alpha, n_o, a, b, down);
        CHECK_THAT(f * n_i * n_i,
                   WithinRel(n_o * n_o * refraction_lobe(alpha, n_i, b, a, up), 1e-11));
        if (!down.is_there) continue;
        ++there;
        // Snell's law at the facet
        CHECK_THAT(n_i * std::sin(down.theta_deg * kDegree),
                   WithinAbs(n_o * std::sin(up.theta_deg * kDegree), 1e-7));
    }
    CHECK(there > 20);
}

TEST_CASE("what rough films transmit, in colour", "[rough][layered]") {
    const ColorTables tables(Sensitivity(observer(2), illuminant("D65")));
    const RefractedLight light(film_over(1.5), 0.2, Execution(1));
    const std::vector<ScatterPair> pairs{{30, 15, 180}, {30, 40, 120}, {80, 35, 180}};
    const SampleRule rule = equal_rule(tables.sensitivity(), 2000);
    std::vector<double> f = light.btdf(pairs, rule.wavelength_nm);
    for (double& value : f) value *= kPi;
    const std::vector<Triple> summed = sampled_colors(tables.sensitivity(), rule, f);
    const auto by = [&](std::string_view method) {
        return light.color(tables, pairs, color_method(method), 1e-6);
    };
    const auto exact = by("auto"), series = by("fourier");
    const auto gaussian = by("gaussian");
    for (std::size_t p = 0; p < pairs.size(); ++p)
        for (std::size_t c = 0; c < 3; ++c) {
            const double scale = std::max(1.0, summed[p][c]);
            CHECK_THAT(exact[p].xyz[c], WithinAbs(summed[p][c], 2e-5 * scale));
            CHECK_THAT(series[p].xyz[c], WithinAbs(summed[p][c], 2e-5 * scale));
            CHECK_THAT(gaussian[p].xyz[c], WithinAbs(summed[p][c], 2e-2 * scale));
        }
    CHECK_THROWS_AS(RefractedLight(film_over({1.9, 1.5}), 0.2, Execution(1)).btdf(pairs, {550}),
                    DomainError);
    CHECK_THROWS_AS(RefractedLight(film_over(1), 0.2, Execution(1)).btdf(pairs, {550}),
                    DomainError);
    CHECK_THROWS_AS(RefractedLight(film_over(1.5), 0, Execution(1)), DomainError);
}
