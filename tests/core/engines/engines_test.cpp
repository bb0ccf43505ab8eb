#include "core/engines/engine.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/coherent/coherent.hpp"
#include "core/engines/series.hpp"
#include "core/error.hpp"
#include "core/math/random.hpp"

using namespace irido;

namespace {

const Engine& engine_named(std::string_view name) {
    return **std::ranges::find_if(engines(),
                                  [&](const Engine* engine) { return engine->name == name; });
}

struct Film {
    double film_n, thickness_nm, angle_deg;
    Triple base_n, base_k;

    EngineFilm for_engines() const {
        return with_base({.cos_theta = cos_of_incidence(angle_deg),
                          .film_n = film_n,
                          .thickness_nm = thickness_nm,
                          .base_n = base_n,
                          .base_k = base_k});
    }
};

const std::array kFilms = std::to_array<Film>({
    {1.38, 99.6, 0, {1.52, 1.52, 1.52}, {0.0, 0.0, 0.0}},      // antireflection coating
    {1.33, 380.0, 45, {1.0, 1.0, 1.0}, {0.0, 0.0, 0.0}},       // soap film
    {2.3, 35.0, 0, {2.15, 2.15, 2.15}, {2.9, 2.9, 2.9}},       // oxide on titanium-like metal
    {1.46, 300.0, 60, {0.2, 0.2, 0.2}, {3.4, 3.4, 3.4}},       // oxide on a good metal
    {1.5, 1200.0, 30, {1.8, 1.8, 1.8}, {0.0, 0.0, 0.0}},       // thick film
    {1.6, 250.0, 40, {0.18, 0.42, 1.37}, {3.42, 2.35, 1.77}},  // n, k per channel
});

/// r, g, b from the engines' own shader sources (versions as in each engine's entry), compiled in
/// double precision.
struct EngineColor {
    std::size_t film;
    std::string_view engine;
    Triple rgb;
};
const std::array kColors = std::to_array<EngineColor>({
    {0, "gltf", {0.0107145505387536, 0.0131764319589396, 0.0177042214165557}},
    {0, "three", {0.0104491903530089, 0.0129919301712467, 0.0176726004972974}},
    {0, "babylon", {0.0107799645507536, 0.0132291489312669, 0.0177329592369054}},
    {0, "unity", {0.000397573805049373, 0.0181801535725013, 0.0574715353555134}},
    {0, "materialx", {0.013250176307487, 0.0129441078971938, 0.0162091337197767}},
    {0, "materialx-gltf", {0.00226187830150256, 0.00129835824145292, 0.0114792349376227}},
    {0, "cycles", {0.0138334946977521, 0.0124646915236697, 0.0168357754058148}},
    {1, "gltf", {0.0776185882937332, 0.0693959081534015, 0.00874784407714513}},
    {1, "three", {0.08936322415088, 0.0799711999502545, 0.010039052872029}},
    {1, "babylon", {0.082896928409376, 0.074127792407715, 0.0091664698234552}},
    {1, "unity", {0.0619289996985558, 0.0636806414705035, 0.0652110365545726}},
    {1, "materialx", {0.100418138114049, 0.0871218578125345, 0.0196766411346552}},
    {1, "materialx-gltf", {0.029295250920592, 0.0287931100252059, 0.0264232653829316}},
    {1, "cycles", {0.0905375266284608, 0.0961768601383492, 0.00839244592310663}},
    {2, "gltf", {0.3783675304874, 0.285668886046348, 0.170023691163907}},
    {2, "three", {0.378529867515164, 0.285787546647633, 0.170085810867996}},
    {2, "babylon", {0.378263804696704, 0.285581894107023, 0.169958548581869}},
    {2, "unity", {0.617651307090618, 0.53626718321966, 0.433859562553956}},
    {2, "materialx", {0.111705237976632, 0.069952426532366, 0.0612271980421706}},
    {2, "materialx-gltf", {0.414761892545536, 0.31927494343792, 0.203330707265279}},
    {2, "openpbr", {0.414761892545536, 0.31927494343792, 0.203330707265279}},
    {2, "cycles", {0.113871393234369, 0.0572124094121389, 0.0513269397987171}},
    {2, "cycles-principled", {0.138280945961448, 0.0690570852273757, 0.0320383516690756}},
    {3, "gltf", {0.967468759503226, 0.90173658008737, 0.8703553182437}},
    {3, "three", {0.968705925072747, 0.901645516073661, 0.869418251528946}},
    {3, "babylon", {0.967412055348115, 0.901580316101679, 0.870152339526059}},
    {3, "unity", {0.977587178138233, 0.904165183302003, 0.929096357053118}},
    {3, "materialx", {0.93614660707357, 0.901987126300644, 0.910187637069244}},
    {3, "materialx-gltf", {0.621193584531356, 0.478060682004731, 0.382020172592901}},
    {3, "openpbr", {0.621187723397145, 0.478054265914338, 0.382013591047135}},
    {3, "cycles", {0.94036017797741, 0.897710004829179, 0.912730140880888}},
    {3, "cycles-principled", {0.941604210696009, 0.905816779734463, 0.882991567461177}},
    {4, "gltf", {0.0424654731942959, 0.0500350816030065, 0.0456971184274714}},
    {4, "three", {0.043359491596738, 0.0511307667421348, 0.0466772264394362}},
    {4, "babylon", {0.0424444282545731, 0.0499985920406266, 0.0456694802988273}},
    {4, "unity", {0.0801693803880418, 0.0819642649372843, 0.0816593803384932}},
    {4, "materialx", {0.0455656988785823, 0.050466432256748, 0.0473808165064308}},
    {4, "materialx-gltf", {0.071529371609034, 0.0818845250212456, 0.0753641166620375}},
    {4, "cycles", {0.0409455766245056, 0.0521529773386885, 0.0470942134575232}},
    {5, "gltf", {0.957997124373907, 0.594526176168907, 0.133390022659641}},
    {5, "three", {0.958863272428872, 0.59352462118767, 0.133307787344005}},
    {5, "babylon", {0.957917501810252, 0.594368808538823, 0.133317696100221}},
    {5, "unity", {0.977410333049577, 0.700365426501652, 0.307955086325984}},
    {5, "materialx", {1.0, 0.464318518422746, 0.351954840613666}},
    {5, "materialx-gltf", {0.811611875301152, 0.271908588038808, 0.127437529294752}},
    {5, "openpbr", {0.811611775907633, 0.271908608668699, 0.12743752158382}},
    {5, "cycles", {0.920191621734983, 0.602453216227898, 0.387716567579187}},
    {5, "cycles-principled", {0.943020185751457, 0.554911623054162, 0.343435232795298}},
});

double distance(const Triple& a, const Triple& b) {
    double most = 0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(a[c] - b[c]));
    return most;
}

}  // namespace

