// Scenes with scratched materials: which tables the lights ask for, and bakes of them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "schemas/documents/scene_document.hpp"
#include "tables/scratch/grid_file.hpp"
#include "tables/shaders/scene/bake.hpp"
#include "tables/shaders/scene/scene_problems.hpp"
#include "tables/shaders/scene/scratched_material.hpp"
#include "tests/support/program.hpp"

using namespace irido;
using namespace irido::schemas;
using namespace irido::tables;
using namespace irido::test;
using nlohmann::json;

namespace {

const char* const kTwo = R"({"scratches": [
    {"width_um": 1, "depth_um": 0.2, "angle_deg": 10, "point_um": [50, 30]},
    {"width_um": 2, "depth_um": 0.1, "angle_deg": 70, "point_um": [0, 90], "start_um": -50, "end_um": 60}]})";

json scene_of(const json& material, const json& lights = nullptr) {
    json scene{{"materials", {material}}};
    scene["materials"][0]["name"] = "metal";
    if (!lights.is_null()) scene["lights"] = lights;
    return scene;
}

json two_scratches() {
    return {{"surface", json::parse(kTwo)}, {"extent_um", {200, 200}}, {"footprint_um", 0}};
}

/// The roles of a scene's tables.
std::vector<std::string> roles_of(const json& scene) {
    const ScenePlan plan = plan_scene(read_scene(scene, "scene", ""), {1});
    for (const SceneFault& fault : plan.materials[0].faults) FAIL(fault.reason);
    std::vector<std::string> roles;
    for (const MaterialPlan::Use& use : plan.materials[0].tables) roles.push_back(use.role);
    return roles;
}

std::string problem_of(const json& scene) {
    const auto problems = problems_of_scene(scene, "scene", "", {1});
    REQUIRE(problems.size() == 1);
    return problems[0];
}

json lights_of(const json& diameter_deg) {
    return json::array({{{"diameter_deg", diameter_deg}}});
}

}  // namespace

TEST_CASE("a scene's lights decide the tables of its scratches", "[scene][scratch]") {
    using Roles = std::vector<std::string>;
    const json material = two_scratches();
    CHECK(roles_of(scene_of(material)) == Roles{"wide", "narrow", "points", "grid"});
    CHECK(roles_of(scene_of(material, lights_of(0))) == Roles{"points", "grid"});
    CHECK(roles_of(scene_of(material, lights_of(0.53))) == Roles{"narrow", "grid"});
    CHECK(roles_of(scene_of(material, lights_of({60, 120}))) == Roles{"wide", "grid"});
    CHECK(roles_of(scene_of(material, lights_of({0, 2}))) == Roles{"narrow", "points", "grid"});
    json seen = material;
    seen["footprint_um"] = 80;
    seen["surface"]["base"] = "1 | Ag";
    CHECK(roles_of(scene_of(seen, lights_of(0))) == Roles{"points", "footprint", "grid", "base"});
    // every choice has its reason
    const Scene scene = read_scene(scene_of(material, lights_of(0.53)), "scene", "");
    const ScenePlan plan = plan_scene(scene, {1});
    CHECK(plan.materials[0].tables[0].why.find("below 0.05") != std::string::npos);
    std::vector<std::string> skipped;
    for (const Omission& omission : plan.omissions) skipped.push_back(omission.what);
    CHECK(skipped == std::vector<std::string>{"wide table", "points table", "footprint table"});
    CHECK(plan.omissions[0].reason.find("no light covers 0.05") == 0);
}

TEST_CASE("tables of scratches depend on the light and on nothing that they do not need",
          "[scene][scratch]") {
    const auto table_of = [](json material, json settings) {
        json scene = scene_of(std::move(material), lights_of(0.53));
        scene.update(settings);
        return plan_scene(read_scene(scene, "scene", ""), {1}).tables[0].id;
    };
    const json material = two_scratches();
    json moved = material, deeper = material;
    moved["surface"]["scratches"][0]["point_um"] = {1, 2};
    deeper["surface"]["scratches"][0]["depth_um"] = 0.5;
    const std::string id = table_of(material, json::object());
    CHECK(table_of(moved, json::object()) == id);
    CHECK(table_of(material, {{"space", "rec2020"}}) == id);
    CHECK(table_of(deeper, json::object()) != id);
    CHECK(table_of(material, {{"illuminant", "A"}}) != id);
}

