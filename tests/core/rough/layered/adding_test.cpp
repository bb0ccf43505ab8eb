#include "core/rough/layered/adding.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/sample_surfaces.hpp"

using namespace irido;
using namespace irido::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

struct AllPaths {
    std::vector<double> values;
    double error;
};

AllPaths brdf_of(const LayeredScattering& scattering, const std::vector<ScatterPair>& pairs,
                 const std::vector<double>& nm, double tolerance) {
    std::vector<double> f = scattering.brdf(pairs, nm, Paths::single);
    const Adding::Values rest = Adding(scattering, tolerance, Execution(0)).brdf_rest(pairs, nm);
    for (std::size_t k = 0; k < f.size(); ++k) f[k] += rest.values[k];
    return {f, rest.error};
}

AllPaths albedo_of(const LayeredScattering& scattering, const std::vector<double>& theta,
                   const std::vector<double>& nm, double tolerance) {
    std::vector<double> a = scattering.albedo(theta, nm, Paths::single);
    const Adding::Values rest = Adding(scattering, tolerance, Execution(0)).albedo_rest(theta, nm);
    for (std::size_t k = 0; k < a.size(); ++k) a[k] += rest.values[k];
    return {a, rest.error};
}

}  // namespace

TEST_CASE("adding meets the closed form of one layer over a base", "[rough][layered]") {
    Random random(21);
    for (int i = 0; i < 6; ++i) {
        LayeredSurface surface = random_surface(random, 1);
        surface.outside = surface.inside;
        const LayeredScattering scattering(surface, Crossings::single, Execution(0));
        REQUIRE(scattering.is_closed());
        const std::vector<ScatterPair> pairs{{20, 50, 120}, {0, 0, 0}, {80, 70, 180}};
        const std::vector<double> nm{450, 600}, theta{10, 75};
        const AllPaths f = brdf_of(scattering, pairs, nm, 1e-4);
        CHECK(f.error <= 1e-4);
        const std::vector<double> expected = scattering.brdf(pairs, nm, Paths::all);
        for (std::size_t k = 0; k < expected.size(); ++k)
            CHECK_THAT(f.values[k], WithinRel(expected[k], 1e-4));
        const AllPaths a = albedo_of(scattering, theta, nm, 1e-4);
        const std::vector<double> albedo = scattering.albedo(theta, nm, Paths::all);
        for (std::size_t k = 0; k < albedo.size(); ++k)
            CHECK_THAT(a.values[k], WithinRel(albedo[k], 1e-4));
    }
}

