#include "core/rough/layered/layered_scattering.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/coherent/coherent.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/gauss.hpp"
#include "core/math/random.hpp"
#include "core/rough/ggx.hpp"
#include "core/rough/layered/layered_color.hpp"
#include "tests/support/sample_surfaces.hpp"

using namespace irido;
using namespace irido::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

LayeredScattering scattering_of(const std::string& json, Crossings crossings = Crossings::single) {
    return {surface_of(json), crossings, Execution(1)};
}

/// The albedo as the integral of a BRDF over the hemisphere outside, plus the coating's mirror
/// reflection.
///   scattering  the surface
///   theta_deg   angle of incidence, degrees
///   nm          wavelength
///   paths       which paths to include
double by_hemisphere(const LayeredScattering& scattering, double theta_deg, double nm,
                     Paths paths) {
    std::vector<ScatterPair> pairs;
    std::vector<double> weights;
    // theta in panels of the square root of the distance to grazing; phi in panels that meet at the
    // peak
    for (const double end : {1.0, 0.75, 0.5, 0.25})
        for (const GaussNode& v : gauss_legendre<20>()) {
            const double at = end - 0.25 + 0.125 * (1 + v.x);
            const double theta = 0.5 * kPi * (1 - at * at);
            for (int part = 0; part < 6; ++part)
                for (const GaussNode& p : gauss_legendre<16>()) {
                    const double phi = 30 * part + 15 * (1 + p.x);
                    pairs.push_back({theta_deg, std::clamp(theta / kDegree, 0.0, 90.0), phi});
                    weights.push_back(0.125 * v.weight * kPi * at * std::sin(theta) *
                                      std::cos(theta) * 2 * kDegree * 15 * p.weight);
                }
        }
    const std::vector<double> f = scattering.brdf(pairs, {nm}, paths);
    double sum = scattering.coating().inward(theta_deg).R;
    for (std::size_t k = 0; k < f.size(); ++k) sum += weights[k] * f[k];
    return sum;
}

const char* const kGreyBase = R"({"layers": [{"stack": "1 | (1@494 | 1.5@494)^10 | 1",
    "alpha": 0.05}], "base": {"albedo": 0.5}})";
const char* const kCoated = R"({"inside": 1.35, "layers": [{"stack":
    "1.35 | (1.35@250 | 1.5@250)^10 | 1.35", "alpha": 0.1}], "base": {"albedo": 0.5}})";
const char* const kTwoLayers = R"({"layers": [
    {"stack": "1 | (1@125 | 1.5@375)^20 | 1", "alpha": 0.1},
    {"stack": "1 | (1@101 | 1.5@143)^20 | 1", "alpha": 0.1}], "base": {"albedo": 0.2}})";

}  // namespace

// FPB24 eq. 34 with f_t cos instead of f_t, and the closed form of all paths, in 30 digits.
TEST_CASE("BRDFs of figures 1 and 7", "[rough][layered]") {
    const std::vector<double> nm{450, 550, 650};
    const std::vector<ScatterPair> pairs{{0, 0, 0}, {30, 30, 180}, {30, 30, 0}};
    const auto check = [&](const char* json, Paths paths, const std::vector<double>& expected,
                           double relative) {
        const std::vector<double> f = scattering_of(json).brdf(pairs, nm, paths);
        for (std::size_t i = 0; i < expected.size(); ++i)
            CHECK_THAT(f[i], WithinRel(expected[i], relative));
    };
    check(kGreyBase, Paths::single,
          {0.15791359164815508, 1.590140048167968, 8.763040032455102, 30.89741553672466,
           41.0563425282268, 0.7808855520552964, 0.05251885143323797, 0.007889674509475801,
           0.15404680645425237},
          1e-12);
    check(kGreyBase, Paths::all,
          {0.18082995756124676, 1.6168071084397937, 8.770409684758096, 30.905233149828277,
           41.05783487033919, 0.7920489102184222},
          1e-7);
    check(kCoated, Paths::single,
          {0.18952554537539668, 0.08522456373842456, 0.08419354535146625, 2.426432773760218,
           0.10125579922282853, 0.22707459304606442, 0.045057606775668474, 0.0822152720697317,
           0.07945175466128325},
          1e-12);
    check(kTwoLayers, Paths::single,
          {7.957784873465548, 0.9745539366291343, 6.398626702959192, 4.954103892815189,
           9.91062738450613, 10.645031290797409, 0.03129663399341897, 0.0019134349505361334,
           0.012909184880658849},
          1e-12);
}