TEST_CASE("a scratched material bakes, a second bake touches nothing, damage is found",
          "[scene][scratch]") {
    const TemporaryFolder folder;
    json material = two_scratches();
    material["surface"]["base"] = "1 | 0.2+3.4i";
    material["surface"]["alpha"] = 0.2;
    write_text(folder / "scene.json", scene_of(material, lights_of(0)).dump());
    const auto planned_bytes = [&] {
        const json plan = json::parse(
            run_irido({"plan", folder / "scene.json", "-o", folder / "t", "-f", "json"}).out);
        std::vector<double> bytes;
        for (const json& table : plan["tables"]) bytes.push_back(table["bytes"]);
        return bytes;
    };
    const std::vector<double> bytes_before = planned_bytes();
    const Outcome first = done({"bake", folder / "scene.json", "-o", folder / "t"});
    CHECK(run_irido({"bake", folder / "scene.json", "-o", folder / "t"}).err ==
          "irido: 0 made, 3 kept\n");
    CHECK(run_irido({"bake", folder / "scene.json", "-o", folder / "t", "--verify"}).err ==
          "irido: 0 made, 3 kept\n");
    const std::string manifest = folder / "t/manifest.json";
    CHECK(run_irido({"validate", manifest}).out == manifest + ": ok\n");
    const json read = json::parse(read_file(manifest));
    const json& metal = read["materials"]["metal"];
    CHECK(metal["shading"] == "scratches");
    CHECK(metal["constants"]["alpha"] == 0.2);
    CHECK(metal["constants"]["depth_phase"] == "slanted");
    CHECK(metal["losses"][0]["what"] == "product of colours");
    const json& grid = read["tables"][metal["tables"]["grid"].get<std::string>()];
    CHECK(grid["scratches"] == 2);
    CHECK(planned_bytes() == bytes_before);
    CHECK(std::ranges::count(bytes_before, grid["bytes"].get<double>()) == 1);
    const std::string file = folder / "t/" + grid["file"].get<std::string>();
    CHECK(run_irido({"scratches", "--check", file}).out == file + ": ok\n");
    // a byte of a record
    std::string bytes = read_file(file);
    bytes[3] = static_cast<char>(bytes[3] ^ 1);
    write_text(file, bytes);
    CHECK(run_irido({"validate", manifest}).status == 1);
    const Outcome again = run_irido({"bake", folder / "scene.json", "-o", folder / "t"});
    CHECK(again.err.find("1 made, 2 kept") != std::string::npos);
    CHECK(run_irido({"validate", manifest}).status == 0);
    const Outcome plan = run_irido({"plan", folder / "scene.json", "-o", folder / "t"});
    CHECK(plan.out.find("chosen:\n  metal  points  points have no width") != std::string::npos);
    CHECK(plan.out.find("product of colours  Delta E ") != std::string::npos);
    CHECK(run_irido({"plan", folder / "scene.json", "--explain", "metal"})
              .out.find(", of 2 scratches\n") != std::string::npos);
}

