#include "core/rough/walk/simulation.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/rough/layered/adding.hpp"
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
    Random random(31);
    for (int i = 0; i < 24; ++i) {
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
