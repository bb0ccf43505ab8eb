#include "schemas/documents/canonical_stack.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "schemas/documents/stack_document.hpp"

using namespace irido;
using namespace irido::schemas;
using nlohmann::json;

namespace {

json canonical(const std::string& stack) {
    return canonical_stack(read_stack({stack, {}}).stack);
}

json canonical_of(const json& document) {
    return canonical_stack(read_stack(document, "test", IRIDO_SOURCE_DIR "/tests/data").stack);
}

}  // namespace

TEST_CASE("stacks of the same physics are written alike", "[canonical]") {
    const json plain = canonical("1 | 1.5@300 | 1.9+1.5i");
    const json wordy = {{"name", "wordy"},
                        {"comment", "c"},
                        {"incident", {{"n", 1}, {"k", 0}}},
                        {"layers",
                         {{{"repeat", 1},
                           {"layers",
                            {{{"material", {{"n", 1.5}, {"name", "resin"}}},
                              {"thickness_nm", 3e2},
                              {"thickness_sigma_nm", 0},
                              {"coherent", true}}}}}}},
                        {"substrate", {{"n", 1.9}, {"k", 1.5}}}};
    CHECK(canonical_of(wordy) == plain);
    CHECK(canonical_of(wordy).dump() == plain.dump());
    CHECK(plain == json::parse(R"({"incident": 1.0, "substrate": {"k": 1.5, "n": 1.9},
        "layers": [{"material": 1.5, "thickness_nm": 300.0}]})"));
    CHECK(canonical("1 | 1.5@301 | 1.9+1.5i") != plain);
}

TEST_CASE("built-in materials keep their names, those of files become numbers", "[canonical]") {
    const json built_in = canonical("air | (TiO2@58.5 | 1.46@94.2)^10 | BK7");
    CHECK(built_in["substrate"] == "BK7");
    CHECK(built_in["layers"][0]["layers"][0]["material"] == "TiO2");
    CHECK(built_in["layers"][0]["repeat"] == 10);
    const json file = canonical_of(
        {{"incident", 1}, {"layers", json::array()}, {"substrate", {{"file", "glass.csv"}}}});
    CHECK(file["substrate"].contains("table"));
    CHECK(file.dump().find("glass") == std::string::npos);
    // the name alone does not make a material a built-in one
    const json named = canonical_of({{"incident", 1},
                                     {"layers", json::array()},
                                     {"substrate", {{"cauchy", {1.5, 0.004}}, {"name", "BK7"}}}});
    CHECK(named["substrate"] == json::parse(R"({"cauchy": [1.5, 0.004]})"));
    const json held{{"name", "ITO"}, {"extrapolate", "clamp"}};
    CHECK(canonical_of(
              {{"incident", 1}, {"layers", json::array()}, {"substrate", held}})["substrate"] ==
          held);
}

TEST_CASE("canonical stacks of the examples read back as the same stacks", "[canonical]") {
    int read_back = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(IRIDO_SOURCE_DIR "/schemas/examples")) {
        if (entry.path().extension() != ".json") continue;
        CAPTURE(entry.path().string());
        const json once = canonical(entry.path().string());
        if (once.dump().find("\"formula\"") != std::string::npos) continue;  // not a document
        CHECK(canonical_of(once) == once);
        ++read_back;
    }
    CHECK(read_back > 20);
}
