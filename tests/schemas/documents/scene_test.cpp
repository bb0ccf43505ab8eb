#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "schemas/documents/scene_document.hpp"
#include "schemas/documents/schema_check.hpp"
#include "schemas/input_error.hpp"
#include "tests/support/program.hpp"

using namespace irido;
using namespace irido::schemas;
using namespace irido::test;
using nlohmann::json;

namespace {

/// A scene that uses every key.
json complete_scene() {
    return json::parse(R"({
        "$schema": "scene.schema.json",
        "name": "Complete",
        "comment": "Every key.",
        "space": "rec2020",
        "illuminant": "A",
        "observer": 10,
        "adaptation": "none",
        "tolerance": { "delta_e": 1, "relative": 0.01 },
        "format": "exr",
        "dtype": "f32",
        "lights": [ { "name": "lamp", "comment": "Or the sun.", "diameter_deg": [0.5, 4] } ],
        "materials": [ {
            "name": "film",
            "comment": "A film.",
            "stack": { "incident": 1,
                       "layers": [ { "material": 1.33, "thickness_nm": 400 } ],
                       "substrate": 1.5 },
            "vary": { "layers.0.thickness_nm": [100, 900] },
            "angles_deg": [0, 80],
            "roughness": [0.1, 0.2],
            "transmission": true,
            "thickness_spread_nm": 5,
            "shading": "fourier"
        }, {
            "name": "metal",
            "surface": { "base": "1 | Ag", "scratches": [
                { "width_um": 1, "depth_um": 0.2, "angle_deg": 10, "point_um": [50, 30] } ] },
            "extent_um": [300, 200],
            "footprint_um": 40
        } ]
    })");
}

/// The error of read_scene() for a scene file, or the first fault of a material.
std::string error_of(const json& document) {
    const TemporaryFolder folder;
    write_text(folder / "scene.json", document.dump());
    try {
        const Scene scene = read_scene(folder / "scene.json");
        for (const SceneMaterial& material : scene.materials)
            for (const SceneFault& fault : material.faults)
                return fault.pointer + ": " + fault.reason;
    } catch (const InputError& error) {
        const std::string text = error.what();
        REQUIRE(text.starts_with(folder / "scene.json: "));
        return text.substr((folder / "scene.json: ").size());
    }
    return "";
}

/// The same for the complete scene with one value replaced.
std::string error_with(const std::string& pointer, const json& value) {
    json document = complete_scene();
    document[json::json_pointer(pointer)] = value;
    return error_of(document);
}

std::string error_without(const std::string& pointer) {
    const json::json_pointer place(pointer);
    json document = complete_scene();
    document[place.parent_pointer()].erase(place.back());
    return error_of(document);
}

void collect_keys(const json& node, std::set<std::string>& keys) {
    if (!node.is_structured()) return;
    if (node.is_object() && node.contains("properties"))
        for (const auto& member : node["properties"].items()) keys.insert(member.key());
    for (const json& child : node) collect_keys(child, keys);
}

}  // namespace

TEST_CASE("a scene that uses every key is read", "[scene]") {
    const json document = complete_scene();
    std::set<std::string> keys;
    collect_keys(json::parse(scene_schema_text()), keys);
    for (const std::string& key : keys) {
        INFO(key);
        CHECK(document.dump().find("\"" + key + "\":") != std::string::npos);
    }
    const TemporaryFolder folder;
    write_text(folder / "scene.json", document.dump());
    const Scene scene = read_scene(folder / "scene.json");
    CHECK(scene.name == "Complete");
    CHECK(scene.space == "rec2020");
    CHECK(scene.illuminant == "A");
    CHECK(scene.observer_deg == 10);
    CHECK(scene.adaptation == "none");
    CHECK(scene.delta_e == 1);
    CHECK(scene.relative == 0.01);
    CHECK(scene.format == "exr");
    CHECK(scene.type == "f32");
    REQUIRE(scene.lights.size() == 1);
    CHECK(scene.lights[0].diameter_deg.last == 4);
    REQUIRE(scene.materials.size() == 2);
    const SceneMaterial& metal = scene.materials[1];
    CHECK(metal.shading == Shading::scratches);
    REQUIRE(metal.scratches);
    CHECK(metal.scratches->surface.scratches.size() == 1);
    CHECK(metal.scratches->extent_um[1] == 200);
    CHECK(metal.scratches->footprint_um == 40);
    CHECK(metal.document.stack.materials.size() == 2);
    const SceneMaterial& film = scene.materials[0];
    CHECK(film.name == "film");
    CHECK(film.shading == Shading::fourier);
    CHECK(film.angles_deg.last == 80);
    CHECK(film.is_rough);
    CHECK(film.alpha.first == 0.1);
    CHECK(film.transmission);
    CHECK(film.thickness_spread_nm == 5);
    REQUIRE(film.vary.size() == 1);
    CHECK(film.vary[0].path == "layers.0.thickness_nm");
    CHECK(film.vary[0].range.last == 900);
    // the stack has the first values
    CHECK(std::get<Layer>(film.document.stack.elements[0].value).thickness_nm == 100);
}