// A Monte-Carlo simulation of 600,000 paths that samples a facet at every crossing; beside each
// value one standard error.
TEST_CASE("adding meets a simulation of coated and of two layers", "[rough][layered][slow]") {
    const std::vector<double> nm{450, 550, 650}, theta{30};
    const std::vector<ScatterPair> pairs{{30, 30, 180}, {30, 30, 0}, {30, 60, 90}, {30, 70, 180}};
    const auto check = [&](const char* json, const std::vector<double>& f,
                           const std::vector<double>& f_error, const std::vector<double>& a,
                           const std::vector<double>& a_error) {
        const LayeredScattering scattering(surface_of(json), Crossings::single, Execution(0));
        const AllPaths got = brdf_of(scattering, pairs, nm, 1e-3);
        for (std::size_t k = 0; k < f.size(); ++k)
            CHECK_THAT(got.values[k], WithinAbs(f[k], 3 * f_error[k] + 1e-3 * f[k]));
        const AllPaths albedo = albedo_of(scattering, theta, nm, 1e-3);
        for (std::size_t k = 0; k < a.size(); ++k)
            CHECK_THAT(albedo.values[k], WithinAbs(a[k], 3 * a_error[k]));
    };
    check(R"({"inside": 1.35, "layers": [{"stack": "1.35 | (1.35@250 | 1.5@250)^10 | 1.35",
              "alpha": 0.1}], "base": {"albedo": 0.5}})",
          {2.44904039041, 0.125879081335, 0.250895413458, 0.0611311185193, 0.106833061219,
           0.103229340243, 0.085917337909, 0.0999492865157, 0.101141574323, 0.0725121038537,
           0.0925785322387, 0.0921447451144},
          {0.00023578, 6.75884e-05, 6.90143e-05, 5.32078e-05, 6.75833e-05, 6.90315e-05, 6.53325e-05,
           6.42814e-05, 6.7151e-05, 6.09863e-05, 5.84917e-05, 6.1833e-05},
          {0.5020995024424983, 0.34405618002649835, 0.35499436368149834},
          {0.000965362, 0.000321039, 0.000321799});
    check(R"({"layers": [{"stack": "1 | (1@125 | 1.5@375)^20 | 1", "alpha": 0.1},
              {"stack": "1 | (1@101 | 1.5@143)^20 | 1", "alpha": 0.1}], "base": {"albedo": 0.2}})",
          {4.95633123942, 9.99388185758, 10.656057021, 0.0334724985357, 0.00353279617653,
           0.0150891142016, 0.0177481323098, 0.0123152023496, 0.0197263059216, 0.0484852117824,
           0.181925347619, 0.0624086645193},
          {0.000147974, 0.0136855, 0.000294082, 4.89208e-05, 7.26711e-05, 8.12409e-05, 0.000102075,
           0.000241122, 0.000104799, 0.000692434, 0.00123013, 0.000166096},
          {0.54324310236, 0.883297861298, 0.944530733537}, {0.000739824, 0.00175003, 0.00129672});
}

TEST_CASE("all paths are reciprocal and keep energy", "[rough][layered][slow]") {
    Random random(23);
    for (int i = 0; i < 5; ++i) {
        LayeredSurface surface = random_surface(random, 2);
        surface.base_albedo = Constant{1};
        const LayeredScattering scattering(surface, Crossings::single, Execution(0));
        const AllPaths f = brdf_of(scattering, {{20, 60, 100}, {60, 20, 100}}, {500}, 1e-3);
        CHECK_THAT(f.values[0], WithinRel(f.values[1], 1e-10));
        for (const double a : albedo_of(scattering, {0, 50, 85}, {500}, 1e-3).values)
            CHECK(a <= 1.001);
    }
    // nothing is lost between a coating and a white base
    const LayeredScattering white(surface_of(R"({"inside": 1.5, "base": {"albedo": 1},
        "layers": [{"stack": "1.5 | 1.5", "alpha": 1e-3}]})"),
                                  Crossings::multiple, Execution(0));
    const Adding adding(white, 1e-3, Execution(0));
    const std::vector<double> theta{30};
    CHECK_THAT(
        white.albedo(theta, {500}, Paths::single)[0] + adding.albedo_rest(theta, {500}).values[0],
        WithinAbs(1, 2e-3));
}

TEST_CASE("levels of adding approach each other", "[rough][layered]") {
    const LayeredScattering scattering(
        surface_of(R"({"inside": 1.35, "layers": [{"stack": "1.35 | 1.7@150 | 1.35",
            "alpha": 0.2}], "base": {"albedo": 0.5}})"),
        Crossings::single, Execution(0));
    const std::vector<ScatterPair> pairs{{45, 45, 180}, {45, 70, 90}, {10, 80, 0}};
    const Adding adding(scattering, 1e-3, Execution(0));
    const std::vector<double> coarse = adding.brdf_rest(pairs, {550}, 0);
    const std::vector<double> middle = adding.brdf_rest(pairs, {550}, 1);
    const std::vector<double> fine = adding.brdf_rest(pairs, {550}, 3);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        CHECK_THAT(coarse[p], WithinRel(fine[p], 1e-2));
        CHECK_THAT(middle[p], WithinRel(fine[p], 1e-3));
    }
    CHECK(adding.level_of(pairs, {550}).level <= 1);
    CHECK(adding.level_of(pairs, {550}).error <= 1e-3);
}
