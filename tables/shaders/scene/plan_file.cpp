#include "tables/shaders/scene/plan_file.hpp"

#include <algorithm>

#include "schemas/documents/json_document.hpp"
#include "schemas/documents/schema_check.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/text_file.hpp"
#include "tables/shaders/scene/manifest.hpp"
#include "tables/version.hpp"

namespace irido::tables {

namespace {

using nlohmann::json;

/// Whole numbers as such, as other programs may write them.
std::string checksum_of_plan(json document) {
    schemas::shorten_numbers(document);
    return checksum_of(std::move(document));
}

std::vector<schemas::Problem> problems_in(const json& document) {
    static const schemas::Schema schema(json::parse(plan_schema_text()));
    std::vector<schemas::Problem> problems = schemas::check(schema, document);
    if (problems.empty() && document["checksum"] != checksum_of_plan(document))
        problems.push_back(
            {"/checksum",
             "does not match the plan, which was edited (irido plan -f json writes it anew)"});
    return problems;
}

void take_size(SceneTable& table, const json& planned) {
    FittedAxes& fitted = table.making.sizing.fitted.emplace();
    for (const json& axis : planned["axes"])
        fitted.ranges.push_back({axis["first"], axis["last"], axis["count"]});
    fitted.notes = planned["notes"].get<std::vector<std::string>>();
    if (planned.contains("angles_deg")) table.served_angle_deg = planned["angles_deg"][1];
}

}  // namespace

const char* plan_schema_text() {
    return
#include "plan_schema.inc"
        ;
}

json planned_table(const SceneTable& table, const json& entry) {
    json planned = {{"id", table.id},
                    {"kind", table.kind_name()},
                    {"axes", json::array()},
                    {"notes", entry["notes"]}};
    for (json axis : entry["axes"]) {
        axis.erase("values");  // follow from the ends and the count
        axis.erase("mapping");
        planned["axes"].push_back(std::move(axis));
    }
    if (const auto angles = served_angles_of(entry); !angles.is_null())
        planned["angles_deg"] = angles;
    return planned;
}

std::string plan_text(const schemas::Scene& scene, json document) {
    document["irido"] = this_build().version;
    document["numbers"] = kNumbersVersion;
    document["scene"] = scene.name;
    document["source"] = source_of(scene);
    schemas::shorten_numbers(document);
    document["checksum"] = checksum_of_plan(document);
    // reasons may contain folder names
    return document.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

void use_plan(ScenePlan& plan, const schemas::Scene& scene, const std::string& path) {
    const std::string file = schemas::shown_path(path);
    const json document = schemas::parse_json(schemas::read_text(path), file);
    if (const auto problems = problems_in(document); !problems.empty())
        throw schemas::InputError(file, problems.front().pointer, problems.front().message);
    if (document["numbers"] != kNumbersVersion)
        throw schemas::InputError(
            file, "/numbers", "is of a version of irido with other numbers: plan the scene again");
    if (document["scene"] != scene.name || document["source"] != source_of(scene))
        throw schemas::InputError(file, "",
                                  "is the plan of another scene, " +
                                      document["source"].get<std::string>() + " " +
                                      document["scene"].dump());
    for (SceneTable& table : plan.tables) {
        const json& all = document["tables"];
        const auto planned =
            std::ranges::find_if(all, [&](const json& one) { return one["id"] == table.id; });
        if (planned != all.end() && !table.grid) take_size(table, *planned);
    }
}

std::vector<std::string> plan_problems(const json& document, const std::string& file) {
    std::vector<std::string> lines;
    for (const schemas::Problem& problem : problems_in(document))
        lines.emplace_back(schemas::InputError(file, problem.pointer, problem.message).what());
    return lines;
}

}  // namespace irido::tables
