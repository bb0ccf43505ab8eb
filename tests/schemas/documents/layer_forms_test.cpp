#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "schemas/documents/canonical_stack.hpp"
#include "schemas/documents/stack_document.hpp"
#include "schemas/input_error.hpp"

using namespace irido;
using namespace irido::schemas;
using Catch::WithinRel;
using nlohmann::json;

namespace {

StackDocument read_form(const json& document) {
    return read_stack(document, "f", std::string(IRIDO_SOURCE_DIR) + "/tests/data");
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

TEST_CASE("forms of layers that are refused", "[schemas][refused]") {
    struct Case {
        json document;
        std::string error;
    };
    const json at_550{{"reference_nm", 550}};
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
    CHECK_THROWS_WITH(read_stack(request),
                      Catch::Contains("--reference: must be a wavelength in [1, 1e7] nm (got x)"));
}