TEST_CASE("what a scene leaves out has the schema's defaults", "[scene]") {
    const TemporaryFolder folder;
    write_text(folder / "scene.json",
               R"({"materials": [{"name": "a", "stack": "1 | 1.33@9 | 1", "shading": "color"}]})");
    const Scene scene = read_scene(folder / "scene.json");
    const json properties = json::parse(scene_schema_text())["properties"];
    CHECK(scene.space == properties["space"]["default"]);
    CHECK(scene.illuminant == properties["illuminant"]["default"]);
    CHECK(scene.observer_deg == properties["observer"]["default"]);
    CHECK(scene.adaptation == properties["adaptation"]["default"]);
    CHECK(scene.delta_e == properties["tolerance"]["properties"]["delta_e"]["default"]);
    CHECK(scene.relative == properties["tolerance"]["properties"]["relative"]["default"]);
    CHECK(scene.format == properties["format"]["default"]);
    CHECK(scene.type == properties["dtype"]["default"]);
    CHECK(scene.materials[0].angles_deg.first == 0);
    CHECK(scene.materials[0].angles_deg.last == 90);
    CHECK(!scene.materials[0].is_rough);
    CHECK(!scene.materials[0].transmission);
}

TEST_CASE("every rule of the scene schema is refused with its place and value", "[scene]") {
    struct Fault {
        std::string pointer;
        json value;
        std::string message;
    };
    const std::string m = "/materials/0";
    const std::vector<Fault> faults{
        {"/space", "srgbb",
         "/space: must be one of srgb, rec2020, display-p3, acescg, xyz "
         "(got \"srgbb\") (did you mean \"srgb\"?)"},
        {"/illuminant", "D55",
         "/illuminant: must be one of D65, D50, A, E, FL2, FL11 "
         "(got \"D55\") (did you mean \"D65\"?)"},
        {"/observer", 4, "/observer: must be 2 or 10 (got 4)"},
        {"/adaptation", true, "/adaptation: must be one of bradford, none (got true)"},
        {"/tolerance", 0.5,
         "/tolerance: must be an object with \"delta_e\" and \"relative\" (got 0.5)"},
        {"/tolerance/delta_e", 0, "/tolerance/delta_e: must be in [1e-4, 100] (got 0)"},
        {"/tolerance/delta_e", "small",
         "/tolerance/delta_e: must be a number in [1e-4, 100] (got \"small\")"},
        {"/tolerance/relative", 2, "/tolerance/relative: must be in [1e-9, 1] (got 2)"},
        {"/format", "png", "/format: must be one of ktx2, exr, npy, bin, csv (got \"png\")"},
        {"/dtype", "u8", "/dtype: must be one of f16, f32, f64 (got \"u8\")"},
        {"/name", 1, "/name: must be text (got 1)"},
        {"/materials", json::array(),
         "/materials: must be an array of 1 to 10000 materials "
         "(got [])"},
        {"/materials", "all",
         "/materials: must be an array of 1 to 10000 materials "
         "(got \"all\")"},
        {m, 1,
         m + ": must be an object with \"name\", \"stack\" and \"shading\", or with \"name\" and "
             "\"surface\" (got 1)"},
        {"/lights", json::array(), "/lights: must be an array of 1 to 1000 lights (got [])"},
        {"/lights/0/diameter_deg", 181,
         "/lights/0/diameter_deg: must be in [0, 180], or a range of two such values (got 181)"},
        {"/materials/1/extent_um", 5,
         "/materials/1/extent_um: must be a width and a height in um, as in [4000, 4000] (got 5)"},
        {m + "/name", "a b", m + "/name: must be 1 to 64 letters, digits, - and _ (got \"a b\")"},
        {m + "/name", "../up",
         m + "/name: must be 1 to 64 letters, digits, - and _ (got \"../up\")"},
        {m + "/stack", 1.5, m + "/stack: must be a stack, a file or an expression (got 1.5)"},
        {m + "/stack", "", m + "/stack: must be a stack, a file or an expression (got \"\")"},
        {m + "/stack", "-", m + "/stack: must be a stack, a file or an expression (got \"-\")"},
        {m + "/vary", json::array({1, 2}),
         m + "/vary: must be an object with at most two ranges, as in {\"layers.0.thickness_nm\": "
             "[100, 900]} (got [1,2])"},
        {m + "/vary/layers.0.thickness_nm", json::array({1}),
         m + "/vary/layers.0.thickness_nm: must be the first and the last value (got [1])"},
        {m + "/vary/layers.0.thickness_nm", json::array({1, "2"}),
         m + "/vary/layers.0.thickness_nm/1: must be a number (got \"2\")"},
        {m + "/vary/layers.0.thickness_nm", json::array({900, 100}),
         m + "/vary/layers.0.thickness_nm: must ascend (got [900, 100])"},
        {m + "/angles_deg", json::array({0, 91}), m + "/angles_deg/1: must be in [0, 90] (got 91)"},
        {m + "/angles_deg", 45,
         m + "/angles_deg: must be two angles in [0, 90], as in [0, 80] "
             "(got 45)"},
        {m + "/angles_deg", json::array({80, 0}), m + "/angles_deg: must ascend (got [80, 0])"},
        {m + "/roughness", 0,
         m + "/roughness: must be in [1e-4, 1], or a range of two such "
             "values (got 0)"},
        {m + "/roughness", json::array({0.1, 1.5}),
         m + "/roughness/1: must be in [1e-4, 1] (got 1.5)"},
        {m + "/roughness", json::array({0.2, 0.1}), m + "/roughness: must ascend (got [0.2, 0.1])"},
        {m + "/transmission", "yes", m + "/transmission: must be true or false (got \"yes\")"},
        {m + "/thickness_spread_nm", -1, m + "/thickness_spread_nm: must be in [0, 1e6] (got -1)"},
        {m + "/shading", "colour",
         m + "/shading: must be one of color, fourier, bragg, rough-layers, albedo, "
             "facets, scratches (got \"colour\") (did you mean \"color\"?)"},
    };
    for (const Fault& fault : faults) {
        INFO(fault.pointer << " = " << fault.value);
        CHECK(error_with(fault.pointer, fault.value) == fault.message);
    }
    CHECK(error_of(json::array()) == "must be an object with \"materials\" (got [])");
}

