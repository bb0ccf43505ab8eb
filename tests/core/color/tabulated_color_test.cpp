#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>
#include <string>

#include "core/color/stack_color.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/material/library.hpp"
#include "tests/oracle/color_oracle.hpp"
#include "tests/oracle/random_stacks.hpp"

using namespace irido;
using oracle::Random;
using oracle::StackBuilder;

namespace {

const ColorMethod kQuadrature = color_method("quadrature");

/// IRIDO_TEST_TOLERANCES: number of stacks to try; 100000 take a night.
std::size_t stacks_to_try() {
    const char* const text = std::getenv("IRIDO_TEST_TOLERANCES");
    return text ? std::strtoull(text, nullptr, 10) : 0;
}

const ColorTables& tables_of(std::string_view light) {
    static std::map<std::string, ColorTables, std::less<>> tables;
    const auto known = tables.find(light);
    if (known != tables.end()) return known->second;
    return tables.try_emplace(std::string(light), Sensitivity(observer(2), illuminant(light)))
        .first->second;
}

StackColor color(const Stack& stack, double angle_deg, const ColorRequest& request,
                 const ColorTables& tables = tables_of("D65"),
                 const ColorMethod& method = kQuadrature) {
    return stack_color(tables, stack, method, request, std::span(&angle_deg, 1)).front();
}

/// Rows 0.7 to 40 nm apart of a curve with a line, half of them with noise.
Table random_rows(Random& random, bool absorbs) {
    const double step = random.log_uniform(0.7, 40);
    const double size = absorbs ? random.log_uniform(1e-4, 3) : random.uniform(1.2, 2.6);
    const double slope = random.uniform(-0.3, 0.3), line = random.uniform(-0.5, 0.5);
    const double at = random.uniform(350, 800), width = random.log_uniform(10, 300);
    const double noise = random.one_in(2) ? random.log_uniform(1e-5, 1e-2) : 0;
    Table table;
    for (double nm = random.uniform(300, 400); nm < 850; nm += step * random.uniform(0.5, 1.5)) {
        const double value = size * (1 + slope * (nm - 550) / 300 +
                                     line * std::exp(-std::pow((nm - at) / width, 2)));
        table.wavelength_nm.push_back(nm);
        table.value.push_back(
            std::max(absorbs ? 0.0 : 0.05, value + noise * random.uniform(-1, 1)));
    }
    return table;
}

Material random_material(Random& random) {
    constexpr std::array names{"TiO2", "Ti",        "ITO",          "Ag",   "Au",    "Cu",  "Al",
                               "Si",   "Ta2O5",     "Nb2O5",        "ZrO2", "Fe2O3", "TiN", "W",
                               "Cr",   "SiO2-film", "TiO2-anatase", "GaAs", "PMMA",  "ZnS", "Hg"};
    if (random.one_in(2)) return find_material(names[random.below(names.size())])->material;
    RefractiveIndex index{random_rows(random, false), Constant{0}};
    if (random.one_in(3)) index.k = random_rows(random, true);
    return {"rows", index, Outside::clamp};
}

Stack tabulated_stack(Random& random) {
    StackBuilder b;
    std::vector<std::size_t> known;
    for (std::size_t left = 1 + random.below(6); left > 0; --left) {
        if (random.one_in(3)) {
            const double n = random.uniform(1.2, 2.6);
            const double k = random.one_in(4) ? random.log_uniform(1e-3, 1) : 0;
            b.add(b.layer({n, k}, random.uniform(5, 400)));
            continue;
        }
        if (known.empty() || !random.one_in(3))
            known.push_back(b.material(random_material(random)));
        const double nm = random.one_in(6) ? random.log_uniform(400, 8000) : random.uniform(2, 300);
        b.add(StackBuilder::layer_of(known[random.below(known.size())], nm));
    }
    if (random.one_in(8)) {
        const std::size_t material = b.material(random_material(random));
        const Element first = StackBuilder::layer_of(material, random.uniform(30, 150));
        const Element second = b.layer(random.uniform(1.3, 1.6), random.uniform(40, 150));
        b.add(StackBuilder::group(2 + random.below(20), {first, second}));
    }
    if (random.one_in(2)) return b.over_material(b.material(random_material(random)));
    return b.over(random.one_in(2) ? Complex(1.52) : Complex(0.2, 3.4));
}

Stack absorbing_stack(Random& random) {
    StackBuilder b;
    for (std::size_t left = 1 + random.below(8); left > 0; --left) {
        const double n = random.uniform(0.1, 2.7);
        const double k = random.one_in(4) ? 0 : random.log_uniform(1e-3, 4);
        b.add(b.layer({n, k}, random.log_uniform(3, 1000)));
    }
    return b.over({random.uniform(0.1, 3), random.uniform(0, 5)});
}

Light random_light(Random& random) {
    return static_cast<Light>(random.below(3));
}

}  // namespace

