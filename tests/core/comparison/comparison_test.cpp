#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/comparison/engine_fit.hpp"
#include "core/comparison/film_set.hpp"
#include "core/error.hpp"
#include "core/material/library.hpp"
#include "core/stack/builder.hpp"

using namespace irido;
using Catch::Contains;
using Catch::WithinAbs;

namespace {

const ColorTables& tables_under(std::string_view light) {
    static const ColorTables d65(Sensitivity(observer(2), illuminant("D65")));
    static const ColorTables e(Sensitivity(observer(2), illuminant("E")));
    return light == "E" ? e : d65;
}

ComparedEngine formula(std::string_view name) {
    for (const Engine* const engine : engines())
        if (engine->name == name) return {std::string(name), engine, {}};
    return {};
}

std::vector<ComparedEngine> all_formulas() {
    std::vector<ComparedEngine> all;
    for (const Engine* const engine : engines()) all.push_back(formula(engine->name));
    return all;
}

/// Exact colours: integrals of the CIE tables in double, accurate to 1e-12.
struct ExactFilm {
    double film_n, thickness_nm, angle_deg, base_n, base_k;
    Triple xyz_d65, xyz_e;

    ComparedFilm film() const {
        return compared_film("film", angle_deg,
                             {.film_n = film_n,
                              .thickness_nm = thickness_nm,
                              .base_n = {base_n, base_n, base_n},
                              .base_k = {base_k, base_k, base_k}});
    }
};
const std::array kExact = std::to_array<ExactFilm>({
    {1.38,
     99.6,
     0,
     1.52,
     0.0,
     {0.0131295481741, 0.0130241666061, 0.017474341139},
     {0.0138012651931, 0.0130354875843, 0.0161970992637}},
    {1.33,
     380.0,
     45,
     1.0,
     0.0,
     {0.0739788459051, 0.0886172917882, 0.0227245678453},
     {0.0790503659455, 0.089084945738, 0.0200429266305}},
    {2.3,
     35.0,
     0,
     2.15,
     2.9,
     {0.076464933853, 0.0669151307485, 0.0517135727331},
     {0.0828225668967, 0.0687799909687, 0.0485043244493}},
    {1.46,
     300.0,
     60,
     0.2,
     3.4,
     {0.874729561189, 0.908482598252, 0.991862483485},
     {0.92123033934, 0.909662076352, 0.912005118701}},
    {1.5,
     1200.0,
     30,
     1.8,
     0.0,
     {0.0437289317508, 0.049015224566, 0.0502798030416},
     {0.0457362743499, 0.0489404204008, 0.0475062598077}},
});

/// CIEDE2000 of engines compiled in double: under D65, each relative to its own white; under E,
/// adapted; and as CIE RGB if the engine claims that, else -1.
struct ExactDifference {
    std::size_t film;
    std::string_view engine;
    double d65, e, as_cie_rgb;
};
const std::array kDifferences = std::to_array<ExactDifference>({
    {0, "gltf", 3.619342, 3.758222, -1},
    {0, "three", 3.678661, 3.823807, -1},
    {0, "babylon", 3.609209, 3.746861, -1},
    {0, "unity", 13.487359, 13.908079, -1},
    {0, "materialx", 1.388939, 1.543562, 0.189539},
    {0, "materialx-gltf", 9.043563, 8.856032, 11.284575},
    {0, "cycles", 0.197657, 0.140231, -1},
    {1, "gltf", 4.745796, 5.003492, -1},
    {1, "three", 3.202257, 3.513542, -1},
    {1, "babylon", 3.985538, 4.26218, -1},
    {1, "unity", 21.255392, 21.438352, -1},
    {1, "materialx", 4.310253, 4.688649, 0.843971},
    {1, "materialx-gltf", 22.42345, 22.606205, 22.327015},
    {1, "cycles", 0.600408, 0.167226, -1},
    {2, "gltf", 32.740844, 32.40349, -1},
    {2, "three", 32.752726, 32.415402, -1},
    {2, "babylon", 32.732757, 32.395386, -1},
    {2, "unity", 47.034061, 46.464378, -1},
    {2, "materialx", 5.419387, 5.580454, 3.239683},
    {2, "materialx-gltf", 35.56543, 35.227741, 36.052915},
    {2, "openpbr", 35.56543, 35.227741, 36.052915},
    {2, "cycles", 1.798074, 2.024546, -1},
    {2, "cycles-principled", 9.506462, 9.511204, -1},
    {3, "gltf", 2.755064, 2.763592, -1},
    {3, "three", 2.810271, 2.821418, -1},
    {3, "babylon", 2.758284, 2.767064, -1},
    {3, "unity", 1.637211, 1.536164, -1},
    {3, "materialx", 0.800823, 0.79938, 0.177751},
    {3, "materialx-gltf", 16.504023, 16.551103, 17.366564},
    {3, "openpbr", 16.504303, 16.551382, 17.366846},
    {3, "cycles", 0.16756, 0.202776, -1},
    {3, "cycles-principled", 2.534497, 2.455295, -1},
    {4, "gltf", 1.310644, 1.795635, -1},
    {4, "three", 1.252792, 1.747285, -1},
    {4, "babylon", 1.317455, 1.801488, -1},
    {4, "unity", 7.693529, 7.829218, -1},
    {4, "materialx", 2.579944, 2.978829, 1.802263},
    {4, "materialx-gltf", 5.845333, 5.991922, 5.915142},
    {4, "cycles", 0.474567, 0.490185, -1},
});

}  // namespace