TEST_CASE("what a scene must have is named", "[scene]") {
    CHECK(error_without("/materials") == "must have the key \"materials\"");
    for (const std::string key : {"name", "stack", "shading"})
        CHECK(error_without("/materials/0/" + key) ==
              "/materials/0: must have the key \"" + key + "\"");
}

TEST_CASE("unknown keys of a scene are named with the nearest known one", "[scene]") {
    CHECK(error_with("/illuminent", "D65") ==
          "/illuminent: unknown key (did you mean \"illuminant\"?)");
    CHECK(error_with("/tolerance/deltae", 1) ==
          "/tolerance/deltae: unknown key (did you mean \"delta_e\"?)");
    CHECK(error_with("/materials/0/shadings", "color") ==
          "/materials/0/shadings: unknown key (did you mean \"shading\"?)");
    CHECK(error_with("/materials/0/stack/layers/0/thicknes_nm", 1) ==
          "/materials/0/stack/layers/0/thicknes_nm: unknown key (did you mean "
          "\"thickness_nm\"?)");
}

TEST_CASE("names of materials are unique", "[scene]") {
    json document = complete_scene();
    document["materials"].push_back(document["materials"][0]);
    CHECK(error_of(document) == "/materials/2/name: must be unique (got \"film\")");
}

TEST_CASE("errors of a stack say where in the scene it is", "[scene]") {
    const std::string stack = "/materials/0/stack";
    CHECK(error_with(stack + "/layers/0/thickness_nm", -5).empty());  // it varies
    CHECK(error_with(stack + "/layers/0/material", -2).starts_with(stack + "/layers/0/material"));
    json document = complete_scene();
    document["materials"][0].erase("vary");
    document["materials"][0]["stack"]["layers"][0]["thickness_nm"] = -5;
    CHECK(error_of(document) == stack + "/layers/0/thickness_nm: must be in [0, 1e9] (got -5)");
    CHECK(error_with(stack, "1 | 1.33@ | 1").starts_with(stack + ": \"1 | 1.33@ | 1\""));
    CHECK(error_with(stack, "missing.json").starts_with(stack + ": "));
    CHECK(error_with(stack, "missing.json").find("missing.json") != std::string::npos);
}