TEST_CASE("what the layers let through and how they are sampled", "[rough][layered]") {
    const std::vector<double> nm{450, 550, 650}, normal{0};
    const LayeredScattering coated = scattering_of(kCoated);
    const std::vector<double> tau = coated.straight(0, normal, nm);
    const std::vector<double> expected{0.9363140314426337, 0.99485754737307, 0.9939685268017148};
    for (std::size_t w = 0; w < 3; ++w) CHECK_THAT(tau[w], WithinRel(expected[w], 1e-12));
    const std::vector<double> p = coated.sampling(normal, nm);
    CHECK_THAT(p[0], WithinRel(0.02218198279764605, 1e-13));
    CHECK_THAT(p[1], WithinRel(0.06227328749837537, 1e-11));
    CHECK_THAT(p[2], WithinRel(0.9155447297039786, 1e-12));
    const std::vector<double> many = coated.multiplexed_sampling(normal, nm);
    CHECK_THAT(many[1], WithinRel(0.024399784497717774, 1e-11));
    CHECK_THAT(many[2], WithinRel(0.9534182327046362, 1e-12));
    Random random(7);
    for (int i = 0; i < 10; ++i) {
        const LayeredScattering scattering(random_surface(random, 3), Crossings::single,
                                           Execution(1));
        const std::vector<double> angle{random.uniform(0, 90)};
        const std::vector<double> all = scattering.sampling(angle, {random.uniform(400, 700)});
        double sum = 0;
        for (const double one : all) {
            CHECK(one >= 0);
            sum += one;
        }
        CHECK_THAT(sum, WithinAbs(1, 1e-14));
    }
}

TEST_CASE("very many directions are as exact as few", "[rough][layered]") {
    const LayeredScattering scattering = scattering_of(kCoated);
    const std::vector<double> nm{450, 600};
    std::vector<ScatterPair> pairs;
    for (int k = 0; k < 1500; ++k) pairs.push_back({0.03 * k, 80 - 0.05 * k, 0.1 * k});
    const std::vector<double> many = scattering.brdf(pairs, nm, Paths::single);
    for (std::size_t p = 0; p < pairs.size(); p += 97) {
        const std::vector<double> one = scattering.brdf({&pairs[p], 1}, nm, Paths::single);
        for (std::size_t w = 0; w < nm.size(); ++w)
            CHECK_THAT(many[p * nm.size() + w], WithinRel(one[w], 1e-8));
    }
}

TEST_CASE("BRDFs are reciprocal", "[rough][layered]") {
    Random random(3);
    for (int i = 0; i < 20; ++i) {
        const LayeredScattering scattering(random_surface(random, 3), Crossings::single,
                                           Execution(1));
        const double a = random.uniform(0, 90), b = random.uniform(0, 90);
        const double phi = random.uniform(0, 180), nm = random.uniform(400, 700);
        const std::vector<ScatterPair> both{{a, b, phi}, {b, a, phi}};
        const std::vector<double> f = scattering.brdf(both, {nm}, Paths::single);
        CHECK_THAT(f[0], WithinRel(f[1], 1e-13));
    }
}

