// Every reason for which a plan omits something, on a scene where it applies and on one where it
// does not.
#include "tables/shaders/scene/scene_plan.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tables/shaders/scene/bake.hpp"
#include "tables/shaders/scene/scene_error.hpp"
#include "tests/support/program.hpp"

using namespace irido;
using namespace irido::schemas;
using namespace irido::tables;
using namespace irido::test;
using nlohmann::json;

namespace {

struct Planned {
    Scene scene;
    ScenePlan plan;

    /// The reason why `what` is omitted from the first material that omits it; "" for none.
    std::string reason(const std::string& what) const {
        const auto found = std::ranges::find(plan.omissions, what, &Omission::what);
        return found == plan.omissions.end() ? "" : found->reason;
    }
    std::vector<std::string> roles(std::size_t material = 0) const {
        std::vector<std::string> result;
        for (const MaterialPlan::Use& use : plan.materials[material].tables)
            result.push_back(use.role);
        return result;
    }
    const SceneTable& table(const std::string& role) const {
        for (const MaterialPlan::Use& use : plan.materials[0].tables)
            if (use.role == role) return plan.tables[use.table];
        throw std::runtime_error("no table " + role);
    }
    /// The notes from sizing a table, and the table's axes without its values.
    json entry(const std::string& role) const { return planned_entry(table(role)); }
};

/// A scene of these materials: objects without "name" and, unless given, with "shading": "color".
Planned planned(const std::string& materials, const json& settings = json::object()) {
    json document = settings;
    document["materials"] = json::parse("[" + materials + "]");
    std::size_t count = 0;
    for (json& material : document["materials"]) {
        if (!material.contains("name")) material["name"] = "m" + std::to_string(count);
        if (!material.contains("shading")) material["shading"] = "color";
        ++count;
    }
    const TemporaryFolder folder;
    write_text(folder / "scene.json", document.dump());
    Planned result;
    result.scene = read_scene(folder / "scene.json");
    result.plan = plan_scene(result.scene, {});
    for (const MaterialPlan& material : result.plan.materials) {
        INFO((material.faults.empty() ? "" : material.faults.front().reason));
        REQUIRE(material.faults.empty());
    }
    return result;
}

std::string fault_of(const std::string& material) {
    const TemporaryFolder folder;
    write_text(folder / "scene.json", "{\"materials\": [" + material + "]}");
    const ScenePlan plan = plan_scene(read_scene(folder / "scene.json"), {});
    const std::vector<SceneFault>& faults = plan.materials.at(0).faults;
    REQUIRE(faults.size() == 1);
    return faults[0].pointer + ": " + faults[0].reason;
}

bool has_note(const json& entry, const std::string& part) {
    return std::ranges::any_of(entry["notes"], [&](const json& note) {
        return note.get<std::string>().find(part) != std::string::npos;
    });
}

std::size_t count_of(const json& entry, const std::string& axis) {
    for (const json& one : entry["axes"])
        if (one["name"] == axis) return one["count"].get<std::size_t>();
    return 0;
}

const std::string kThickness = "layers.0.thickness_nm";

}  // namespace

TEST_CASE("plan: a colour that hardly changes is numbers, another a table", "[scene][plan]") {
    const json flat =
        planned(R"({"stack": "1 | 1.33@6 | 1", "angles_deg": [0, 20]})").entry("reflection");
    CHECK(flat.contains("values"));
    CHECK(has_note(flat, "cos_theta: constant over "));
    const json steep =
        planned(R"({"stack": "1 | 1.33@400 | 1", "angles_deg": [0, 80]})").entry("reflection");
    CHECK(steep.contains("file"));
    CHECK(count_of(steep, "cos_theta") > 1);
}

TEST_CASE("plan: an axis along which nothing changes is dropped", "[scene][plan]") {
    // the layer has the index of the base
    const std::string rest = R"(, "vary": {"layers.0.thickness_nm": [100, 900]}})";
    const json none = planned(R"({"stack": "1 | 1.5@400 | 1.5")" + rest).entry("reflection");
    CHECK(has_note(none, kThickness + ": constant over [100, 900]: stored as one sample"));
    CHECK(count_of(none, kThickness) == 1);
    const json film = planned(R"({"stack": "1 | 1.33@400 | 1.5")" + rest).entry("reflection");
    CHECK(!has_note(film, kThickness));
    CHECK(count_of(film, kThickness) > 1);
}

