#include "schemas/documents/gltf_document.hpp"

#include <catch2/catch.hpp>
#include <cstdint>

#include "schemas/input_error.hpp"

using namespace irido::schemas;
using Catch::WithinAbs;

namespace {

const std::string kAsset = R"({
  "asset": {"version": "2.0"},
  "materials": [
    {"name": "plain"},
    {"name": "metal",
     "pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.8, 0.7, 1]},
     "extensions": {"KHR_materials_iridescence": {"iridescenceFactor": 1, "iridescenceIor": 1.8,
                                                  "iridescenceThicknessMaximum": 250}}},
    {"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorTexture": {"index": 0}},
     "extensions": {"KHR_materials_ior": {"ior": 1.4},
                    "KHR_materials_specular": {"specularFactor": 0.5,
                                               "specularColorFactor": [1, 0.5, 0]},
                    "KHR_materials_iridescence": {"iridescenceThicknessTexture": {"index": 1}}}}
  ]})";

void append_word(std::string& out, std::uint32_t word) {
    for (int i = 0; i < 4; ++i) out += static_cast<char>(word >> 8 * i & 0xFFU);
}

/// A binary file with the JSON chunk followed by one of bytes.
std::string binary(std::string json, std::uint32_t version = 2, std::uint32_t type = 0x4E4F534A) {
    while (json.size() % 4 != 0) json += ' ';
    std::string out = "glTF";
    append_word(out, version);
    append_word(out, static_cast<std::uint32_t>(12 + 8 + json.size() + 12));
    append_word(out, static_cast<std::uint32_t>(json.size()));
    append_word(out, type);
    out += json;
    append_word(out, 4);
    append_word(out, 0x004E4942);
    return out + "abcd";
}

std::string fault(const std::string& bytes) {
    try {
        read_gltf(bytes, "a.gltf");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

std::string with(const std::string& material) {
    return R"({"asset": {"version": "2.0"}, "materials": [)" + material + "]}";
}

}  // namespace

TEST_CASE("iridescent materials of glTF assets", "[schemas]") {
    for (const std::string& bytes : {kAsset, binary(kAsset)}) {
        const auto found = read_gltf(bytes, "a.gltf");
        REQUIRE(found.size() == 2);
        CHECK(found[0].name == "metal");
        CHECK(found[0].base_f0 == std::array{0.9, 0.8, 0.7});
        CHECK(found[0].factor == 1);
        CHECK(found[0].film_n == 1.8);
        CHECK(found[0].thinnest_nm == 250);
        CHECK(found[0].thickest_nm == 250);
        CHECK(found[0].textures.empty());
        CHECK(found[1].name == "material 2");
        const double f0 = 0.4 * 0.4 / (2.4 * 2.4);
        CHECK_THAT(found[1].base_f0[0], WithinAbs(0.5 * f0, 1e-16));
        CHECK_THAT(found[1].base_f0[1], WithinAbs(0.25 * f0, 1e-16));
        CHECK(found[1].base_f0[2] == 0);
        CHECK(found[1].factor == 0);
        CHECK(found[1].film_n == 1.3);
        CHECK(found[1].thinnest_nm == 100);
        CHECK(found[1].thickest_nm == 400);
        CHECK(found[1].textures == std::vector<std::string>{"baseColorTexture"});
    }
    CHECK(read_gltf(R"({"asset": {"version": "2.0"}})", "a.gltf").empty());
    // an index of 0 means a mirror
    const auto mirror = read_gltf(with(R"({"pbrMetallicRoughness": {"metallicFactor": 0},
        "extensions": {"KHR_materials_ior": {"ior": 0}, "KHR_materials_iridescence": {}}})"),
                                  "a.gltf");
    CHECK(mirror[0].base_f0 == std::array{1.0, 1.0, 1.0});
}

TEST_CASE("broken glTF assets are refused", "[schemas]") {
    const auto film = [](const std::string& members) {
        return with(R"({"extensions": {"KHR_materials_iridescence": {)" + members + "}}}");
    };
    CHECK(fault(film(R"("iridescenceIor": 0.5)")) ==
          "a.gltf: /materials/0/extensions/KHR_materials_iridescence/iridescenceIor: must be in "
          "[1, 10000] (got 0.5)");
    CHECK(fault(film(R"("iridescenceFactor": "all")")) ==
          "a.gltf: /materials/0/extensions/KHR_materials_iridescence/iridescenceFactor: must be a "
          "number (got \"all\")");
    CHECK(fault(film(R"("iridescenceThicknessMaximum": -1)")).find("must be in [0, 1e+09]") !=
          std::string::npos);
    CHECK(fault(with("7")) == "a.gltf: /materials/0: must be an object (got 7)");
    CHECK(fault(with(R"({"extensions": []})")) ==
          "a.gltf: /materials/0/extensions: must be an object (got [])");
    CHECK(fault(with(R"({"pbrMetallicRoughness": {"baseColorFactor": [1, 1]},
                         "extensions": {"KHR_materials_iridescence": {}}})"))
              .find("/baseColorFactor: must be 4 numbers") != std::string::npos);
    CHECK(fault(R"({"asset": {"version": "1.0"}})") ==
          "a.gltf: /asset/version: must be 2.x (got \"1.0\")");
    CHECK(fault("{}") == "a.gltf: /asset/version: must be 2.x (got \"\")");
    CHECK(fault("[]").find("must be an object") != std::string::npos);
    CHECK(fault(R"({"asset": {"version": "2.0"}, "materials": {}})") ==
          "a.gltf: /materials: must be an array (got {})");
    CHECK(fault("{").starts_with("a.gltf: 1:"));
    const std::string whole = binary(kAsset);
    CHECK(fault(whole.substr(0, 16)) == "a.gltf: not a binary glTF file: truncated");
    CHECK(fault(whole.substr(0, 60)) == "a.gltf: not a binary glTF file: truncated");
    CHECK(fault(binary(kAsset, 1)) == "a.gltf: not a binary glTF file: its version is 1, not 2");
    CHECK(fault(binary(kAsset, 2, 7)) ==
          "a.gltf: not a binary glTF file: its first chunk is not JSON");
}