TEST_CASE("engines return what their own sources do", "[engines]") {
    for (const EngineColor& row : kColors) {
        const Triple rgb = engine_named(row.engine).reflectance(kFilms[row.film].for_engines());
        INFO(row.engine << " of film " << row.film);
        // their table has 8 digits, irido recomputes it
        const double tolerance = row.engine.starts_with("cycles") ? 5e-8 : 1e-12;
        CHECK(distance(rgb, row.rgb) < tolerance);
    }
}

TEST_CASE("every engine is listed once, with its version, inputs and limits", "[engines]") {
    std::vector<std::string_view> names;
    for (const Engine* const engine : engines()) {
        names.push_back(engine->name);
        for (const std::string_view text :
             {engine->title, engine->version, engine->date, engine->source, engine->inputs,
              engine->space, engine->white, engine->limits})
            CHECK_FALSE(text.empty());
    }
    std::ranges::sort(names);
    CHECK(std::ranges::adjacent_find(names) == names.end());
    CHECK(names.size() == 9);
}

TEST_CASE("without a film engines have the bare base, but for what their texts lack", "[engines]") {
    for (const double angle : {0.0, 40.0, 75.0}) {
        const Film bare{1.38, 0, angle, {1.5, 1.5, 1.5}, {}};
        const EngineFilm film = bare.for_engines();
        const double exact = bare_reflectance(1.5, 0, film.cos_theta);
        const double schlick = 0.04 + 0.96 * std::pow(1 - film.cos_theta, 5);
        CAPTURE(angle);
        for (const char* const name : {"materialx", "openpbr", "cycles", "cycles-principled"})
            CHECK(distance(engine_named(name).reflectance(film), {exact, exact, exact}) < 1e-14);
        CHECK(distance(materialx_gltf_reflectance(film), {schlick, schlick, schlick}) < 1e-14);
        CHECK(distance(three_reflectance(film), {schlick, schlick, schlick}) < 3e-3);
    }
    // the README says nothing about d = 0: fringes of both faces remain
    const Film none{1.38, 0, 0, {1.5, 1.5, 1.5}, {}};
    CHECK(distance(gltf_reflectance(none.for_engines()), {0.0428, 0.0394, 0.0389}) < 5e-5);
    // metals
    const Film metal{1.38, 0, 50, {0.2, 0.5, 1.4}, {3.4, 2.4, 1.9}};
    const EngineFilm film = metal.for_engines();
    for (const char* const name : {"materialx", "cycles"}) {
        const Triple rgb = engine_named(name).reflectance(film);
        for (std::size_t c = 0; c < 3; ++c)
            CHECK(std::abs(rgb[c] - bare_reflectance(metal.base_n[c], metal.base_k[c],
                                                     film.cos_theta)) < 1e-14);
    }
}