TEST_CASE("a path that varies must be in the stack, over its whole range", "[scene]") {
    const std::string place = "/materials/0/vary";
    CHECK(error_with(place, {{"layers.7.thickness_nm", {1, 2}}})
              .starts_with(place + "/layers.7.thickness_nm: must name a number of the stack"));
    CHECK(error_with(place, {{"layers.0.thicknes_nm", {1, 2}}}) ==
          "/materials/0/stack/layers/0/thicknes_nm: unknown key (did you mean "
          "\"thickness_nm\"?)");
    CHECK(error_with(place, {{"layers.0.thickness_nm", {0, 1e10}}}) ==
          "/materials/0/stack/layers/0/thickness_nm: must be in [0, 1e9] (got 1e+10)");
    CHECK(error_with(place, {{"a", {1, 2}}, {"b", {1, 2}}, {"c", {1, 2}}})
              .starts_with(place + ": must be an object with at most two ranges"));
}

TEST_CASE("a stack is inline, a file beside the scene, or an expression", "[scene]") {
    const TemporaryFolder folder;
    write_text(folder / "film.json", R"({"incident": 1,
        "layers": [{"material": 1.33, "thickness_nm": 400}], "substrate": 1})");
    json document = json::parse(R"({"materials": [
        {"name": "inline", "shading": "color", "stack": null},
        {"name": "file", "shading": "color", "stack": "film.json"},
        {"name": "expression", "shading": "color", "stack": "1 | 1.33@400 | 1"}]})");
    document["materials"][0]["stack"] = json::parse(read_file(folder / "film.json"));
    write_text(folder / "scene.json", document.dump());
    const Scene scene = read_scene(folder / "scene.json");
    REQUIRE(scene.materials.size() == 3);
    for (const SceneMaterial& material : scene.materials) {
        INFO(material.name);
        const Stack& stack = material.document.stack;
        REQUIRE(stack.elements.size() == 1);
        CHECK(std::get<Layer>(stack.elements[0].value).thickness_nm == 400);
    }
}