// The integral over facets compared with that over directions outside.
TEST_CASE("albedos are hemispherical integrals of the BRDF", "[rough][layered][slow]") {
    Random random(5);
    for (int i = 0; i < 12; ++i) {
        const LayeredScattering scattering(random_surface(random, 2), Crossings::single,
                                           Execution(1));
        const std::vector<double> theta{random.uniform(0, 85)};
        const double nm = random.uniform(400, 700);
        for (const Paths paths : {Paths::single, Paths::all}) {
            if (paths == Paths::all && !scattering.is_closed()) continue;
            INFO(i << ": " << theta[0] << " degrees, " << nm << " nm");
            const double a = scattering.albedo(theta, {nm}, paths)[0];
            CHECK_THAT(a, WithinAbs(by_hemisphere(scattering, theta[0], nm, paths), 2e-5));
            CHECK(a <= 1);
        }
    }
}

TEST_CASE("a white furnace", "[rough][layered]") {
    const std::vector<double> theta{0, 40, 80};
    // a lossless base under a smooth coating: all light comes out again
    for (const double a : scattering_of(R"({"inside": 1.5, "base": {"albedo": 1}})")
                              .albedo(theta, {550}, Paths::all))
        CHECK_THAT(a, WithinAbs(1, 1e-8));
    // light masked by facets is lost
    const std::string film = R"({"layers": [{"stack": "1 | 2.2@100 | 1", "alpha": ALPHA}],
                               "base": {"albedo": 1}})";
    for (const auto& [alpha, lost] : {std::pair("0.001", 0.01), {"0.1", 0.15}, {"0.8", 1.0}}) {
        std::string json = film;
        json.replace(json.find("ALPHA"), 5, alpha);
        for (const double a : scattering_of(json).albedo(theta, {550}, Paths::all)) {
            CHECK(a <= 1);
            CHECK(a >= 1 - lost);
        }
    }
}

TEST_CASE("smooth facets are mirrors, and layers that are not there only mask",
          "[rough][layered]") {
    const std::string film = "1 | 2.2@100 | 1";
    const LayeredScattering smooth =
        scattering_of(R"({"layers": [{"stack": "1 | 2.2@100 | 1", "alpha": 1e-4}]})");
    const std::vector<double> theta{0, 30, 60};
    const std::vector<double> R = smooth.layer(0).facets().values(theta, {550});
    const std::vector<double> a = smooth.albedo(theta, {550}, Paths::single);
    const std::vector<double> tau = smooth.straight(0, theta, {550});
    for (std::size_t i = 0; i < theta.size(); ++i) {
        CHECK_THAT(a[i], WithinAbs(R[i], 1e-6));
        CHECK_THAT(tau[i], WithinAbs(1 - R[i], 1e-6));
    }
    const LayeredScattering nothing =
        scattering_of(R"({"layers": [{"stack": "1 | 1", "alpha": 0.5}]})");
    for (const double angle : theta) {
        const double G1 = smith_masking(0.5, cos_of_incidence(angle));
        const std::vector<double> one{angle};
        CHECK_THAT(nothing.straight(0, one, {550})[0], WithinRel(G1, 1e-12));
        CHECK_THAT(nothing.albedo(one, {550}, Paths::single)[0], WithinAbs(0, 1e-14));
    }
}

TEST_CASE("straight light that crosses several facets", "[rough][layered]") {
    const std::vector<double> theta{0, 45, 80, 89};
    // where every facet transmits everything, all light goes on
    const LayeredScattering nothing =
        scattering_of(R"({"layers": [{"stack": "1 | 1", "alpha": 0.5}]})", Crossings::multiple);
    for (const double tau : nothing.straight(0, theta, {550})) CHECK_THAT(tau, WithinRel(1, 1e-11));
    Random random(11);
    for (int i = 0; i < 10; ++i) {
        const LayeredSurface surface = random_surface(random, 1);
        const LayeredScattering once(surface, Crossings::single, Execution(1)),
            often(surface, Crossings::multiple, Execution(1));
        const std::vector<double> tau = once.straight(0, theta, {550}),
                                  more = often.straight(0, theta, {550});
        LayeredSurface bare = surface;
        bare.outside = bare.inside;
        bare.base_albedo = Constant{0};
        const std::vector<double> a = LayeredScattering(bare, Crossings::single, Execution(1))
                                          .albedo(theta, {550}, Paths::single);
        for (std::size_t k = 0; k < tau.size(); ++k) {
            CHECK(more[k] >= tau[k] - 1e-15);
            CHECK(a[k] + more[k] <= 1 + 1e-9);
        }
    }
}