TEST_CASE("a film of index 1 is no film, except where engines show one", "[engines]") {
    const Film gold{1, 300, 0, {0.18, 0.42, 1.37}, {3.42, 2.35, 1.77}};
    const Triple f0 = gold.for_engines().base_f0;
    CHECK(distance(cycles_reflectance(gold.for_engines()), f0) < 1e-12);
    // n and k of r, g, b as those of X, Y, Z
    const Triple materialx = materialx_reflectance(gold.for_engines());
    CHECK(distance(materialx, {1, 0.655, 0.371}) < 2e-3);
    // the halved reflectance of generalized_schlick
    const Film glass{1, 300, 0, {1.5, 1.5, 1.5}, {}};
    CHECK(distance(materialx_gltf_reflectance(glass.for_engines()), {0.02, 0.02, 0.02}) < 1e-6);
    // fringes despite a missing interface
    const Triple gltf = gltf_reflectance(glass.for_engines());
    CHECK(distance(gltf, {0.04, 0.04, 0.04}) > 1e-4);
}

TEST_CASE("a film as dense as its base counts as one over an equal base", "[engines]") {
    for (const double n : {1.3, 1.5, 1.7, 1.9, 2.3, 2.9}) {
        const Film film{n, 250, 30, {n, n, n}, {}};
        const Film denser{n, 250, 30, {n * (1 + 1e-9), n * (1 + 1e-9), n * (1 + 1e-9)}, {}};
        for (const Engine* const engine : engines()) {
            if (engine->name == "unity") continue;
            INFO(engine->name << " " << n);
            CHECK(distance(engine->reflectance(film.for_engines()),
                           engine->reflectance(denser.for_engines())) < 1e-6);
        }
    }
}