TEST_CASE("validate takes scenes and manifests, by what is in them", "[cli][validate][scene]") {
    const TemporaryFolder folder;
    const Outcome examples =
        run_shell("\"$IRIDO\" validate schemas/examples/scenes/*.json", IRIDO_SOURCE_DIR);
    INFO(examples.out);
    CHECK(examples.status == 0);
    CHECK(examples.out.find("vehicle.json: ok\n") != std::string::npos);

    json broken = complete_scene();
    broken["format"] = "png";
    broken["materials"][0]["shading"] = "red";
    write_text(folder / "scene.json", broken.dump());
    const Outcome two = run_irido({"validate", folder / "scene.json"});
    CHECK(two.status == 1);
    CHECK(std::count(two.out.begin(), two.out.end(), '\n') == 2);

    // the checksum covers {"irido":...} on one line with sorted keys
    const Outcome edited = [&] {
        write_text(folder / "manifest.json", R"({"irido": "0.1.0", "numbers": 1, "scene": "",
            "settings": {}, "tables": {}, "materials": {}, "checksum": ")" +
                                                 ("sha256:" + std::string(64, '0')) + "\"}");
        return run_irido({"validate", folder / "manifest.json"});
    }();
    CHECK(edited.status == 1);
    CHECK(edited.out.starts_with(folder / "manifest.json: /checksum: does not match the manifest"));
    write_text(folder / "manifest.json", R"({"tables": {}, "materials": {}})");
    const Outcome manifest = run_irido({"validate", folder / "manifest.json"});
    CHECK(manifest.status == 1);
    CHECK(manifest.out.find("must have the key \"settings\"") != std::string::npos);
    CHECK(run_irido({"validate", "tests/data/complete-stack.json"}).status == 0);
}

TEST_CASE("validate says what plan would refuse, each thing once and with its place",
          "[cli][validate][scene]") {
    struct Fault {
        std::string material, line;
    };
    const std::string film = R"("stack": "1 | 1.33@400 | 1.5")";
    const std::string mirror = R"("stack": "1.5 | (1.5@95 | 1.75@82)^20 | 1.5")";
    const std::vector<Fault> faults{
        {film + R"(, "shading": "rough-layers")", ": material a: rough-layers needs \"roughness\""},
        {film + R"(, "shading": "rough-layers", "roughness": 0.1,
                   "vary": {"layers.0.thickness_nm": [1, 2]})",
         "/vary/layers.0.thickness_nm: material a: shading rough-layers takes no varied value "
         "(got 1 to 2)"},
        {film + R"(, "shading": "albedo", "roughness": 0.1,
                   "vary": {"layers.0.thickness_nm": [1, 2]})",
         "/vary/layers.0.thickness_nm: material a: shading albedo takes no varied value "
         "(got 1 to 2)"},
        {R"("stack": "1 | 1.33@400 | 1.4@100 | 1.5", "shading": "fourier")",
         "/shading: material a: fourier needs one coherent film of a real index (got more than one "
         "layer)"},
        {film + R"(, "shading": "bragg")",
         "/shading: material a: bragg needs one repeated group of two layers and nothing else"},
        {R"("stack": "1 | (1.5@95 | 1.75@82)^20 | 1.5", "shading": "bragg")",
         "/shading: material a: bragg needs the first layer's material on both sides of the "
         "mirror"},
        {R"("stack": {"incident": 1, "layers": [{"material": 1.33, "thickness_nm": -1}], "substrate": 1.5},
            "shading": "color")",
         "/stack/layers/0/thickness_nm: material a: must be in [0, 1e9] (got -1)"},
        {R"("stack": "no.json", "shading": "color")",
         "/stack: material a: no.json: cannot be read: No such file or directory"},
        {film + R"(, "shading": "color", "angles_deg": [80, 0])",
         "/angles_deg: material a: must ascend (got [80, 0])"},
    };
    for (const Fault& fault : faults) {
        const TemporaryFolder folder;
        write_text(folder / "scene.json",
                   R"({"materials": [{"name": "a", )" + fault.material + "}]}");
        const std::string line = folder / "scene.json: /materials/0" + fault.line + "\n";
        const Outcome validated = run_irido({"validate", folder / "scene.json"});
        CHECK(validated.status == 1);
        CHECK(validated.out == line);
        // and plan and bake agree
        const Outcome planned = run_irido({"plan", folder / "scene.json", "--quiet"});
        CHECK(planned.status == 1);
        CHECK(planned.err == "irido: error: " + line + "irido: error: " + folder / "scene.json" +
                                 ": 1 of 1 materials failed\n");
    }
}