TEST_CASE("differences of engines from exact colours", "[comparison]") {
    using enum DifferenceRequest::White;
    const EngineDifference d65({}, tables_under("D65").sensitivity().white());
    const Triple& white_e = tables_under("E").sensitivity().white();
    const EngineDifference e({common, false}, white_e), cie({own, true}, white_e);
    ColorRequest request;
    request.tolerance = kComparisonTolerance;
    for (const ExactDifference& row : kDifferences) {
        const ExactFilm& exact = kExact[row.film];
        const std::array film{exact.film()};
        const std::array engine{formula(row.engine)};
        INFO(row.engine << " of film " << row.film);
        const EngineColor under_d65 =
            compare_films(tables_under("D65"), engine, d65, film, request, 1).front();
        const EngineColor under_e =
            compare_films(tables_under("E"), engine, e, film, request, 1).front();
        CHECK(largest_difference(*under_d65.exact_xyz, exact.xyz_d65) < 1e-9);
        CHECK(largest_difference(*under_e.exact_xyz, exact.xyz_e) < 1e-9);
        CHECK_THAT(*under_d65.delta_e, WithinAbs(row.d65, 1e-4));
        CHECK_THAT(*under_e.delta_e, WithinAbs(row.e, 1e-4));
        if (row.as_cie_rgb >= 0)
            CHECK_THAT(cie(engine[0], *under_e.rgb, *under_e.exact_xyz),
                       WithinAbs(row.as_cie_rgb, 1e-4));
    }
}

TEST_CASE("a common white instead of each its own moves differences little", "[comparison]") {
    using enum DifferenceRequest::White;
    const Triple& white = tables_under("D65").sensitivity().white();
    const EngineDifference apart({own, false}, white), shared({common, false}, white);
    ColorRequest request;
    const std::vector<ComparedEngine> engines = all_formulas();
    const std::vector<ComparedFilm> films = random_films(tables_under("D65"), 40, 3, {});
    const auto a = compare_films(tables_under("D65"), engines, apart, films, request, 0);
    const auto b = compare_films(tables_under("D65"), engines, shared, films, request, 0);
    for (std::size_t i = 0; i < a.size(); ++i)
        CHECK(std::abs(*a[i].delta_e - *b[i].delta_e) < 0.02);
}

TEST_CASE("what engines are given of a stack", "[comparison]") {
    const ColorTables& tables = tables_under("D65");
    const auto library = [](const char* name) { return find_material(name).value().material; };
    {
        StackBuilder b;
        b.add(b.layer(1.38, 99.6));
        const GivenFilm given = given_film(tables, b.over(1.52));
        CHECK(given.dropped.empty());
        CHECK(given.film.film_n == 1.38);
        CHECK(given.with_thickness_of(b.over(1.52)).thickness_nm == 99.6);
        CHECK_THAT(given.film.base_f0[0], WithinAbs(0.042579994960947345, 1e-15));
        CHECK(given.film.base_f82_tint == Triple{1, 1, 1});
    }
    {  // gold: F0 is the colour of the bare metal, n and k those at three wavelengths
        StackBuilder b;
        b.add(b.layer(1.3, 300));
        const Stack stack = b.over_material(b.material(library("Au")));
        const GivenFilm given = given_film(tables, stack);
        CHECK(given.dropped.empty());
        CHECK(given.film.is_conductor());
        for (std::size_t c = 0; c < 3; ++c) {
            const Complex n = index_at(library("Au"), kBaseWavelengths_nm[c]);
            CHECK(given.film.base_n[c] == n.real());
            CHECK(given.film.base_k[c] == n.imag());
            CHECK(given.film.base_f82_tint[c] > 0.9);
        }
        CHECK(given.film.base_f0[0] > 0.99);
        CHECK(given.film.base_f0[2] < 0.45);
    }
    {  // everything that engines cannot take
        StackBuilder b;
        b.add(StackBuilder::layer_of(b.material(library("TiO2")), 50));
        b.add(b.layer({1.5, 0.1}, 80));
        const GivenFilm given = given_film(tables, b.over_material(b.material(library("BK7"))));
        CHECK(given.dropped == std::vector<std::string>{
                                   "dispersion of the film", "absorption of the film",
                                   "all layers but the first (1 more)", "dispersion of the base"});
    }
    {  // the index of the incident medium is divided out, exactly
        const auto in_water = [](double n0) {
            StackBuilder b(n0);
            b.add(b.layer(1.5 * n0, 300 / n0));
            return b.over({0.9 * n0, 2 * n0});
        };
        const GivenFilm air = given_film(tables, in_water(1));
        const GivenFilm water = given_film(tables, in_water(1.25));
        CHECK(water.dropped == std::vector<std::string>{"an incident medium other than air"});
        CHECK_THAT(water.film.film_n, WithinAbs(1.5, 1e-15));
        CHECK_THAT(water.with_thickness_of(in_water(1.25)).thickness_nm, WithinAbs(300, 1e-12));
        for (std::size_t c = 0; c < 3; ++c) {
            CHECK_THAT(water.film.base_f0[c], WithinAbs(air.film.base_f0[c], 1e-14));
            CHECK_THAT(water.film.base_f82_tint[c], WithinAbs(air.film.base_f82_tint[c], 1e-14));
        }
    }
}

