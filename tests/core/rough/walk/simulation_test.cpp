#include "core/rough/walk/simulation.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>

#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/math/constants.hpp"
#include "core/rough/layered/adding.hpp"
#include "core/rough/layered/layered_color.hpp"
#include "tests/support/sample_surfaces.hpp"

using namespace irido;
using namespace irido::test;

namespace {

const std::vector<double> kNm{450, 550, 650};

/// The largest deviation of simulated values from expected ones, in standard errors, after allowing
/// for a `relative` error.
double distance(const LayeredSimulation::Values& got, const std::vector<double>& expected,
                double relative) {
    double largest = 0;
    for (std::size_t k = 0; k < expected.size(); ++k) {
        const double off = std::abs(got.mean[k] - expected[k]) - relative * std::abs(expected[k]);
        largest = std::max(largest, off / (got.error[k] + 1e-14));
    }
    return largest;
}

std::vector<double> sum_of(std::vector<double> once, const std::vector<double>& rest) {
    for (std::size_t k = 0; k < once.size(); ++k) once[k] += rest[k];
    return once;
}

}  // namespace

// The simulation shares nothing with the filter, with adding or with the integrals over facets.
TEST_CASE("simulations of random surfaces meet the formulas", "[rough][simulation][slow]") {
    // IRIDO_TEST_STRUCTURES: how many
    const char* const many = std::getenv("IRIDO_TEST_STRUCTURES");
    const int count = many ? std::atoi(many) : 24;
    Random random(31);
    for (int i = 0; i < count; ++i) {
        const LayeredScattering scattering(random_surface(random, 3), Crossings::single,
                                           Execution(0));
        const double theta = random.uniform(0, 80);
        const std::vector<ScatterPair> pairs{
            {theta, theta, 180}, {theta, random.uniform(0, 80), random.uniform(0, 180)}};
        const std::vector<double> angles{theta};
        SimulationRequest request;
        request.samples = 20000;
        request.seed = static_cast<std::uint64_t>(i);
        request.facets = i % 2 == 0 ? FacetChoice::sampled : FacetChoice::filter;
        request.paths = i % 4 < 2 ? Paths::all : Paths::single;
        std::vector<double> f = scattering.brdf(pairs, kNm, Paths::single);
        std::vector<double> a = scattering.albedo(angles, kNm, Paths::single);
        if (request.paths == Paths::all) {
            const Adding adding(scattering, 1e-3, Execution(0));
            f = sum_of(f, adding.brdf_rest(pairs, kNm).values);
            a = sum_of(a, adding.albedo_rest(angles, kNm).values);
        }
        const LayeredSimulation simulation(scattering, request, kNm, Execution(0));
        INFO(i);
        CHECK(distance(simulation.brdf(pairs), f, 1e-3) < 3.5);
        CHECK(distance(simulation.albedo(angles), a, 1e-3) < 3.5);
    }
}

TEST_CASE("a simulation does not depend on the threads or on other lights", "[rough][simulation]") {
    const LayeredScattering scattering(
        surface_of(R"({"layers": [{"stack": "1 | 2@100 | 1", "alpha": 0.3}],
                       "base": {"albedo": 0.5}})"),
        Crossings::single, Execution(1));
    SimulationRequest request;
    request.samples = 1000;
    const std::vector<ScatterPair> pairs{{10, 20, 30}, {40, 50, 60}};
    const LayeredSimulation::Values one =
        LayeredSimulation(scattering, request, kNm, Execution(1)).brdf(pairs);
    const LayeredSimulation::Values three =
        LayeredSimulation(scattering, request, kNm, Execution(3)).brdf(pairs);
    CHECK(one.mean == three.mean);
    CHECK(one.error == three.error);
    const LayeredSimulation::Values first =
        LayeredSimulation(scattering, request, kNm, Execution(1)).brdf({pairs.data(), 1});
    for (std::size_t w = 0; w < kNm.size(); ++w) CHECK(first.mean[w] == one.mean[w]);
    request.seed = 2;
    CHECK(LayeredSimulation(scattering, request, kNm, Execution(1)).brdf(pairs).mean != one.mean);
}

TEST_CASE("opaque layers and bare bases are simulated", "[rough][simulation]") {
    SimulationRequest request;
    request.samples = 20000;
    const std::vector<double> theta{40};
    for (const char* json :
         {R"({"layers": [{"stack": "1 | 1.5@200 | 0.2+3i", "alpha": 0.4}]})",
          R"({"base": {"albedo": 0.7}})", R"({"inside": 1.5, "base": {"albedo": 0.7}})"}) {
        const LayeredScattering scattering(surface_of(json), Crossings::single, Execution(1));
        const LayeredSimulation simulation(scattering, request, kNm, Execution(1));
        const bool is_closed = scattering.is_closed();
        REQUIRE(is_closed);
        CHECK(distance(simulation.albedo(theta), scattering.albedo(theta, kNm, Paths::all), 1e-4) <
              3.5);
    }
}

TEST_CASE("parts of a simulation add up to the whole", "[rough][simulation]") {
    const LayeredScattering scattering(
        surface_of(R"({"layers": [{"stack": "1 | 2@100 | 1", "alpha": 0.3}],
                       "base": {"albedo": 0.5}})"),
        Crossings::single, Execution(1));
    SimulationRequest request;
    request.samples = 3000;
    LayeredSimulation simulation(scattering, request, kNm, Execution(1));
    const std::vector<ScatterPair> pairs{{10, 20, 30}};
    const LayeredSimulation::Values whole = simulation.brdf(pairs);
    simulation.set_paths(0, 1000);
    LayeredSimulation::Values sum = simulation.brdf(pairs);
    simulation.set_paths(1000, 2000);
    sum.add(simulation.brdf(pairs));
    for (std::size_t k = 0; k < whole.mean.size(); ++k) {
        CHECK(std::abs(sum.mean[k] - whole.mean[k]) <= 1e-13 * whole.mean[k]);
        CHECK(std::abs(sum.error[k] - whole.error[k]) <= 2e-2 * whole.error[k]);
    }
}

TEST_CASE("colours are simulated", "[rough][simulation]") {
    const LayeredSurface surface = surface_of(
        R"({"layers": [{"stack": "1 | (1@250 | 1.5@250)^4 | 1", "alpha": 0.2}],
            "base": {"albedo": 0.5}})");
    const ColorTables tables(Sensitivity(observer(2), illuminant("D65")));
    const std::vector<ScatterPair> pairs{{30, 30, 180}, {30, 60, 90}};
    const auto exact = LayeredColor(tables, surface, Crossings::single, 1e-4, Execution(0))
                           .brdf(pairs, Paths::all);
    const SampleRule rule = equal_rule(tables.sensitivity(), 119);
    LayeredSimulation::ColorWeights weights = rule.weight;
    for (std::size_t c = 0; c < 3; ++c) {
        double light = 0;
        for (const double weight : weights[c]) light += weight;
        for (double& weight : weights[c]) weight *= tables.sensitivity().white()[c] / light;
    }
    SimulationRequest request;
    request.samples = 10000;
    const LayeredScattering scattering(surface, Crossings::single, Execution(0));
    LayeredSimulation simulation(scattering, request, rule.wavelength_nm, Execution(0));
    simulation.set_colors(weights);
    const LayeredSimulation::Values got = simulation.brdf(pairs);
    REQUIRE(got.mean.size() == 6);
    std::vector<double> expected;
    for (const SurfaceColor& color : exact)
        for (const double part : color.xyz) expected.push_back(part / kPi);
    CHECK(distance(got, expected, 1e-3) < 3.5);
}