TEST_CASE("plan: a thickness ends where no fringes are left, and the reason says so",
          "[scene][plan]") {
    const std::string material = R"({"stack": "1 | 1.33@400 | 1.5", "angles_deg": [0, 30],
                                     "vary": {"layers.0.thickness_nm": [100, )";
    const json settings = {{"tolerance", {{"delta_e", 3}}}};
    const json thick = planned(material + "60000]}}", settings).entry("reflection");
    CHECK(has_note(thick, kThickness + ": no fringes are left, constant beyond "));
    CHECK(thick["axes"][1]["last"].get<double>() < 30000);
    const json thin = planned(material + "600]}}", settings).entry("reflection");
    CHECK(!has_note(thin, "no fringes"));
    CHECK(thin["axes"][1]["last"] == 600);
}

TEST_CASE("plan: a value that varies over nothing is none", "[scene][plan]") {
    const Planned one =
        planned(R"({"stack": "1 | 1.33@9 | 1", "vary": {"layers.0.thickness_nm": [300, 300]}})");
    CHECK(one.reason(kThickness) == "is always 300");
    CHECK(one.table("reflection").request.vary.empty());
    const Planned range =
        planned(R"({"stack": "1 | 1.33@9 | 1", "vary": {"layers.0.thickness_nm": [300, 301]}})");
    CHECK(range.reason(kThickness).empty());
    CHECK(range.table("reflection").request.vary.size() == 1);
}

TEST_CASE("plan: a film without fringes is its mean, C_0", "[scene][plan]") {
    const Planned thick = planned(R"({"stack": "1 | 1.33@60000 | 1.5", "shading": "fourier"})");
    CHECK(thick.reason("sensitivity") ==
          "no fringes are left at these optical path differences: C_0 only");
    CHECK(thick.plan.tables.empty());
    CHECK(thick.plan.materials[0].constants["orders"] == 0);
    const Planned thin = planned(R"({"stack": "1 | 1.33@600 | 1.5", "shading": "fourier"})");
    CHECK(thin.reason("sensitivity").empty());
    CHECK(thin.plan.materials[0].constants["orders"].get<int>() > 0);
    CHECK(thin.roles() == std::vector<std::string>{"sensitivity"});
}

TEST_CASE("plan: no transmitted table unless asked for and light comes through", "[scene][plan]") {
    const std::string asked = R"(, "transmission": true})";
    CHECK(planned(R"({"stack": "1 | 1.33@400 | 1.5"})").reason("transmission") ==
          "was not requested");
    const Planned opaque = planned(R"({"stack": "1 | 1.33@400 | 1.5+3i")" + asked);
    CHECK(opaque.reason("transmission") == "the base absorbs all that enters it");
    CHECK(opaque.roles() == std::vector<std::string>{"reflection"});
    const Planned clear = planned(R"({"stack": "1 | 1.33@400 | 1.5")" + asked);
    CHECK(clear.reason("transmission").empty());
    CHECK(clear.roles() == std::vector<std::string>{"reflection", "transmission"});
    // without a table if the shader can derive it from the reflected light
    const Planned film = planned(R"({"stack": "1 | 1.33@400 | 1.5", "shading": "fourier")" + asked);
    CHECK(film.reason("transmission") == "what is not reflected is transmitted");
}

TEST_CASE("plan: no imaginary half over a base that does not absorb", "[scene][plan]") {
    const Planned glass = planned(R"({"stack": "1 | 1.33@400 | 1.5", "shading": "fourier"})");
    CHECK(glass.reason("imaginary half") == "the base does not absorb: its phase is 0 or pi");
    CHECK(glass.entry("sensitivity")["channels"].size() == 3);
    const Planned metal = planned(R"({"stack": "1 | 1.33@400 | 1.5+3i", "shading": "fourier"})");
    CHECK(metal.reason("imaginary half").empty());
    CHECK(metal.entry("sensitivity")["channels"].size() == 6);
}

TEST_CASE("plan: one polarization at normal incidence alone", "[scene][plan]") {
    const Planned normal = planned(R"({"stack": "1 | 1.33@400 | 1.5", "angles_deg": [0, 0]})");
    CHECK(normal.reason("polarization p") == "at normal incidence both are the same");
    CHECK(normal.table("reflection").request.color.light == Light::s);
    CHECK(normal.entry("reflection").contains("values"));
    const Planned tilted = planned(R"({"stack": "1 | 1.33@400 | 1.5", "angles_deg": [0, 5]})");
    CHECK(tilted.reason("polarization p").empty());
    CHECK(tilted.table("reflection").request.color.light == Light::unpolarized);
}

TEST_CASE("plan: angles that never occur have no samples", "[scene][plan]") {
    const Planned some = planned(R"({"stack": "1 | 1.33@400 | 1.5", "angles_deg": [0, 60]})");
    CHECK(some.reason("angles") == "those outside 0 to 60 degrees do not occur");
    CHECK(some.entry("reflection")["axes"][0]["first"].get<double>() == Approx(0.5));
    const Planned all = planned(R"({"stack": "1 | 1.33@400 | 1.5"})");
    CHECK(all.reason("angles").empty());
    CHECK(all.entry("reflection")["axes"][0]["first"] == 0);
}

TEST_CASE("plan: orders below the tolerance are left out, fewer for a smaller one",
          "[scene][plan]") {
    const std::string film = R"({"stack": "1 | 2.3@300 | 1.5+3i", "shading": "fourier"})";
    const auto orders = [&](double relative) {
        const Planned result = planned(film, {{"tolerance", {{"relative", relative}}}});
        const int count = result.plan.materials[0].constants["orders"].get<int>();
        CHECK(result.reason("orders " + std::to_string(count + 1) + " and above") ==
              "are below the tolerance");
        return count;
    };
    CHECK(orders(0.1) < orders(1e-3));
}

TEST_CASE("plan: the same physics is one table under all its names", "[scene][plan]") {
    const Planned same = planned(R"(
        {"stack": "1 | 1.33@400 | 1.5"},
        {"stack": {"incident": {"n": 1}, "layers": [{"material": {"n": 1.33}, "thickness_nm": 400}],
                   "substrate": {"n": 1.5}}})");
    CHECK(same.plan.tables.size() == 1);
    CHECK(same.plan.tables[0].materials == std::vector<std::string>{"m0", "m1"});
    CHECK(same.reason("reflection") == "the same physics as m0: one table for both");
    const Planned other =
        planned(R"({"stack": "1 | 1.33@400 | 1.5"}, {"stack": "1 | 1.33@401 | 1.5"})");
    CHECK(other.plan.tables.size() == 2);
    CHECK(other.reason("reflection").empty());
    // equal at the first value, but not at the last
    const std::string vary = R"(, "vary": {"layers.0.thickness_nm": [0, 300]}})";
    const Planned reach = planned(R"({"stack": "1 | 1.33@0 | 1.5")" + vary +
                                  R"(, {"stack": "1 | 1.4@0 | 1.5")" + vary);
    CHECK(reach.plan.tables.size() == 2);
}

TEST_CASE("plan: a closed form in the shader needs no table", "[scene][plan]") {
    const std::string mirror = R"({"stack": "1.5 | (1.5@95 | 1.75@82)^20 | 1.5", "shading": )";
    const Planned bragg = planned(mirror + "\"bragg\"}");
    CHECK(bragg.reason("color") == "closed form in the shader: snippet bragg");
    CHECK(bragg.roles() == std::vector<std::string>{"cumulative"});
    CHECK(planned(mirror + "\"color\"}").reason("color").empty());

    const std::string rough = R"({"stack": "1 | 1.33@400 | 1.5", "angles_deg": [0, 60],
                                  "shading": "rough-layers", "roughness": )";
    const Planned range = planned(rough + "[0.1, 0.3]}");
    CHECK(range.reason("falpha") == "closed form in the shader: snippet falpha-closed");
    CHECK(range.roles() == std::vector<std::string>{"transmissivity"});
    const Planned one = planned(rough + "0.2}");
    CHECK(one.reason("falpha").empty());
    CHECK(one.roles() == std::vector<std::string>{"falpha", "transmissivity"});
    // grazing light into a metal has no table of a reasonable size, and nobody sees it
    const Planned opaque = planned(R"({"stack": "1 | 1.46@100 | Al", "shading": "rough-layers",
                                       "roughness": 0.1})");
    CHECK(opaque.reason("transmissivity").starts_with("the substrate keeps what passes"));
    CHECK(opaque.roles().empty());
}

