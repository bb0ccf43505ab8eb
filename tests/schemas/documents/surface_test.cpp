#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "schemas/documents/surface_document.hpp"
#include "schemas/input_error.hpp"
#include "tests/support/program.hpp"

using namespace irido;
using namespace irido::schemas;
using namespace irido::test;
using nlohmann::json;

namespace {

LayeredSurface read(const std::string& text, const std::string& folder = "") {
    return std::get<LayeredSurface>(read_surface(json::parse(text), "s.json", folder).surface);
}

std::string error_of(const std::string& text) {
    try {
        read(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a surface document", "[schemas][surface]") {
    const LayeredSurface surface = read(R"({
        "$schema": "surface.schema.json", "name": "all keys", "comment": "none left out",
        "outside": 1, "inside": 1.35,
        "layers": [ { "name": "top", "comment": "first", "alpha": 0.1,
                      "stack": "1.35 | (1.35@250 | 1.5@250)^10 | 1.35" },
                    { "alpha": 1, "stack": { "incident": 1.35, "substrate": 1.35, "layers": [] } } ],
        "base": { "comment": "pale", "albedo": [[400, 0.2], [700, 0.8]] } })");
    REQUIRE(surface.layers.size() == 2);
    CHECK(surface.is_coated());
    CHECK(surface.layers[0].alpha == 0.1);
    CHECK(surface.layers[0].is_passable);
    CHECK(std::get<Table>(surface.base_albedo).value == std::vector<double>{0.2, 0.8});

    const LayeredSurface bare = read(R"({"layers": [{"stack": "1 | 1.5@100 | 2", "alpha": 0.5}]})");
    CHECK_FALSE(bare.is_coated());
    CHECK_FALSE(bare.layers[0].is_passable);
    CHECK(std::get<Constant>(bare.base_albedo).value == 0);
    CHECK(read(R"({"inside": "water", "outside": "water", "layers": [
                  {"stack": "water | 1.5@100 | water", "alpha": 0.5}]})")
              .layers[0]
              .is_passable);
    CHECK(read(R"({"base": {"albedo": 1}})").layers.empty());
}

TEST_CASE("stacks of layers are files relative to the surface", "[schemas][surface]") {
    const LayeredSurface surface =
        read(R"({"layers": [{"stack": "../jewel-beetle-green.json", "alpha": 0.1}]})",
             IRIDO_SOURCE_DIR "/schemas/examples/surfaces");
    CHECK(surface.layers[0].stack.elements.size() == 1);
}

TEST_CASE("surfaces that cannot be are refused", "[schemas][surface]") {
    using Catch::Contains;
    const std::string film = R"({"stack": "1 | 1.5@100 | 1", "alpha": 0.1})";
    const auto check = [](const std::string& text, const std::string& what) {
        CHECK_THAT(error_of(text), Contains(what));
    };
    check("{}", "s.json: must have the key \"layers\"");
    check(R"({"layers": []})", "/layers: must have a layer where there is no base");
    check(R"({"layers": [{"stack": "1 | 1.5@100 | 1", "alpha": 5e-5}]})",
          "/layers/0/alpha: must be in [1e-4, 1] (got 5e-05)");
    check(R"({"layers": [{"stack": "1 | 1.5@100 | 1"}]})",
          "/layers/0: must have the key \"alpha\"");
    check(R"({"layers": [{"stack": "1 | 1.5@100 | 1", "alhpa": 0.1}]})", "did you mean \"alpha\"?");
    check(R"({"layers": [{"stack": "1 | 1.5@100 | 2", "alpha": 0.1}], "base": {"albedo": 0.5}})",
          "/base: is not seen: the substrate of layer 0 must be the medium inside, 1 (got 2)");
    check(R"({"layers": [{"stack": "1 | 1.5@100 | 2", "alpha": 0.1}, )" + film + "]}",
          "/layers/1: is not seen");
    check(R"({"inside": 1.5, "layers": [)" + film + "]}",
          "/layers/0/stack: its incident medium must be the one inside the surface, 1.5 (got 1)");
    check(R"({"inside": "SiO2", "layers": [{"stack": "SiO2 | 2@100 | SiO2", "alpha": 0.1}]})",
          "/inside: must be constant where \"inside\" is not \"outside\"");
    check(R"({"inside": "Agg", "layers": []})", "/inside: unknown material");
    check(R"({"outside": {"n": 1, "k": 1}, "base": {"albedo": 1}})",
          "/outside: must be transparent");
    check(R"({"base": {"albedo": 1.5}})", "/base/albedo: must be in [0, 1]");
    check(R"({"base": {"albedo": [[500, 0.5], [400, 0.2]]}})", "/base/albedo/1/0: must be above");
    check(R"({"layers": [{"stack": "1 | 1.5@ | 1", "alpha": 0.1}]})", "/layers/0/stack: ");
    check(R"({"layers": [{"stack": {"incident": 1, "layers": 3, "substrate": 1}, "alpha": 0.1}]})",
          "/layers/0/stack/layers: must be an array");
}
