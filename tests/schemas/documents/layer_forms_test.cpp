#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/incoherent/chain.hpp"
#include "core/stack/reversed.hpp"
#include "schemas/documents/canonical_stack.hpp"
#include "schemas/documents/stack_document.hpp"
#include "schemas/input_error.hpp"

using namespace irido;
using namespace irido::schemas;
using Catch::WithinRel;
using nlohmann::json;

namespace {

StackDocument read_form(const json& document) {
    return read_stack(document, "f", IRIDO_SOURCE_DIR "/tests/data");
}

std::string refusal_of(const json& document) {
    try {
        read_form(document);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

json one_layer(json layer, const json& more = json::object()) {
    json document{{"incident", 1}, {"layers", json::array({std::move(layer)})}, {"substrate", 1.5}};
    document.update(more);
    return document;
}

const Layer& only_layer(const StackDocument& document) {
    return std::get<Layer>(document.stack.elements.at(0).value);
}

json mixed(const json& inclusion, const json& host, double fraction, const char* model) {
    return {{"mixture",
             {{"inclusion", inclusion}, {"host", host}, {"fraction", fraction}, {"model", model}}}};
}

}  // namespace

TEST_CASE("a mixture in a document", "[schemas]") {
    const json document = one_layer(
        {{"material", mixed("H", {{"n", 2}, {"k", 0.1}}, 0.3, "linear")}, {"thickness_nm", 10}},
        {{"materials", {{"H", 1.46}}}});
    const StackDocument read = read_form(document);
    const Material& material = read.stack.materials[only_layer(read).material];
    const Complex index = index_at(material, 500);
    CHECK_THAT((index * index).real(), WithinRel(0.3 * 1.46 * 1.46 + 0.7 * 3.99, 1e-14));
    CHECK(read_form(canonical_stack(read.stack)).stack.materials[1].model == material.model);
    json plain = document;
    plain["layers"][0]["material"]["mixture"].erase("model");
    const StackDocument as_default = read_form(plain);
    const Material& other = as_default.stack.materials[only_layer(as_default).material];
    CHECK(std::get<Mixture>(other.model).rule == MixingRule::bruggeman);
}

TEST_CASE("mixtures of mixtures and of files", "[schemas]") {
    const json inner = mixed("air", "glass.csv", 0.2, "bruggeman");
    const json outer =
        one_layer({{"material", mixed(inner, "SiO2", 0.5, "series")}, {"thickness_nm", 10}});
    CHECK(read_form(outer).stack.elements.size() == 1);
    json moved = outer;
    move_files(moved, "/a", "/a/b");
    CHECK(moved["layers"][0]["material"]["mixture"]["inclusion"]["mixture"]["host"] ==
          "../glass.csv");
}

TEST_CASE("layers in quarter waves", "[schemas]") {
    const json document = one_layer({{"material", "SiO2"}, {"qwot", 1.5}}, {{"reference_nm", 550}});
    const StackDocument read = read_form(document);
    const double n = index_at(read.stack.materials[only_layer(read).material], 550).real();
    CHECK_THAT(only_layer(read).thickness_nm, WithinRel(1.5 * 550 / 4 / n, 1e-15));
    StackRequest request{"air | (H@1Q | L@0.5Q!)^3 | 1.52", {}, {"H=2.5", "L=1.25"}};
    request.reference_nm = "500";
    const StackDocument typed = read_stack(request);
    const auto& group = std::get<Group>(typed.stack.elements.at(0).value);
    CHECK(std::get<Layer>(group.elements[0].value).thickness_nm == 50);
    CHECK(std::get<Layer>(group.elements[1].value).thickness_nm == 50);
    CHECK_FALSE(std::get<Layer>(group.elements[1].value).coherent);
}

namespace {

json rough_stack(const char* placement) {
    return {{"incident", 1},
            {"layers",
             {{{"material", 1.46}, {"thickness_nm", 100}, {"roughness_nm", 4}},
              {{"repeat", 5},
               {"layers",
                {{{"material", 2.3}, {"thickness_nm", 50}, {"roughness_nm", 2}},
                 {{"material", 1.46}, {"thickness_nm", 80}}}}}}},
            {"substrate", 1.52},
            {"substrate_roughness_nm", 3},
            {"roughness_placement", placement}};
}

double total_nm(std::span<const Element> elements) {
    double sum = 0;
    for (const Layer& layer : written_out(elements)) sum += layer.thickness_nm;
    return sum;
}

}  // namespace

TEST_CASE("rough faces are layers of their own", "[schemas]") {
    const StackDocument added = read_form(rough_stack("added"));
    const std::vector<Layer> layers = written_out(added.stack.elements);
    REQUIRE(layers.size() == 2 + 5 * 3 + 1);
    CHECK(total_nm(added.stack.elements) == 4 + 100 + 5 * (2 + 50 + 80) + 3);
    const auto index = [&](std::size_t i) {
        return index_at(added.stack.materials[layers[i].material], 550).real();
    };
    const auto half = [](double a, double b) {
        return std::sqrt(mixed_permittivity(MixingRule::bruggeman, Complex(a), Complex(b), 0.5))
            .real();
    };
    CHECK_THAT(index(0), WithinRel(half(1, 1.46), 1e-14));
    CHECK(index(1) == 1.46);
    CHECK_THAT(index(2), WithinRel(half(1.46, 2.3), 1e-14));
    CHECK_THAT(index(layers.size() - 1), WithinRel(half(1.46, 1.52), 1e-14));
    // Above the first period is what is above the others: the group stays one.
    const auto& group = std::get<Group>(added.stack.elements.at(1).value);
    CHECK(group.repeat == 5);
    const StackDocument centred = read_form(rough_stack("centred"));
    CHECK(total_nm(centred.stack.elements) == 2 + 100 + 5 * 130 + 1.5);
    const std::vector<Layer> shifted = written_out(centred.stack.elements);
    CHECK(shifted[1].thickness_nm == 100 - 2 - 1);
    CHECK(shifted[3].thickness_nm == 49);
    CHECK(shifted[4].thickness_nm == 79);
    CHECK(shifted[shifted.size() - 2].thickness_nm == 80 - 1.5);
    const json canonical = canonical_stack(centred.stack);
    CHECK(canonical.dump().find("roughness, centred") != std::string::npos);
    CHECK(read_form(canonical).stack.elements.size() > 0);
    json smooth = rough_stack("added");
    smooth["layers"][0]["roughness_nm"] = 0;
    smooth["layers"][1]["layers"][0]["roughness_nm"] = 0;
    smooth["substrate_roughness_nm"] = 0;
    CHECK(written_out(read_form(smooth).stack.elements).size() == 11);
}

TEST_CASE("a group under another medium is written out as far as its faces differ", "[schemas]") {
    json document = rough_stack("added");
    document["layers"][0]["material"] = 1.7;
    const StackDocument read = read_form(document);
    const auto& all = std::get<Group>(read.stack.elements.at(1).value);
    CHECK(all.repeat == 1);
    REQUIRE(all.elements.size() == 2);
    CHECK(std::get<Group>(all.elements[1].value).repeat == 4);
    CHECK(written_out(read.stack.elements).size() == 18);
    document["roughness_placement"] = "centred";
    CHECK(std::get<Group>(read_form(document).stack.elements.at(1).value).elements.size() == 3);
}

TEST_CASE("a graded layer is a group of parts that count as one layer", "[schemas]") {
    const json graded{{"from", 1.5}, {"to", {{"n", 2.5}, {"k", 0.1}}}, {"profile", "inverse-n"}};
    const StackDocument read =
        read_form(one_layer({{"graded", graded}, {"thickness_nm", 150}, {"roughness_nm", 5}}));
    CHECK(count_listed_layers(read.stack.elements) == 2);
    CHECK(count_layers(read.stack.elements) > 20);
    CHECK_THAT(total_nm(read.stack.elements), WithinRel(155.0, 1e-14));
    const Stack back = reversed(read.stack);
    CHECK(count_listed_layers(back.elements) == 2);
    CHECK(listed_layers(back.elements).back() == 1);
    CHECK(listed_layers(back.elements).front() == 0);
    const json twice{{"repeat", 3},
                     {"layers",
                      {{{"graded", graded}, {"thickness_nm", 50}},
                       {{"graded", {{"from", 2.5}, {"to", 1.5}}}, {"thickness_nm", 50}}}}};
    const StackDocument repeated = read_form(one_layer(twice));
    CHECK(count_listed_layers(repeated.stack.elements) == 6);
    CHECK(listed_layers(repeated.stack.elements).back() == 5);
}

TEST_CASE("forms of layers that are refused", "[schemas][refused]") {
    struct Case {
        json document;
        std::string error;
    };
    const json at_550{{"reference_nm", 550}};
    const json crystal{{"ordinary", 1.5}, {"extraordinary", 1.6}};
    const json graded{{"from", 1.5}, {"to", 2}};
    const std::vector<Case> cases{
        {one_layer({{"material", 2}, {"qwot", 1}}),
         "f: /layers/0/qwot: requires the stack's reference_nm (or --reference NM)"},
        {one_layer({{"material", 2}, {"qwot", 1}, {"thickness_nm", 5}}, at_550),
         "f: /layers/0: must have either \"thickness_nm\" or \"qwot\""},
        {one_layer({{"material", 2}, {"qwot", -1}}, at_550),
         "f: /layers/0/qwot: must be in [0, 1e6] (got -1)"},
        {one_layer({{"material", {{"n", 1e-6}}}, {"qwot", 100}}, at_550),
         "f: /layers/0/qwot: must be a thickness in [0, 1e9] nm"},
        {one_layer({{"material", 2}, {"qwot", 1}}, {{"reference_nm", 0}}),
         "f: /reference_nm: must be in [1, 1e7] (got 0)"},
        {one_layer({{"material", "TiO2-rutile"}, {"qwot", 1}}, {{"reference_nm", 400}}),
         "f: /layers/0/qwot: TiO2-rutile is known from 430 to 1530 nm"},
        {one_layer({{"material", mixed(1, 2, 1.5, "linear")}, {"thickness_nm", 5}}),
         "f: /layers/0/material/mixture/fraction: must be in [0, 1] (got 1.5)"},
        {one_layer({{"material", mixed(1, 2, 0.5, "mean")}, {"thickness_nm", 5}}),
         "f: /layers/0/material/mixture/model: must be one of bruggeman, maxwell-garnett"},
        {one_layer({{"material", mixed(1, "Sio2", 0.5, "linear")}, {"thickness_nm", 5}}),
         "f: /layers/0/material/mixture/host: unknown material \"Sio2\" (did you mean"},
        {one_layer(
             {{"material", {{"mixture", {{"inclusion", 1}, {"host", 2}}}}}, {"thickness_nm", 5}}),
         "f: /layers/0/material/mixture: must have the key \"fraction\""},
    };
    for (const auto& [document, error] : cases) {
        INFO(document.dump());
        CHECK_THAT(refusal_of(document), Catch::StartsWith(error));
    }
    StackRequest request{"air | 2@1Q | 1", {}, {}};
    request.reference_nm = "x";
    CHECK_THROWS_WITH(
        read_stack(request),
        Catch::Contains("--reference: must be a wavelength in [1, 1e7] nm (got 'x')"));
}