TEST_CASE("equal wavelengths converge to the exact colour", "[comparison]") {
    const ColorTables& tables = tables_under("D65");
    const EngineDifference difference({}, tables.sensitivity().white());
    const std::vector<ComparedEngine> engines{{"equal/8", nullptr, color_method("equal", 8)},
                                              {"equal/64", nullptr, color_method("equal", 64)},
                                              {"equal/4096", nullptr, color_method("equal", 4096)}};
    const std::vector<ComparedFilm> films = random_films(tables, 30, 11, {});
    const auto colors = compare_films(tables, engines, difference, films, {}, 0);
    for (std::size_t f = 0; f < films.size(); ++f) {
        CHECK(*colors[3 * f + 2].delta_e < 0.02);
        CHECK(*colors[3 * f + 1].delta_e < *colors[3 * f].delta_e + 0.02);
    }
}

TEST_CASE("random films are the same everywhere, and typable", "[comparison]") {
    const ColorTables& tables = tables_under("D65");
    const auto films = random_films(tables, 3, 1, {});
    CHECK(films[0].id == "1 | 2.244@971.1 | 1.833+4.696i; 37.8 deg");
    const auto more = random_films(tables, 200, 1, {});
    CHECK(more[2].id == films[2].id);
    std::set<std::string> ids;
    std::array<int, 3> kinds{};
    for (const ComparedFilm& film : more) {
        ids.insert(film.id);
        ++kinds[static_cast<std::size_t>(film.base())];
    }
    CHECK(ids.size() == more.size());
    for (const int count : kinds) CHECK(count > 40);
    for (const std::string_view kind : base_kind_names())
        for (const ComparedFilm& film : random_films(tables, 20, 5, base_kind(kind)))
            CHECK(name_of(film.base()) == kind);
    CHECK(random_films(tables, 3, 2, {})[0].id != films[0].id);
    CHECK_THROWS_WITH(base_kind("metal"),
                      "base must be one of dielectric, conductor, colored (got 'metal')");
}

TEST_CASE("bases known at three wavelengths have engine colours only", "[comparison]") {
    const ColorTables& tables = tables_under("D65");
    const EngineDifference difference({}, tables.sensitivity().white());
    const std::array film{compared_film("three numbers", 40,
                                        {.film_n = 1.6,
                                         .thickness_nm = 250,
                                         .base_n = {0.18, 0.42, 1.37},
                                         .base_k = {3.42, 2.35, 1.77}})};
    CHECK(film[0].base() == BaseKind::colored);
    CHECK_FALSE(film[0].stack);
    const std::vector<ComparedEngine> engines{formula("cycles"),
                                              {"naive", nullptr, color_method("naive")},
                                              {"equal/16", nullptr, color_method("equal", 16)}};
    const auto colors = compare_films(tables, engines, difference, film, {}, 1);
    CHECK(colors[0].rgb);
    CHECK_FALSE(colors[0].exact_xyz);
    CHECK_FALSE(colors[0].delta_e);
    CHECK(colors[1].rgb);
    CHECK_FALSE(colors[2].rgb);
}