TEST_CASE("plan: mip levels only where a spread of a thickness is given", "[scene][plan]") {
    const std::string film = R"({"stack": "1 | 1.33@400 | 1.5", "angles_deg": [0, 60],
                                 "vary": {"layers.0.thickness_nm": [300, 500]})";
    CHECK(planned(film + "}").reason("mip levels") == "no thickness_spread_nm is given");
    const Planned spread = planned(film + R"(, "thickness_spread_nm": 20})");
    CHECK(spread.reason("mip levels").empty());
    CHECK(count_of(spread.entry("reflection"), "thickness_sigma_nm") == 4);
    const Planned fixed = planned(R"({"stack": "1 | 1.33@400 | 1.5", "thickness_spread_nm": 20})");
    CHECK(fixed.reason("mip levels") == "the one value that varies must be a thickness");
}

TEST_CASE("plan: the levels of a series are spreads of the path, as far as fringes are left",
          "[scene][plan]") {
    const std::string film = R"({"stack": "1 | 2.3@80 | 2.5+3.4i", "angles_deg": [0, 60],
                                 "shading": "fourier", "thickness_spread_nm": )";
    const Planned narrow = planned(film + "2}"), wide = planned(film + "500}");
    const auto& constants = narrow.plan.materials[0].constants;
    const auto levels = constants["level_sigma_nm"].get<std::vector<double>>();
    REQUIRE(levels.size() == 4);
    CHECK(levels[0] == 0);
    CHECK(levels[3] == std::ceil(2 * 2.3 * constants["orders"].get<int>() * 2));
    CHECK(narrow.reason("standard deviations from 415 nm of path difference").empty());
    CHECK(wide.reason("standard deviations from 415 nm of path difference") ==
          "no fringes are left there");
    CHECK(wide.plan.materials[0].constants["level_sigma_nm"][3] == 415);
}