TEST_CASE("opaque mirrors, absorbers and a billion periods", "[rough][layered]") {
    for (const char* stack : {"1 | (1@100 | 1.5@100)^1000000000 | 1", "1 | 0.2+3.4i@5000 | 1",
                              "1 | 1.5@100 | 0.2+3.4i", "1 | (2.3+0.01i@60 | 1.46@94)^40 | 1"}) {
        const LayeredScattering scattering = scattering_of(
            std::string(R"({"layers": [{"alpha": 0.2, "stack": ")") + stack + "\"}]}");
        const std::vector<double> theta{0, 60, 90};
        for (const double a : scattering.albedo(theta, {450, 550}, Paths::single)) {
            CHECK(a >= 0);
            CHECK(a <= 1);
        }
        for (const double tau : scattering.straight(0, theta, {450, 550})) {
            CHECK(tau >= 0);
            CHECK(tau <= 1);
        }
    }
}

TEST_CASE("colours are integrals of the spectra", "[rough][layered][slow]") {
    const ColorTables tables(Sensitivity(observer(2), {{540, 600}, {1, 2}}));
    const Sensitivity& sensitivity = tables.sensitivity();
    std::vector<double> nm;  // Simpson's rule between rows of the sensitivity
    for (double at = 540; at <= 600; at += 0.5) nm.push_back(at);
    const auto integrated = [&](std::span<const double> spectrum) {
        Triple xyz{};
        for (std::size_t w = 0; w < nm.size(); ++w) {
            const double weight = w == 0 || w + 1 == nm.size() ? 1 : w % 2 == 0 ? 2 : 4;
            for (std::size_t c = 0; c < 3; ++c)
                xyz[c] += weight / 6 * sensitivity.at(nm[w])[c] * spectrum[w];
        }
        return xyz;
    };
    const auto check = [&](const char* json, Paths paths) {
        const std::vector<ScatterPair> pairs{{30, 50, 160}};
        const LayeredColor color(tables, surface_of(json), Crossings::single, 1e-6, Execution(0));
        const LayeredScattering scattering(surface_of(json), Crossings::single, Execution(0));
        std::vector<double> f = scattering.brdf(pairs, nm, paths);
        for (double& one : f) one *= kPi;
        const SurfaceColor got = color.brdf(pairs, paths)[0];
        const Triple expected = integrated(f);
        CHECK(got.error <= 1e-6);
        for (std::size_t c = 0; c < 3; ++c)
            CHECK_THAT(got.xyz[c], WithinAbs(expected[c], 1e-5 * (1 + expected[c])));
        if (scattering.layers() > 1) return;
        const std::vector<double> theta{50};
        const Triple albedo = integrated(scattering.albedo(theta, nm, paths));
        for (std::size_t c = 0; c < 3; ++c)
            CHECK_THAT(color.albedo(theta, paths)[0].xyz[c], WithinAbs(albedo[c], 3e-6));
    };
    check(kGreyBase, Paths::all);
    check(kCoated, Paths::single);
    check(R"({"layers": [{"stack": "1 | (1@125 | 1.5@375)^3 | 1", "alpha": 0.1},
              {"stack": "1 | (1@101 | 1.5@143)^4 | 1", "alpha": 0.1}], "base": {"albedo": 0.2}})",
          Paths::single);
}