TEST_CASE("statistics of differences", "[comparison]") {
    const std::vector<std::optional<double>> values{3.0, {}, 1.0, 10.0, 2.0, 10.0};
    const DifferenceSummary summary = summary_of(values);
    CHECK(summary.count == 5);
    CHECK_THAT(summary.mean, WithinAbs(5.2, 1e-15));
    CHECK(summary.median == 3);
    CHECK_THAT(summary.p95, WithinAbs(10, 1e-15));
    CHECK(summary.max == 10);
    CHECK(summary.worst == 3);
    const std::vector<std::optional<double>> two{1.0, 2.0};
    CHECK_THAT(summary_of(two).p95, WithinAbs(1.95, 1e-15));
    CHECK(summary_of(std::vector<std::optional<double>>{std::nullopt}).count == 0);
}

// Numbers for single films, in the form of the formulas.
TEST_CASE("random films err as they did", "[comparison]") {
    const ColorTables& tables = tables_under("D65");
    const EngineDifference difference({}, tables.sensitivity().white());
    const std::vector<ComparedEngine> engines = all_formulas();
    const std::vector<ComparedFilm> films = random_films(tables, 150, 1, {});
    const auto colors = compare_films(tables, engines, difference, films, {}, 0);
    const std::array<double, 9> mean{9.0143700424,  8.73539165,   8.6520514701,
                                     16.8951056721, 5.1473128491, 12.5531763594,
                                     10.7700265278, 1.5463913451, 3.4444443456};
    for (std::size_t e = 0; e < engines.size(); ++e) {
        std::vector<std::optional<double>> values;
        for (std::size_t f = 0; f < films.size(); ++f)
            values.push_back(colors[f * engines.size() + e].delta_e);
        INFO(engines[e].name);
        CHECK_THAT(summary_of(values).mean, WithinAbs(mean[e], 1e-3));
    }
}

namespace {

/// Fits an engine to a stack at 0, 5, ..., 80 degrees.
EngineFit fitted(const char* engine, const Stack& stack, unsigned threads = 0) {
    const ColorTables& tables = tables_under("D65");
    const EngineDifference difference({}, tables.sensitivity().white());
    const std::vector<ComparedEngine> engines{formula(engine)};
    std::vector<double> angles;
    for (int angle = 0; angle <= 80; angle += 5) angles.push_back(angle);
    const std::vector<double> weights(angles.size(), 1);
    const StackComparison comparison(tables, engines, difference, stack, {});
    const auto colors = comparison(stack, angles);
    std::vector<Triple> xyz;
    for (const EngineColor& color : colors) xyz.push_back(*color.exact_xyz);
    return fit_engine(engines[0], difference, {angles, weights, xyz},
                      comparison.given().with_thickness_of(stack), threads);
}

Stack film_over(const char* film, double thickness_nm, const char* base) {
    StackBuilder b;
    b.add(StackBuilder::layer_of(b.material(find_material(film).value().material), thickness_nm));
    return b.over_material(b.material(find_material(base).value().material));
}

}  // namespace

TEST_CASE("fits of glTF come as near as is known to be possible", "[comparison][slow]") {
    CHECK(fitted("gltf", film_over("TiO2", 35, "Ti")).delta_e_mean < 1.1);
    CHECK(fitted("gltf", film_over("SiO2", 100, "Si")).delta_e_mean < 1.21);
    StackBuilder b;
    b.add(b.layer(1.47, 400));
    const Stack oil = b.over_material(b.material(find_material("water").value().material));
    const EngineFit fit = fitted("gltf", oil);
    CHECK(fit.delta_e_mean < 1.32);
    CHECK_THAT(fit.value_of("iridescenceIor"), WithinAbs(1.47, 0.05));
    CHECK_THROWS_AS(fit.value_of("ior"), DomainError);
    // an engine's own film is recovered
    CHECK(fitted("cycles", oil).delta_e_mean < 0.2);
}

TEST_CASE("fits do not depend on threads, and mirrors have none", "[comparison][slow]") {
    const Stack wafer = film_over("SiO2", 100, "Si");
    const EngineFit one = fitted("openpbr", wafer, 1), many = fitted("openpbr", wafer, 3);
    CHECK(one.form == many.form);
    REQUIRE(one.parameters.size() == many.parameters.size());
    for (std::size_t i = 0; i < one.parameters.size(); ++i)
        CHECK(one.parameters[i].value == many.parameters[i].value);
    CHECK(has_parameters(formula("unity")));
    const ComparedEngine naive{"naive", nullptr, color_method("naive")};
    CHECK_FALSE(has_parameters(naive));
    const EngineDifference difference({}, {0.95, 1, 1.09});
    CHECK_THROWS_WITH(fit_engine(naive, difference, {}, {}, 1), "naive has no parameters to fit");
}