TEST_CASE("plan: a table with levels has two samples in the last one", "[scene][plan]") {
    const Planned film = planned(R"({"stack": "1 | 2.3@20 | 2.5+3.4i", "angles_deg": [0, 30],
        "thickness_spread_nm": 2, "shading": "fourier"})",
                                 {{"tolerance", {{"relative", 0.05}}}});
    const SceneTable& table = film.table("sensitivity");
    const Lut lut = make_lut(*table.kind, table.kind->plan(table.request), table.making);
    CHECK(lut.levels() == 4);
    CHECK(lut.axes_of_level(3).back().count() >= 2);
    CHECK_NOTHROW(format_of(film.scene).write(lut, {}));
}

TEST_CASE("plan: what a shading has no use for is said", "[scene][plan]") {
    const std::string film = R"({"stack": "1 | 1.33@400 | 1.5", "roughness": 0.2, "shading": )";
    CHECK(planned(film + "\"color\"}").reason("roughness") ==
          "the shading color is for smooth surfaces only");
    CHECK(planned(film + R"("albedo", "angles_deg": [0, 60]})").reason("roughness").empty());
    CHECK(planned(R"({"stack": "1 | 1.33@400 | 1.5", "shading": "albedo"})").reason("alpha") ==
          "the surface is smooth: its albedo is its colour");
    CHECK(planned(R"({"stack": "1 | 1.33@400 | Fe", "shading": "fourier"})").reason("dispersion") ==
          "the shader uses the indices at 550 nm");
    CHECK(planned(R"({"stack": "1 | 1.33@400 | 1.5", "shading": "fourier"})")
              .reason("dispersion")
              .empty());
    CHECK(planned(R"({"stack": "1.5 | 1.2@400 | 1.5", "shading": "fourier"})")
              .reason("light past the film's critical angle") ==
          "the series cannot represent it: the shader gives white (the shading color is exact)");
    CHECK(planned(R"({"stack": "1.5 | 1.2@400 | 1.5", "shading": "fourier",
                      "angles_deg": [0, 40]})")
              .reason("light past the film's critical angle")
              .empty());
}

TEST_CASE("plan: a material that its shading cannot have is a fault of its own", "[scene][plan]") {
    const auto fault = [](const std::string& stack, const std::string& more) {
        return fault_of(R"({"name": "a", "stack": ")" + stack + "\", " + more + "}");
    };
    CHECK(fault("1 | 1.33@400 | 1.4@100 | 1.5", R"("shading": "fourier")")
              .find("fourier needs one coherent film of a real index") != std::string::npos);
    CHECK(fault("1 | 1.33@400 | 1.5", R"("shading": "bragg")")
              .find("bragg needs one repeated group of two layers") != std::string::npos);
    CHECK(fault("1 | (1.5@95 | 1.75@82)^20 | 1.5", R"("shading": "bragg")")
              .find("bragg needs the first layer's material on both sides") != std::string::npos);
    CHECK(fault("1 | 1.33@400 | 1.5", R"("shading": "rough-layers")").find("needs \"roughness\"") !=
          std::string::npos);
    CHECK(fault("1 | 1.33@400 | 1.5", R"("shading": "albedo", "roughness": 0.1,
                                         "vary": {"layers.0.thickness_nm": [1, 2]})")
              .find("takes no varied value") != std::string::npos);
}