TEST_CASE("kinks of tables cost and lose no more than the tolerance asks for", "[slow]") {
    // against other methods: a few by an oracle, many by the rows themselves
    for (std::uint64_t i = 0; i < 3; ++i) {
        Random random(i);
        const Stack stack = tabulated_stack(random);
        const double angle = random.uniform(0, 80);
        const Triple exact =
            oracle::stack_xyz(stack, observer(2), illuminant("D65"), angle, false, 1e-8);
        for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
            const StackColor result = color(stack, angle, {.tolerance = tolerance});
            CAPTURE(i, oracle::text_of(stack), angle, tolerance);
            CHECK(result.error <= tolerance);
            CHECK(largest_difference(result.xyz, exact) <= result.error + 1e-8);
        }
    }
    for (std::uint64_t i = 0; i < std::max<std::size_t>(stacks_to_try(), 5); ++i) {
        Random random(Random(i).bits());
        const auto lights = illuminant_names();
        const ColorTables& tables = tables_of(lights[random.below(lights.size())]);
        const Stack stack = tabulated_stack(random);
        const double angle = random.one_in(3) ? random.uniform(60, 89.5) : random.uniform(0, 80);
        ColorRequest request{.sides = {random.one_in(3) ? Side::transmitted : Side::reflected},
                             .light = random_light(random),
                             .tolerance = 1e-11};
        const Triple exact = color(stack, angle, request, tables).xyz;
        for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
            request.tolerance = tolerance;
            const StackColor result = color(stack, angle, request, tables);
            CAPTURE(i, oracle::text_of(stack), angle, tolerance);
            CHECK(result.error <= tolerance);
            CHECK(largest_difference(result.xyz, exact) <= result.error + 1e-10);
            // a single colour does not repay fits of the tables: their rows end panels
            const StackColor alone = color(stack, angle, request, tables, {});
            CHECK(alone.error <= tolerance);
            CHECK(largest_difference(alone.xyz, exact) <= alone.error + 1e-10);
        }
    }
}

TEST_CASE("tables are fitted where many colours of a structure repay it") {
    StackBuilder b;
    b.add(StackBuilder::layer_of(b.material(find_material("TiO2")->material), 40));
    const Stack stack = b.over_material(b.material(find_material("Ti")->material));
    const auto by = [&](const ColorMethod& method, std::size_t colors, std::size_t structures) {
        return color(stack, 30, {.tolerance = 1e-4, .colors = colors, .structures = structures},
                     tables_of("D65"), method);
    };
    const StackColor alone = by({}, 1, 1), many = by({}, 1000000, 1);
    CHECK(many.evaluations < alone.evaluations / 3);
    CHECK(largest_difference(many.xyz, alone.xyz) <= many.error + alone.error);
    const StackColor shared = by({}, 1000000, 1000000);
    CHECK(shared.xyz == alone.xyz);
    // a method given by name computes the same row in every sweep
    CHECK(by(kQuadrature, 1, 1).xyz == many.xyz);
    CHECK(by(kQuadrature, 1000000, 1000000).xyz == many.xyz);
}

TEST_CASE("absorbing stacks have their colour within the error", "[slow]") {
    // equal wavelengths 0.05 nm apart, which include every kink of the light, are accurate to 1e-7
    const ColorMethod equal = color_method("equal", 9401);
    for (std::uint64_t i = 0; i < std::max<std::size_t>(stacks_to_try(), 100); ++i) {
        Random random(Random(i).bits());
        const Stack stack = absorbing_stack(random);
        const double angle = random.uniform(0, 89);
        const ColorRequest request{
            .sides = {random.one_in(3) ? Side::transmitted : Side::reflected},
            .light = random_light(random)};
        const StackColor result = color(stack, angle, request);
        const StackColor other = color(stack, angle, request, tables_of("D65"), equal);
        CAPTURE(i, oracle::text_of(stack), angle);
        CHECK(result.error <= 1e-6);
        CHECK(largest_difference(result.xyz, other.xyz) <= result.error + 1e-7);
    }
}