TEST_CASE("at grazing incidence and under total reflection films reflect all", "[engines]") {
    for (const Engine* const engine : engines()) {
        const Film grazing{1.4, 300, 90, {1.6, 1.6, 1.6}, {}};
        INFO(engine->name);
        CHECK(distance(engine->reflectance(grazing.for_engines()), {1, 1, 1}) < 1e-3);
        if (engine->name == "unity") continue;
        const Film total{0.7, 300, 60, {1.6, 1.6, 1.6}, {}};
        if (engine->title.find("MaterialX") == std::string_view::npos)
            CHECK(engine->reflectance(total.for_engines()) == Triple{1, 1, 1});
    }
    // MaterialX does not accept a film index below 1
    const Film total{0.7, 300, 60, {1.6, 1.6, 1.6}, {}}, air{1, 300, 60, {1.6, 1.6, 1.6}, {}};
    CHECK(materialx_reflectance(total.for_engines()) == materialx_reflectance(air.for_engines()));
    // a film on a less dense medium
    const Film inside{1.8, 300, 60, {1, 1, 1}, {}};
    for (const char* const name : {"materialx", "cycles"})
        CHECK(engine_named(name).reflectance(inside.for_engines())[1] < 1);
}

TEST_CASE("engines are finite, and within [0, 1] where they clip", "[engines]") {
    Random random(7);
    for (int i = 0; i < 20000; ++i) {
        const bool edge = random.one_in(4);
        const auto pick = [&](double a, double b, std::initializer_list<double> special) {
            return edge && random.one_in(2) ? special.begin()[random.below(special.size())]
                                            : random.uniform(a, b);
        };
        Film film{pick(0.3, 4, {0.001, 1, 1.5, 1e4}),
                  pick(0, 3000, {0, 0.02, 0.1, 0.5, 1e9}),
                  pick(0, 90, {0, 90, 89.999999}),
                  {},
                  {}};
        for (std::size_t c = 0; c < 3; ++c) {
            film.base_n[c] = pick(0.05, 5, {1e-6, 1, 1.5, 1e4});
            film.base_k[c] = random.one_in(2) ? 0 : pick(0, 8, {0, 1e-12, 1e4});
        }
        EngineFilm given = film.for_engines();
        if (random.one_in(8)) given.base_f0 = {pick(0, 1, {0, 1, 0.9999}), 1, 0.9999};
        for (const Engine* const engine : engines()) {
            const Triple rgb = engine->reflectance(given);
            INFO(engine->name << " n " << given.film_n << " d " << given.thickness_nm << " cos "
                              << given.cos_theta << " base " << given.base_n[0] << " + i "
                              << given.base_k[0] << " F0 " << given.base_f0[0] << " -> " << rgb[0]
                              << " " << rgb[1] << " " << rgb[2]);
            const bool clips =
                engine->name != "gltf" && engine->name != "babylon" && engine->name != "unity";
            for (const double component : rgb) {
                REQUIRE(std::isfinite(component));
                if (engine->name == "unity") continue;
                if (!clips || given.thickness_nm > 0.1) REQUIRE(component >= 0);
                if (clips && given.thickness_nm > 0.1) REQUIRE(component <= 1);
                REQUIRE(std::abs(component) < 3);
            }
        }
    }
}

TEST_CASE("the factor mixes a film with its bare base", "[engines]") {
    const EngineFilm film = kFilms[2].for_engines();
    CHECK(gltf_reflectance(film, 1) == gltf_reflectance(film));
    CHECK(distance(gltf_reflectance(film, 0), film.base_f0) < 1e-15);
    const Triple half = gltf_reflectance(film, 0.5);
    for (std::size_t c = 0; c < 3; ++c)
        CHECK(std::abs(half[c] - (film.base_f0[c] + gltf_reflectance(film)[c]) / 2) < 1e-15);
}

TEST_CASE("films that no engine can be given are refused", "[engines]") {
    const auto refused = [](EngineFilm film, const std::string& text) {
        CHECK_THROWS_WITH(with_base(film), Catch::Contains(text));
    };
    refused({.cos_theta = -0.1}, "cos_theta must be in [0, 1] (got -0.1)");
    refused({.film_n = 0}, "film index must be in [0.001, 10000] (got 0)");
    refused({.film_n = NAN}, "film index");
    refused({.thickness_nm = -1}, "thickness_nm must be in [0, 1e+09] (got -1)");
    refused({.base_n = {1, 0, 1}}, "base index n");
    refused({.base_k = {0, 0, -1}}, "base index k must be in [0, 10000] (got -1)");
}
