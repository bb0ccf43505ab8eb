#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tables/files/hash.hpp"
#include "tests/support/bakery.hpp"

using namespace irido;
using namespace irido::tables;
using namespace irido::test;
using Catch::Contains;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

/// Tables of every kind of size: with levels, cut, constant along an axis, numbers, ending before
/// 90 degrees, of scratches.
const std::string kScene = R"({
    "name": "test", "tolerance": {"delta_e": 1, "relative": 0.01},
    "lights": [{"name": "lamp", "diameter_deg": [0, 20]}],
    "materials": [
        {"name": "film", "stack": "1 | 1.33@300 | 1.5+3i", "angles_deg": [0, 70],
         "vary": {"layers.0.thickness_nm": [250, 350]}, "thickness_spread_nm": 5,
         "shading": "color"},
        {"name": "cut", "stack": "1 | 1.5+0.05i@300 | 2.5+3i", "angles_deg": [0, 20],
         "vary": {"layers.0.thickness_nm": [0, 20000]}, "shading": "color"},
        {"name": "wall", "stack": "1 | 1.33@100 | 1", "vary": {"layers.0.thickness_nm": [0, 100]},
         "shading": "color"},
        {"name": "series", "stack": "1 | 2.3@60 | 2.5+3.4i", "angles_deg": [0, 60],
         "thickness_spread_nm": 5, "shading": "fourier"},
        {"name": "mirror", "stack": "1.5 | (1.5@95 | 1.75@82)^20 | 1.5", "shading": "bragg"},
        {"name": "black", "stack": "1 | 1.33@6 | 1", "angles_deg": [0, 20], "shading": "color"},
        {"name": "disc", "stack": "1 | 1.33@100 | 1.5", "angles_deg": [0, 60], "roughness": 0.2,
         "shading": "rough-layers"},
        {"name": "worn", "extent_um": [300, 300], "footprint_um": 20, "surface": {
         "base": "1 | 1.5+3i", "fields": [{"count_per_mm2": 40, "length_um": [50, 100],
         "width_um": [1, 3], "depth_um": [0.1, 0.3], "angle_deg": [0, 180]}]}}
    ]})";

/// A scene that is soon baked.
const std::string kFewTables = R"({
    "tolerance": {"delta_e": 1},
    "materials": [
        {"name": "film", "stack": "1 | 1.33@300 | 1.5+3i", "angles_deg": [0, 70],
         "vary": {"layers.0.thickness_nm": [250, 350]}, "shading": "color"},
        {"name": "black", "stack": "1 | 1.33@6 | 1", "angles_deg": [0, 20], "shading": "color"}
    ]})";

/// A bakery with the scene's plan.
class Planned : public Bakery {
public:
    explicit Planned(const std::string& scene = kScene) : Bakery(scene) {
        set_plan(done({"plan", path("scene.json"), "-f", "json", "--quiet"}).out);
    }

    void set_plan(const std::string& text) const { write_text(path("plan.json"), text); }
    json plan() const { return json::parse(read_file(path("plan.json"))); }
    Outcome bake_planned(const std::string& folder) const {
        return bake(folder, {"--plan", path("plan.json")});
    }
    BakedFiles files(const std::string& folder) const { return files_in(path(folder)); }
};

/// With the checksum that it would have.
std::string sealed(json plan) {
    plan.erase("checksum");
    plan["checksum"] = "sha256:" + sha256_of(plan.dump());
    return plan.dump();
}

}  // namespace

TEST_CASE("a bake with a plan makes the same bytes", "[cli][bake]") {
    const Planned planned;
    const json plan = planned.plan();
    const auto has = [&](const std::string& text) {
        return std::ranges::any_of(plan["tables"], [&](const json& table) {
            return table["notes"].dump().find(text) != std::string::npos;
        });
    };
    CHECK(has("range cut there"));
    CHECK(has("stored as one sample"));
    CHECK(std::ranges::count_if(
              plan["tables"], [](const json& table) { return table.contains("angles_deg"); }) == 1);
    CHECK(run_irido({"validate", planned.path("plan.json")}).status == 0);
    const Outcome with = planned.bake_planned("with");
    CHECK(with.status == 0);
    CHECK_THAT(with.err, !Contains("plan.json"));
    CHECK(planned.bake("without").status == 0);
    CHECK(planned.files("with") == planned.files("without"));
    // a plan of what was kept has the same sizes
    const Outcome kept = run_irido(
        {"plan", planned.path("scene.json"), "-f", "json", "--quiet", "-o", planned.path("with")});
    planned.set_plan(kept.out);
    for (std::size_t t = 0; t < plan["tables"].size(); ++t)
        for (const char* key : {"id", "kind", "axes", "notes"})
            CHECK(planned.plan()["tables"][t][key] == plan["tables"][t][key]);
    CHECK(planned.bake("with", {"--force", "--plan", planned.path("plan.json")}).status == 0);
    CHECK(planned.files("with") == planned.files("without"));
}