TEST_CASE("few wavelengths do not understate the error of absorbing stacks") {
    StackBuilder b;
    b.add(b.layer({1.518752409232798, 0.15244968617769963}, 1897.4561882827038));
    b.add(b.layer(0.59843162407537653, 566.95542219641595));
    b.add(b.layer({2.3840895423198791, 2.0163176699204537}, 68.241519415817422));
    const Stack stack = b.over({0.97086775434554162, 4.3415712273567211});
    ColorRequest request{.light = Light::p, .tolerance = 1e-11};
    const double angle = 83.182897280479779;
    const Triple exact = color(stack, angle, request).xyz;
    for (const double tolerance : {1e-2, 1e-3}) {
        request.tolerance = tolerance;
        const StackColor result = color(stack, angle, request);
        CHECK(largest_difference(result.xyz, exact) <= result.error);
        CHECK(result.error <= tolerance);
    }
}

TEST_CASE("an incoherent layer follows every row of its k") {
    Table n, k;
    for (int row = 0; row <= 250; ++row) {
        for (Table* const table : {&n, &k}) table->wavelength_nm.push_back(350 + 2 * row);
        n.value.push_back(1.5);
        k.value.push_back(row % 5 == 0 ? 0 : 1e-3);
    }
    // equal wavelengths that include every row and resolve the windows between them to 2e-5
    const ColorMethod equal = color_method("equal", 470001);
    const auto [thickness_nm, repeat] =
        GENERATE(table<double, std::uint64_t>({{1e4, 1}, {1e5, 1}, {1e4, 3}}));
    StackBuilder b;
    const Element plate = oracle::incoherent(StackBuilder::layer_of(
        b.material({"rows", RefractiveIndex{n, k}, Outside::clamp}), thickness_nm));
    b.add(repeat == 1 ? plate : Element{Group{repeat, {plate, b.layer(1.3, 100)}}});
    const Stack stack = b.over({1, 0});
    for (const Side side : {Side::reflected, Side::transmitted}) {
        const Triple exact = color(stack, 20, {.sides = {side}}, tables_of("D65"), equal).xyz;
        for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-6}) {
            const StackColor result = color(stack, 20, {.sides = {side}, .tolerance = tolerance});
            CAPTURE(thickness_nm, tolerance);
            CHECK(result.error <= tolerance);
            CHECK(largest_difference(result.xyz, exact) <= result.error + 2e-5);
        }
    }
}

TEST_CASE("a table costs what the question needs, not what its rows are") {
    StackBuilder b;
    b.add(StackBuilder::layer_of(b.material(find_material("TiO2")->material), 35));
    const Stack anodized = b.over_material(b.material(find_material("Ti")->material));
    const auto evaluations = [](const Stack& stack, double tolerance) {
        return color(stack, 30, {.tolerance = tolerance}).evaluations;
    };
    CHECK(evaluations(anodized, 1e-2) < 40);
    CHECK(evaluations(anodized, 1e-4) < 120);
    // a smooth curve of 1 nm rows
    Table rows;
    for (double nm = 350; nm <= 840; ++nm) {
        rows.wavelength_nm.push_back(nm);
        rows.value.push_back(1.5 + 1e4 / (nm * nm));
    }
    StackBuilder c;
    c.add(StackBuilder::layer_of(
        c.material({"rows", RefractiveIndex{rows, Constant{0}}, Outside::clamp}), 300));
    const Stack dense = c.over(1.8);
    CHECK(evaluations(dense, 1e-2) < 40);
    CHECK(evaluations(dense, 1e-6) < 400);
}

TEST_CASE("dispersive mirrors of very many periods have means over their fringes", "[slow]") {
    const auto mirror = [](std::uint64_t periods) {
        StackBuilder b;
        const std::size_t high = b.material(find_material("TiO2")->material);
        const std::size_t low = b.material(find_material("SiO2")->material);
        b.add(StackBuilder::group(
            periods, {StackBuilder::layer_of(high, 58), StackBuilder::layer_of(low, 94)}));
        return b.over_material(b.material(find_material("BK7")->material));
    };
    // at 1e-10 neither means nor waves suffice, and every fringe is followed
    const StackColor mean = color(mirror(3000), 20, {});
    const StackColor all = color(mirror(3000), 20, {.tolerance = 1e-10});
    CHECK(mean.error <= 1e-6);
    CHECK(mean.evaluations < 20000);
    CHECK(all.evaluations > 2 * mean.evaluations);
    CHECK(largest_difference(mean.xyz, all.xyz) <= mean.error + all.error);
    CHECK(color(mirror(1000000000), 20, {}).error <= 1e-6);
}