TEST_CASE("validate says all that is wrong with all materials", "[cli][validate][scene]") {
    const TemporaryFolder folder;
    write_text(folder / "scene.json", R"({"materials": [
        {"name": "a", "stack": {"incident": 1, "layers": [{"material": -2, "thickness_nm": -1}],
         "substrate": 1}, "shading": "color", "angles_deg": [9, 1]},
        {"name": "b", "stack": "1 | 1.33@9 | 1", "shading": "color"},
        {"name": "c", "stack": "1 | 1.33@9 | 1", "shading": "rough-layers",
         "vary": {"layers.0.thickness_nm": [1, 2]}}]})");
    const Outcome outcome = run_irido({"validate", folder / "scene.json"});
    INFO(outcome.out);
    CHECK(outcome.status == 1);
    for (const std::string place : {"0/stack/layers/0/material", "0/stack/layers/0/thickness_nm",
                                    "0/angles_deg", "2", "2/vary/layers.0.thickness_nm"})
        CHECK(outcome.out.find(folder / "scene.json: /materials/" + place + ": material ") !=
              std::string::npos);
}

TEST_CASE("validate goes on after the errors of the scene itself", "[cli][validate][scene]") {
    const TemporaryFolder folder;
    const auto problems = [&](const std::string& scene) {
        write_text(folder / "scene.json", scene);
        const Outcome outcome = run_irido({"validate", "scene.json"}, "", folder.path());
        CHECK(outcome.status == 1);
        CHECK(outcome.err.empty());
        return outcome.out;
    };
    CHECK(problems(R"({"lights": [{"diameter_deg": [6, 2]}], "materials": [
              {"name": "a", "stack": "1 | 1.33@9 | 1", "shading": "color"}]})") ==
          "scene.json: /lights/0/diameter_deg: must ascend (got [6, 2])\n");
    const std::string all = problems(R"({"space": "sRBG", "materials": [
        {"name": "a", "stack": "1 | Xx@9 | 1", "shading": "color"},
        {"stack": {"incident": 1, "layers": [{"material": 2, "thickness_nm": -1}],
                   "substrate": 1}, "shading": "color"},
        {"name": "c", "surface": {"base": {"albedo": 2}}, "shadin": "facets"},
        {"name": "d", "stack": "1 | 1.33@9 | 1.5", "shading": "bragg"},
        {"name": "e", "stack": "none.json", "shading": 3}, 7]})");
    INFO(all);
    std::ptrdiff_t lines = 0;
    for (const std::string line :
         {"/materials/1: must have the key \"name\"", "/materials/2/shadin: unknown key (did you",
          "/materials/4/shading: must be one of color, fourier", "/materials/5: must be an object",
          "/space: must be one of srgb, rec2020, display-p3, acescg, xyz (got \"sRBG\") (did you "
          "mean \"srgb\"?)",
          "/materials/0/stack: material a: ", "unknown material \"Xx\"",
          "/materials/1/stack/layers/0/thickness_nm: material without a name: must be in",
          "/materials/2/surface/base/albedo: material c: must be in",
          "/materials/3/shading: material d: bragg needs one repeated group",
          "/materials/4/stack: material e: none.json: cannot be read"}) {
        INFO(line);
        CHECK(all.find(line) != std::string::npos);
        if (line.starts_with('/')) ++lines;
    }
    CHECK(std::ranges::count(all, '\n') == lines);
    CHECK(problems(R"({"materials": 3})").find("/materials: must be an array") !=
          std::string::npos);
    // only a file that cannot be read is another matter
    CHECK(run_irido({"validate", folder / "none.json"}).status == 2);
}

TEST_CASE("validate prints each schema", "[cli][validate][scene]") {
    for (const std::string name :
         {"stack", "surface", "design", "scene", "plan", "manifest", "lut"}) {
        const Outcome outcome = run_irido({"validate", "--schema", name});
        CHECK(outcome.status == 0);
        CHECK(outcome.out == read_file(IRIDO_SOURCE_DIR "/schemas/" + name + ".schema.json"));
    }
    check_refused(
        run_irido({"validate", "--schema", "scenes"}),
        "--schema: must be one of stack, surface, design, scene, plan, manifest, lut (got "
        "'scenes') (did you mean \"scene\"?)");
}
