#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/material/library.hpp"
#include "schemas/documents/stack_document.hpp"
#include "schemas/input_error.hpp"

using namespace irido;
using namespace irido::schemas;
using nlohmann::json;

namespace {

const std::string kRoot = IRIDO_SOURCE_DIR;

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

std::vector<std::filesystem::path> json_files(const std::string& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(kRoot + folder)) {
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string without(std::string text, const std::string& part) {
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part)) {
        text.erase(at, part.size());
    }
    return text;
}

StackDocument read(const json& document) {
    return read_stack(document, "f", kRoot + "/tests/data");
}

std::string error_of(const json& document) {
    try {
        read(document);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

json document(const json& layers) {
    return {{"incident", "air"}, {"layers", layers}, {"substrate", "air"}};
}

json film(const json& material) {
    return document(json::array({{{"material", material}, {"thickness_nm", 1}}}));
}

/// The material of the only layer.
Material material_of(const json& material) {
    const StackDocument result = read(film(material));
    return result.stack.materials[std::get<Layer>(result.stack.elements[0].value).material];
}

}  // namespace

TEST_CASE("Every illegal file is refused for its one fault") {
    const std::vector<std::filesystem::path> files = json_files("/tests/data/illegal");
    CHECK(files.size() >= 35);
    for (const std::filesystem::path& file : files) {
        CAPTURE(file.filename());
        const std::string expected = text_of(std::filesystem::path(file).replace_extension(".txt"));
        const std::vector<std::string> lines = validate_stack_file(file.string());
        REQUIRE(lines.size() == 1);
        CHECK(without(lines[0], file.parent_path().string() + "/") + "\n" == expected);
        try {
            read_stack(StackRequest{file.string(), {}});
            FAIL("accepted");
        } catch (const InputError& error) {
            CHECK(error.what() == lines[0]);
        }
    }
}

TEST_CASE("Every example can be used and names its schema and its source") {
    const std::vector<std::filesystem::path> files = json_files("/schemas/examples");
    CHECK(files.size() >= 28);
    for (const std::filesystem::path& file : files) {
        CAPTURE(file.filename());
        CHECK(validate_stack_file(file.string()) == std::vector<std::string>{});
        const StackSource source = load_stack({file.string(), {}});
        CHECK(source.document.value("$schema", "") == "../stack.schema.json");
        CHECK(source.document.value("comment", "").size() > 40);
        const StackDocument result = read_stack(source.document, source.file, source.folder);
        CHECK(!result.name.empty());
        CHECK(!result.stack.elements.empty());
        for (const Material& material : result.stack.materials) {
            for (const double wavelength_nm : {400., 550., 700.}) {
                CHECK_NOTHROW(index_at(material, wavelength_nm));
            }
        }
    }
}

TEST_CASE("A document becomes a stack of plain values") {
    const StackDocument result =
        read({{"name", "test"},
              {"incident", 1},
              {"layers",
               {{{"repeat", 1e9},
                 {"layers",
                  {{{"material", 1.5}, {"thickness_nm", 100}},
                   {{"repeat", 2}, {"layers", {{{"material", 2}, {"thickness_nm", 5}}}}}}}},
                {{"material", {{"n", 1.5}}},
                 {"thickness_nm", 1e6},
                 {"thickness_sigma_nm", 3},
                 {"coherent", false}}}},
              {"substrate", {{"n", 0.2}, {"k", 3.5}}}});
    CHECK(result.name == "test");
    CHECK(result.notes.empty());
    REQUIRE(result.stack.materials.size() == 4);
    CHECK(result.material_pointers ==
          std::vector<std::string>{"/incident", "/layers/0/layers/0/material",
                                   "/layers/0/layers/1/layers/0/material", "/substrate"});
    CHECK(result.stack.materials[3].name == "0.2+3.5i");
    CHECK(index_at(result.stack.materials[3], 500) == Complex(0.2, 3.5));
    const Group inner{2, {Element{Layer{2, 5, 0, true}}}};
    const Group outer{1000000000, {Element{Layer{1, 100, 0, true}}, Element{inner}}};
    const std::vector<Element> expected{Element{outer}, Element{Layer{1, 1e6, 3, false}}};
    CHECK(result.stack.elements == expected);
    CHECK(result.stack.incident == 0);
    CHECK(result.stack.substrate == 3);
}

TEST_CASE("A file and its expression are the same stack") {
    const json written = document(
        json::array({{{"repeat", 10},
                      {"layers",
                       {{{"material", "TiO2"}, {"thickness_nm", 58.5}},
                        {{"material", {{"n", 1.9}, {"k", 1.5}}}, {"thickness_nm", 94.2}}}}}}));
    CHECK(read_stack(StackRequest{"air | (TiO2@58.5 | 1.9+1.5i@94.2)^10 | air", {}}).stack ==
          read(written).stack);
}

TEST_CASE("Materials are one if their physics is, whatever their names") {
    const auto materials_of = [](const std::vector<json>& materials) {
        json layers = json::array();
        for (const json& m : materials) layers.push_back({{"material", m}, {"thickness_nm", 1}});
        return read(document(layers)).stack.materials.size() - 1;  // not counting the air around
    };
    CHECK(materials_of({1.5, {{"n", 1.5}}, {{"n", 1.5}, {"k", 0}}, {{"n", 1.5}, {"name", "a"}}}) ==
          1);
    CHECK(materials_of({"SiO2", "fused-silica", "SiO2"}) == 1);
    CHECK(materials_of({1.5, {{"n", 1.5}, {"k", 1e-9}}, {{"cauchy", {1.5}}}}) == 3);
    const json table{{"table", {{400, 1.5}, {700, 1.4}}}};
    json clamped = table;
    clamped["extrapolate"] = "clamp";
    CHECK(materials_of({table, clamped, table}) == 2);
}

TEST_CASE("Models have the coefficients that their formulas need") {
    CHECK(std::get<RefractiveIndex>(material_of({{"cauchy", {1.5, 0.004, 0.0001}}}).model).n ==
          Dispersion{Formula{5, {1.5, 0.004, -2, 0.0001, -4}, kAllWavelengths}});
    CHECK(std::get<RefractiveIndex>(material_of({{"sellmeier", {{1.1, 0.01}, {0.2, 100}}}}).model)
              .n == Dispersion{Formula{2, {0, 1.1, 0.01, 0.2, 100}, kAllWavelengths}});
    const LorentzDrude metal{1.5, 9, {{0.8, 0.05, 0}, {0.1, 3, 0.8}}, kAllWavelengths};
    CHECK(std::get<LorentzDrude>(material_of({{"lorentz_drude",
                                               {{"plasma_ev", 9},
                                                {"eps_infinity", 1.5},
                                                {"oscillators", {{0.8, 0.05, 0}, {0.1, 3, 0.8}}}}}})
                                     .model) == metal);
    const RefractiveIndex table{Table{{400, 700}, {1.5, 1.4}}, Table{{400, 700}, {0, 0.1}}};
    CHECK(std::get<RefractiveIndex>(
              material_of({{"table", {{400, 1.5, 0}, {700, 1.4, 0.1}}}}).model) == table);
    // a row without k leaves it unknown
    const json gap{{"table", {{400, 1.5, 0.2}, {500, 1.5}, {600, 1.5, 0.4}, {700, 1.4}}}};
    CHECK(index_at(material_of(gap), 500).imag() == Approx(0.3).epsilon(1e-15));
    CHECK(range_of(material_of(gap)) == WavelengthRange{400, 600});
    const RefractiveIndex real{Table{{400, 700}, {1.5, 1.4}}, Constant{0}};
    CHECK(std::get<RefractiveIndex>(material_of({{"table", {{400, 1.5}, {700, 1.4}}}}).model) ==
          real);

    // Cauchy and Sellmeier at 0.5 um, written out; both sums are exact to a few units of rounding.
    CHECK(index_at(material_of({{"cauchy", {1.5, 0.004, 0.0001}}}), 500).real() ==
          Approx(1.5 + 0.004 / 0.25 + 0.0001 / 0.0625).epsilon(1e-15));
    CHECK(index_at(material_of({{"sellmeier", {{1.1, 0.01}}}}), 500).real() ==
          Approx(std::sqrt(1 + 1.1 * 0.25 / (0.25 - 0.01))).epsilon(1e-15));
}

TEST_CASE("Materials come by name and from files") {
    const Material water = material_of("water");
    CHECK(water == find_material("water")->material);
    const Material glass = material_of({{"file", "glass.csv"}, {"extrapolate", "clamp"}});
    CHECK(index_at(glass, 380).real() == 1.53);
    CHECK(index_at(glass, 1000).real() == 1.51);
    CHECK(material_of({{"file", "glass.csv"}, {"name", "my glass"}}).name == "my glass");
    CHECK(material_of({{"n", 1.5}, {"name", "my glass"}}).name == "my glass");
    CHECK(error_of(film({{"file", "illegal/not-json.json"}})) ==
          "f: /layers/0/material/file: must end in .csv, .txt, .tsv, .dat, .nk, .mat, .yml or "
          ".yaml (got "
          "\"illegal/not-json.json\")");
}

TEST_CASE("The incident medium is lossless, indices do not vanish, layers are bounded") {
    json absorbing = film(1.5);
    absorbing["incident"] = {{"n", 1.5}, {"k", -0.1}};
    CHECK(error_of(absorbing) == "f: /incident: must be transparent, |k| below 1e-3 (got -0.1)");
    json nearly = film(1.5);
    nearly["incident"] = {{"n", 1.5}, {"k", 5e-4}};
    CHECK(read(nearly).notes ==
          std::vector<std::string>{"f: /incident: the incident medium is taken as transparent: its "
                                   "k of up to 5e-04 is ignored"});
    nearly["incident"] = "Ag";  // checked at the requested wavelengths
    CHECK(error_of(nearly) == "accepted");
    CHECK(error_of(film({{"n", 1e-7}, {"k", 0}})) ==
          "f: /layers/0/material: must be at least 1e-6 in size (got {\"k\":0,\"n\":1e-07})");
    for (const json& nothing :
         {json(0), json(0.9e-6), json{{"n", 0}}, json{{"n", 0}, {"k", -1e-7}}})
        CHECK_THAT(error_of(film(nothing)),
                   Catch::StartsWith("f: /layers/0/material: must be at least 1e-6 in size"));
    CHECK_THAT(error_of(film({{"table", json::array({{400, 1}, {500, 0, 0}})}})),
               Catch::StartsWith(
                   "f: /layers/0/material/table/1: must have an index of at least 1e-6 in size"));
    CHECK(error_of(film({{"table", json::array({{400, 0, 1}, {500, 1e-6}})}})) == "accepted");
    CHECK(error_of(film(1e-6)) == "accepted");
    CHECK(error_of(film({{"n", 0}, {"k", 1e-6}})) == "accepted");
}

TEST_CASE("A stack names its own media") {
    json named = film("H");
    named["materials"] = {{"H", 2.35}, {"L", "SiO2"}, {"water", {{"file", "glass.csv"}}}};
    named["layers"].push_back({{"material", "L"}, {"thickness_nm", 5}});
    named["layers"].push_back({{"material", "water"}, {"thickness_nm", 6}});
    named["substrate"] = {{"name", "L"}, {"extrapolate", "clamp"}};
    json plain = film(2.35);
    plain["layers"].push_back({{"material", "SiO2"}, {"thickness_nm", 5}});
    plain["layers"].push_back({{"material", {{"file", "glass.csv"}}}, {"thickness_nm", 6}});
    plain["substrate"] = {{"name", "SiO2"}, {"extrapolate", "clamp"}};
    const auto read = [](const json& document) {
        return read_stack(document, "f", kRoot + "/tests/data").stack;
    };
    CHECK(read(named) == read(plain));
    // names do not refer to other names, so there are no cycles
    named["materials"]["L"] = "H";
    CHECK(error_of(named) == "f: /materials/L: unknown material \"H\" (did you mean \"Hg\"?)");
    named["materials"]["L"] = -1;
    CHECK_THAT(error_of(named), Catch::StartsWith("f: /materials/L: must be a real index"));
    named["materials"] = {{"High", 2}};
    CHECK_THAT(error_of(named), Catch::Contains("/layers/0/material: unknown material \"H\""));
    named["materials"] = 5;
    CHECK_THAT(error_of(named), Catch::Contains("f: /materials: must be an object"));
}

TEST_CASE("The option --material names media of an expression") {
    CHECK(read_stack({"1 | (H@50 | L@60)^3 | 1", {}, {"H=2.35", "L=1.46+0.1j"}}).stack ==
          read_stack({"1 | (2.35@50 | 1.46+0.1i@60)^3 | 1", {}}).stack);
    CHECK(read_stack({"1 | H@50 | 1", {"materials.H=BK7"}, {"H=2.35"}}).stack ==
          read_stack({"1 | BK7@50 | 1", {}}).stack);
    CHECK_THROWS_WITH(read_stack({"1 | H@50 | 1", {}, {"H"}}),
                      "--material: must be NAME=MATERIAL, as in H=2.35 (got \"H\")");
    CHECK_THROWS_WITH(read_stack({"1 | H@50 | 1", {}, {"H={"}}),
                      Catch::StartsWith("--material H={"));
}

TEST_CASE("The name of a built-in material can be held outside of its range") {
    const Material held = material_of({{"name", "ITO"}, {"extrapolate", "clamp"}});
    CHECK(held.outside == Outside::clamp);
    CHECK(held.model == find_material("ITO")->material.model);
    CHECK(index_at(held, 1e7) == index_at(held, range_of(held).last_nm));
    CHECK_THAT(error_of(film({{"name", "my glass"}, {"extrapolate", "clamp"}})),
               Catch::StartsWith("f: /layers/0/material/name: unknown material"));
    for (const json& nothing : {json{{"name", "ITO"}}, json{{"extrapolate", "clamp"}}})
        CHECK_THAT(error_of(film(nothing)), Catch::Contains("must have exactly one of"));
}

TEST_CASE("A name that ends as a material file is one") {
    CHECK(material_of("glass.csv") == material_of({{"file", "glass.csv"}}));
    CHECK(material_of({{"name", "glass.csv"}, {"extrapolate", "clamp"}}).model ==
          material_of("glass.csv").model);
    CHECK_THAT(error_of(film("none.csv")), Catch::StartsWith("f: /layers/0/material: ") &&
                                               Catch::Contains("none.csv: cannot be read"));
    const std::string folder = kRoot + "/tests/data/";
    const std::string text = "1 | " + folder + "glass.csv@5 | 1";
    CHECK(read_stack({text, {}}).stack.materials.size() == 2);
    CHECK(read_stack({"1 | 2@5 | 1", {"layers.0.material=" + folder + "glass.csv"}}).stack ==
          read_stack({text, {}}).stack);
}

TEST_CASE("Files of a document are named as seen from another folder") {
    json document = film({{"file", "glass.csv"}});
    document["incident"] = "own.csv";
    document["substrate"] = "../x.yml";
    document["materials"] = {{"own.csv", 1}, {"H", "/abs/h.csv"}, {"L", "l.csv"}};
    document["layers"].push_back(
        {{"repeat", 2}, {"layers", {{{"material", "g.csv"}, {"thickness_nm", 1}}}}});
    irido::schemas::move_files(document, "a/b", "a/c");
    CHECK(document["layers"][0]["material"]["file"] == "../b/glass.csv");
    CHECK(document["layers"][1]["layers"][0]["material"] == "../b/g.csv");
    CHECK(document["substrate"] == "../x.yml");
    CHECK(document["incident"] == "own.csv");
    CHECK(document["materials"] == json{{"own.csv", 1}, {"H", "/abs/h.csv"}, {"L", "../b/l.csv"}});
}

TEST_CASE("A request is a file or an expression, then the values that it sets") {
    const StackDocument result =
        read_stack(StackRequest{kRoot + "/schemas/examples/soap-bubble.json",
                                {"layers.0.thickness_nm=500", "substrate=1.9+1.5i"}});
    CHECK(std::get<Layer>(result.stack.elements[0].value).thickness_nm == 500);
    CHECK(index_at(result.stack.materials[result.stack.substrate], 500) == Complex(1.9, 1.5));
    const auto request_error = [](const StackRequest& request) -> std::string {
        try {
            read_stack(request);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    CHECK(request_error({"no/such.json", {}}) ==
          "no/such.json: cannot be read: No such file or directory");
    CHECK(request_error({"air | 1.33@-5 | air", {}}) ==
          "\"air | 1.33@-5 | air\": /layers/0/thickness_nm: must be in [0, 1e9] (got -5)");
    CHECK(request_error({"air | 1.33@5 | air", {"layers.0.thicknes_nm=3"}}) ==
          "\"air | 1.33@5 | air\": /layers/0/thicknes_nm: unknown key (did you mean "
          "\"thickness_nm\"?)");
    CHECK(request_error({"air | 1.33@5 | air", {"layers.0.thickness_nm=420nm"}}) ==
          "\"air | 1.33@5 | air\": /layers/0/thickness_nm: must be a number in [0, 1e9] (got "
          "\"420nm\")");
    CHECK(request_error({kRoot, {}}) == kRoot + ": cannot be read: Is a directory");
}

TEST_CASE("validate lists what the schema and what the reader finds") {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "irido-faults.json";
    std::ofstream(file) << R"({"incident": {"n": 1, "k": 1}, "substrate": "airr", "layers": [
        {"material": "watr", "thickness_nm": -1}, {"material": {"nn": 1}, "thickness_nm": 1}, 5,
        {"repeat": 2, "layers": [{"material": {"file": "none.csv"}, "thickness_nm": 1}]}]})";
    const std::string f = file.string() + ": ";
    const std::vector<std::string> expected{
        f + "/layers/0/thickness_nm: must be in [0, 1e9] (got -1)",
        f + "/layers/1/material/nn: unknown key (did you mean \"n\"?)",
        f + "/layers/2: must be a layer {\"material\", \"thickness_nm\"} or a group {\"repeat\", "
            "\"layers\"} (got 5)",
        f + "/incident: must be transparent, |k| below 1e-3 (got 1)",
        f + "/layers/0/material: unknown material \"watr\" (did you mean \"water\"?)",
        f + "/layers/3/layers/0/material/file: " + (file.parent_path() / "none.csv").string() +
            ": cannot be read: No such file or directory",
        f + "/substrate: unknown material \"airr\" (did you mean \"air\"?)"};
    CHECK(validate_stack_file(file.string()) == expected);
    std::filesystem::remove(file);
}

TEST_CASE("A hundred thousand layers, each of its own material, are read in about a second",
          "[slow]") {
    json layers = json::array();
    for (int i = 0; i < 100000; ++i) {
        layers.push_back({{"material", 1.3 + 1e-6 * i}, {"thickness_nm", i}});
    }
    const auto start = std::chrono::steady_clock::now();
    CHECK(read(document(layers)).stack.materials.size() == 100001);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    CHECK(seconds.count() < 30);  // quadratic time would take minutes, sanitizers ten times longer
}