TEST_CASE("a rough stack in a scene is a surface of one layer", "[scene]") {
    const json layer = {{"stack", "1 | 1.5@300 | 2+3i"}, {"alpha", 0.3}};
    const json as_surface = {{"surface", {{"layers", {layer}}}}},
               as_stack = {{"stack", layer["stack"]}, {"roughness", 0.3}, {"shading", "facets"}};
    const auto planned = [](const json& material) {
        const ScenePlan plan = plan_scene(read_scene(scene_of(material), "scene", ""), {1});
        for (const SceneFault& fault : plan.materials[0].faults) FAIL(fault.reason);
        return plan;
    };
    const ScenePlan one = planned(as_surface), two = planned(as_stack);
    CHECK(one.tables.size() == 1);
    CHECK(one.tables[0].id == two.tables[0].id);
    CHECK(one.materials[0].shading == Shading::facets);
    CHECK(one.materials[0].constants == json{{"alpha", {0.3, 0.3}}});
    CHECK(one.materials[0].snippets == std::vector<std::string>{"color", "facets"});
    json range = as_stack;
    range["roughness"] = {0.1, 0.5};
    range["vary"] = {{"layers.0.thickness_nm", {100, 400}}};
    CHECK(planned(range).materials[0].constants["alpha"] == json{0.1, 0.5});
    json smooth = as_stack;
    smooth.erase("roughness");
    CHECK(problem_of(scene_of(smooth)) ==
          "scene: /materials/0: material metal: facets needs \"roughness\"");
    json sized = as_surface;
    sized["footprint_um"] = 3;
    CHECK(problem_of(scene_of(sized)).find("/footprint_um: ") != std::string::npos);
    json coated = as_surface;
    coated["surface"] = {{"inside", 1.5},
                         {"layers", {{{"stack", "1.5 | 2@100 | 1.5"}, {"alpha", 0.2}}}}};
    CHECK(problem_of(scene_of(coated)).find("without a base or a coating") != std::string::npos);
}

TEST_CASE("impossible scratched materials are refused with their place", "[scene][scratch]") {
    const auto with = [](const std::string& key, const json& value) {
        json material = two_scratches();
        material[key] = value;
        return problem_of(scene_of(material));
    };
    const std::string place = "scene: /materials/0";
    CHECK(with("stack", "1 | 1.5") ==
          place + "/stack: material metal: cannot be combined with \"surface\"");
    CHECK(with("roughness", 0.2).find("/roughness: ") != std::string::npos);
    CHECK(with("shading", "color") ==
          place + "/shading: material metal: must be scratches for this surface");
    CHECK(with("extent_um", {0, 1}).find("/extent_um/0: must be in [1, 1e6]") != std::string::npos);
    CHECK(with("footprint_um", -1).find("/footprint_um: must be in [0, 1e4]") != std::string::npos);
    CHECK(with("surface", {{"incident", 1}, {"layers", json::array()}, {"substrate", 1.5}})
              .find("must be a surface (a stack goes into \"stack\")") != std::string::npos);
    CHECK(with("surface", json::parse(R"({"base": {"albedo": 0.5}})")) ==
          place + "/extent_um: material metal: requires a \"surface\" with scratches");
    json wide = json::parse(kTwo);
    wide["scratches"][1]["width_um"] = 0;
    CHECK(with("surface", wide).find(place + "/surface/scratches/1/width_um: ") == 0);
    json base = json::parse(kTwo);
    base["base"] = "1 | nothing";
    CHECK(with("surface", base).find(place + "/surface/base: ") == 0);
    CHECK(with("surface", "missing.json").find("missing.json") != std::string::npos);
    CHECK(problem_of(scene_of({{"stack", "1 | 1.5"}, {"shading", "scratches"}}))
              .find("scratches requires a \"surface\" with scratches") != std::string::npos);
    CHECK(
        problem_of(scene_of({{"stack", "1 | 1.5"}, {"shading", "color"}, {"extent_um", {10, 10}}}))
            .find("/extent_um: material metal: requires a \"surface\"") != std::string::npos);
    CHECK(problem_of(scene_of(two_scratches(), lights_of(181))).find("/lights/0/diameter_deg") !=
          std::string::npos);
    CHECK(problem_of(scene_of(two_scratches(), json::array())).find("/lights: ") !=
          std::string::npos);
    CHECK_THROWS_WITH(read_scene(scene_of(two_scratches(), lights_of({3, 2})), "scene", ""),
                      "scene: /lights/0/diameter_deg: must ascend (got [3, 2])");
    json crowded = two_scratches();
    crowded["surface"] = {
        {"fields",
         {{{"count_per_mm2", 1e6}, {"length_um", 1000}, {"width_um", 1}, {"depth_um", 0.1}}}}};
    crowded["extent_um"] = {1e5, 1e5};
    CHECK(problem_of(scene_of(crowded)).find("scratches in reach, more than 5e+07") !=
          std::string::npos);
}