TEST_CASE("a baked table is within its tolerance of the exact colour at 10000 random points",
          "[scene][plan]") {
    const Planned film = planned(R"({"stack": "1 | 1.33@400 | 1.5+3i", "angles_deg": [0, 80],
                                     "vary": {"layers.0.thickness_nm": [50, 700]}})");
    const SceneTable& table = film.table("reflection");
    const LutPlan function = table.kind->plan(table.request);
    Lut lut = make_lut(*table.kind, function, table.making);
    for (double& value : lut.values) value = rounded(value, lut.type);
    const double stated = lut.facts["error"]["value"].get<double>();
    CHECK(stated <= 0.5);
    CHECK(worst_difference(function, lut, {}) <= stated);
}

// Models the snippet, with the level for each order's own standard deviation: between two levels,
// light at wavelengths other than 550 nm is blended, with an error of at most 3 % of the fringes.
TEST_CASE("a series with a spread in the shader is near the exact colour", "[scene][plan]") {
    const Planned rim = planned(R"({"stack": "1 | 2.35@80 | 2.54+3.43i", "angles_deg": [0, 80],
        "vary": {"layers.0.thickness_nm": [20, 180]}, "thickness_spread_nm": 8,
        "shading": "fourier"})");
    const SceneTable& table = rim.table("sensitivity");
    Lut lut = make_lut(*table.kind, table.kind->plan(table.request), table.making);
    for (double& value : lut.values) value = rounded(value, lut.type);
    const double worst = worst_fourier_difference(rim.scene, rim.scene.materials[0],
                                                  rim.plan.materials[0], &lut, {}, {2000, 1, 0});
    INFO(worst);
    CHECK(worst < 2);
}

TEST_CASE("plan: what a shader's constant indices lose is measured", "[scene][plan]") {
    const Planned glass = planned(R"({"stack": "air | SiO2@300 | Si", "angles_deg": [0, 60],
                                      "shading": "fourier"})");
    const auto loss = std::ranges::find(glass.plan.omissions, "dispersion", &Omission::what);
    REQUIRE(loss != glass.plan.omissions.end());
    CHECK(loss->kind == Omission::Kind::loss);
    const double with = dispersion_difference(glass.scene, glass.scene.materials[0], {});
    CHECK(with > 0.5);
    CHECK(with < 50);
    // no loss if nothing depends on the wavelength
    const Planned constant = planned(R"({"stack": "1 | 1.46@300 | 4.1+0.04i", "angles_deg": [0, 60],
        "vary": {"layers.0.thickness_nm": [200, 300]}, "shading": "fourier"})");
    CHECK(dispersion_difference(constant.scene, constant.scene.materials[0], {}) == 0);
}

TEST_CASE("plan: errors of mip levels are estimated near those of the table",
          "[scene][plan][slow]") {
    const Planned film = planned(R"({"stack": "1 | 1.33@400 | 1.5+3i", "angles_deg": [0, 60],
        "vary": {"layers.0.thickness_nm": [250, 450]}, "thickness_spread_nm": 10})",
                                 {{"tolerance", {{"delta_e", 2}}}});
    const SceneTable& table = film.table("reflection");
    const LutPlan plan = table.kind->plan(table.request);
    const Lut lut = make_lut(*table.kind, plan, table.making);
    const auto exact = lut.facts["error"]["levels"].get<std::vector<double>>();
    const auto estimated = estimated_level_errors(plan, lut, 0);
    REQUIRE(estimated.size() == exact.size());
    for (std::size_t level = 0; level < exact.size(); ++level) {
        CHECK(estimated[level] <= exact[level] * (1 + 1e-9));
        CHECK(estimated[level] >= exact[level] / 2);
    }
    CHECK(estimated_seconds(plan, lut, table.making) > 0);
    // levels beyond the tolerance are a loss
    const TableEntries entries{{table.id, film.entry("reflection")}};
    const auto all = omissions_of(film.plan, film.plan.materials[0], entries);
    const auto loss = std::ranges::find(all, "reflection mip levels", &Omission::what);
    REQUIRE(loss != all.end());
    CHECK(loss->kind == Omission::Kind::loss);
    CHECK(loss->delta_e.value() > 2);
}