TEST_CASE("the sizes of a bake are those of its plan", "[cli][bake]") {
    const Planned planned(R"({"materials": [{"name": "film", "stack": "1 | 1.33@300 | 1.5+3i",
        "angles_deg": [0, 70], "vary": {"layers.0.thickness_nm": [250, 350]}, "shading": "color"}],
        "tolerance": {"delta_e": 1}})");
    json plan = planned.plan();
    json& count = plan["tables"][0]["axes"][1]["count"];
    const std::size_t more = 2 * count.get<std::size_t>();
    count = more;
    planned.set_plan(sealed(plan));
    CHECK(planned.bake_planned("a").status == 0);
    const json manifest = json::parse(planned.files("a").at("manifest.json"));
    CHECK(manifest["tables"].begin().value()["axes"][1]["count"] == more);
    // a range that the scene does not have is no size: it is looked for
    plan["tables"][0]["axes"][1]["first"] = 10;
    planned.set_plan(sealed(plan));
    CHECK(planned.bake_planned("b").status == 0);
    CHECK(planned.bake("c").status == 0);
    CHECK(planned.files("b") == planned.files("c"));
}

TEST_CASE("tables that are not in the plan are made, and a note names them", "[cli][bake]") {
    const Planned planned(kFewTables);
    json scene = json::parse(kFewTables);
    scene["materials"][0]["stack"] = "1 | 1.34@300 | 1.5+3i";
    planned.set(scene.dump());
    const Outcome with = planned.bake_planned("with");
    CHECK(with.status == 0);
    CHECK_THAT(with.err, Contains(planned.path("plan.json") + ": does not have color-") &&
                             Contains(".ktx2 of film: its size was looked for\n"));
    CHECK(with.err.find("does not have") == with.err.rfind("does not have"));
    CHECK(planned.bake("without").status == 0);
    CHECK(planned.files("with") == planned.files("without"));
}

TEST_CASE("a plan may come from a pipe, and be written anew by others", "[cli][bake]") {
    const Planned planned(kFewTables);
    const Outcome piped = run_shell(
        "\"$IRIDO\" plan scene.json -f json --quiet | \"$IRIDO\" bake scene.json --plan - -o a",
        planned.path("."));
    CHECK(piped.status == 0);
    planned.set_plan(planned.plan().dump());  // in one line
    CHECK(planned.bake_planned("b").status == 0);
    CHECK(planned.files("a") == planned.files("b"));
}

TEST_CASE("what is no plan of the scene is refused, and nothing is written", "[cli][bake]") {
    const Planned planned;
    const json whole = planned.plan();
    const auto changed = [&](const auto& change) {
        json plan = whole;
        change(plan);
        return plan;
    };
    const std::vector<std::pair<std::string, std::string>> cases{
        {"", "plan.json: 1:1: "},
        {whole.dump().substr(0, 300), "plan.json: 1:301: "},
        {"[]", "plan.json: must be a plan, as irido plan -f json writes it"},
        {kScene, "plan.json: "},
        {changed([](json& plan) { plan["tables"][0]["axes"][0]["count"] = 0; }).dump(),
         "plan.json: /tables/0/axes/0/count: must be a number of samples (got 0)"},
        {changed([](json& plan) { plan["tables"][0]["axes"][0]["count"] = 99; }).dump(),
         "plan.json: /checksum: does not match the plan, which was edited"},
        {sealed(changed([](json& plan) { plan["numbers"] = 1; })),
         "plan.json: /numbers: is of a version of irido with other numbers: plan the scene again"},
        {sealed(changed([](json& plan) { plan["scene"] = "other"; })),
         "plan.json: is the plan of another scene, scene.json \"other\""},
    };
    for (const auto& [text, line] : cases) {
        planned.set_plan(text);
        const Outcome outcome = planned.bake_planned("a");
        INFO(text.substr(0, 200));
        check_refused(outcome, line);
        CHECK_FALSE(fs::exists(planned.path("a")));
    }
    fs::remove(planned.path("plan.json"));
    CHECK(planned.bake_planned("a").status == 2);
    CHECK_FALSE(fs::exists(planned.path("a")));
    planned.set_plan(changed([](json& plan) { plan["stale"] = {"x"}; }).dump());
    const Outcome validated = run_irido({"validate", planned.path("plan.json")});
    CHECK(validated.status == 1);
    CHECK_THAT(validated.out, Contains("/checksum: does not match the plan"));
}
