#include <algorithm>
#include <iostream>
#include <memory>

#include "cli/command.hpp"
#include "cli/progress.hpp"
#include "core/error.hpp"
#include "schemas/canonical_stack.hpp"
#include "schemas/nearest.hpp"
#include "schemas/scene_document.hpp"
#include "tables/atomic_file.hpp"
#include "tables/scene/bake.hpp"

namespace irido {

namespace {

using nlohmann::json;

constexpr int kMaterialFailed = 1;

struct SceneCommand {
    std::string scene, folder;
    std::string format = "text", explained;
    bool force = false, verify = false, prune = false;
    unsigned threads = 0;
    bool quiet = false;
};

std::string size_text(const json& axes) {
    std::string text;
    for (const json& axis : axes)
        text += (text.empty() ? "" : " x ") + std::to_string(axis["count"].get<std::size_t>());
    return text;
}

/// Bytes of a table's numbers in its file, for a plan.
std::size_t bytes_of_plan(const json& entry, const std::string& format) {
    std::size_t channels = entry["channels"].size();
    if (format == "ktx2" && channels % 3 == 0) channels = channels / 3 * 4;
    const std::string type = entry["dtype"].get<std::string>();
    const std::size_t bytes = type == "f16" ? 2 : type == "f32" ? 4 : 8;
    return entry["samples"].get<std::size_t>() * channels * bytes;
}

/// One line of the plan.
struct PlanRow {
    std::string materials, role, table, size;
    double bytes = 0, samples = 0;
    std::string state;  ///< new, kept or numbers
};

struct PlannedScene {
    ScenePlan plan;
    TableEntries entries;  ///< of tables that can be made
    std::vector<PlanRow> rows;
    std::map<std::string, std::string> faults;
};

std::string role_of(const ScenePlan& plan, std::size_t table) {
    for (const MaterialPlan& material : plan.materials)
        for (const MaterialPlan::Use& use : material.tables)
            if (use.table == table) return use.role;
    return "";
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

PlanRow row_of(const Scene& scene, const ScenePlan& plan, std::size_t t, const json& entry,
               bool kept) {
    const SceneTable& table = plan.tables[t];
    PlanRow row{
        joined(table.materials), role_of(plan, t), table.file, size_text(entry["axes"]), 0, 0, ""};

    row.state = entry.contains("values") ? "numbers" : kept ? "kept" : "new";
    if (entry.contains("bytes"))
        row.bytes = entry["bytes"].get<double>();
    else if (!entry.contains("values"))
        row.bytes = static_cast<double>(bytes_of_plan(entry, scene.format));
    if (!kept) row.samples = entry["samples"].get<double>();
    return row;
}

PlannedScene planned(const Scene& scene, const SceneCommand& command) {
    PlannedScene result;
    result.plan = plan_scene(scene, execution_of(command.threads));
    const TableEntries before =
        command.folder.empty() || command.force ? TableEntries() : baked_tables(command.folder);
    for (const MaterialPlan& material : result.plan.materials)
        if (!material.fault.empty()) result.faults[material.name] = material.fault;
    for (std::size_t t = 0; t < result.plan.tables.size(); ++t) {
        SceneTable& table = result.plan.tables[t];
        const auto old = before.find(table.id);
        try {
            const bool kept =
                old != before.end() && is_kept(table, old->second, command.folder, false);
            table.making.threads = command.threads;
            json entry = kept ? old->second : planned_entry(table);
            result.rows.push_back(row_of(scene, result.plan, t, entry, kept));
            result.entries[table.id] = std::move(entry);
        } catch (const std::runtime_error& error) {  // LutError, InputError, DomainError
            for (const std::string& name : table.materials) result.faults[name] = error.what();
        }
    }
    return result;
}

std::vector<Omission> all_omissions(const PlannedScene& scene) {
    std::vector<Omission> all;
    for (const MaterialPlan& material : scene.plan.materials)
        std::ranges::move(omissions_of(scene.plan, material, scene.entries),
                          std::back_inserter(all));
    return all;
}

void append_cells(std::string& out, const std::vector<std::string>& cells,
                  const std::vector<std::size_t>& widths) {
    std::string line;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        line += cells[c];
        if (c + 1 < cells.size()) line.append(widths[c] + 2 - cells[c].size(), ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
}

std::string aligned(const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> widths(rows.front().size());
    for (const auto& row : rows)
        for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
    std::string out;
    for (const auto& row : rows) append_cells(out, row, widths);
    return out;
}

std::string text_of(const PlannedScene& scene) {
    std::vector<std::vector<std::string>> cells{
        {"material", "role", "table", "size", "bytes", "cost", "state"}};
    double bytes = 0, samples = 0;
    for (const PlanRow& row : scene.rows) {
        cells.push_back({row.materials, row.role, row.table, row.size, to_text(row.bytes),
                         to_text(row.samples), row.state});
        bytes += row.bytes;
        samples += row.samples;
    }
    cells.push_back({"total", "", "", "", to_text(bytes), to_text(samples), ""});
    std::string out = aligned(cells);
    std::vector<std::vector<std::string>> skipped;
    for (const Omission& omission : all_omissions(scene))
        skipped.push_back({"  " + omission.material, omission.what, omission.reason});
    if (!skipped.empty()) out += "skipped:\n" + aligned(skipped);
    return out;
}

json json_of(const PlannedScene& scene) {
    json tables = json::array(), skipped = json::array();
    for (const PlanRow& row : scene.rows)
        tables.push_back({{"materials", row.materials},
                          {"role", row.role},
                          {"table", row.table},
                          {"size", row.size},
                          {"bytes", row.bytes},
                          {"cost", row.samples},
                          {"state", row.state}});
    for (const Omission& omission : all_omissions(scene))
        skipped.push_back({{"material", omission.material},
                           {"what", omission.what},
                           {"reason", omission.reason}});
    return {{"tables", tables}, {"skipped", skipped}, {"faults", scene.faults}};
}

std::string axis_text(const json& axis) {
    const std::string unit = axis["unit"].get<std::string>();
    return "    " + axis["name"].get<std::string>() + ": " +
           std::to_string(axis["count"].get<std::size_t>()) + " from " +
           to_text(axis["first"].get<double>()) + " to " + to_text(axis["last"].get<double>()) +
           (unit.empty() ? "" : " " + unit) + "\n";
}

/// The long form for one material.
std::string explained(const Scene& scene, const PlannedScene& planned, const std::string& name) {
    const auto material = std::ranges::find(scene.materials, name, &SceneMaterial::name);
    if (material == scene.materials.end()) {
        std::vector<std::string> names;
        for (const SceneMaterial& m : scene.materials) names.push_back(m.name);
        throw UsageError("--explain: there is no material '" + name + "'" +
                         did_you_mean(name, names));
    }
    const MaterialPlan& plan =
        *std::ranges::find(planned.plan.materials, name, &MaterialPlan::name);
    std::string out = name + ": shading " + std::string(name_of(plan.shading)) + ", angles " +
                      to_text(material->angles_deg.first) + " to " +
                      to_text(material->angles_deg.last) + " degrees\n";
    out += "  stack " + canonical_stack(material->document.stack).dump() + "\n";
    for (const VariedRange& vary : material->vary)
        out += "  varies " + vary.path + " from " + to_text(vary.range.first) + " to " +
               to_text(vary.range.last) + "\n";
    for (const MaterialPlan::Use& use : plan.tables) {
        const SceneTable& table = planned.plan.tables[use.table];
        const auto entry = planned.entries.find(table.id);
        out += "  table " + use.role + ": " + table.file + ", interpolation error at most " +
               to_text(*table.making.sizing.tolerance) + "\n";
        if (entry == planned.entries.end()) continue;
        for (const json& axis : entry->second["axes"]) out += axis_text(axis);
    }
    if (!plan.constants.empty()) out += "  constants " + plan.constants.dump() + "\n";
    if (!plan.snippets.empty()) out += "  snippets " + joined(plan.snippets) + "\n";
    for (const Omission& omission : all_omissions(planned))
        if (omission.material == name)
            out += "  skipped " + omission.what + ": " + omission.reason + "\n";
    return out;
}

int report_faults(const std::map<std::string, std::string>& faults, std::size_t materials) {
    if (faults.empty()) return 0;
    for (const auto& [name, fault] : faults)
        print_error("material " + name + ": " + fault);
    std::cerr << "irido: error: " << faults.size() << " of " << materials << " materials failed\n";
    return kMaterialFailed;
}

Scene scene_of(const SceneCommand& command) {
    Scene scene = read_scene(command.scene);
    for (const std::string& text : scene.notes) note(text, command.quiet);
    return scene;
}

int run_plan(const SceneCommand& command) {
    if (command.format != "text" && command.format != "json")
        throw UsageError("--format: must be one of text, json (got '" + command.format + "')");
    const Scene scene = scene_of(command);
    const PlannedScene result = planned(scene, command);
    std::string text;
    if (!command.explained.empty())
        text = explained(scene, result, command.explained);
    else
        text = command.format == "json" ? json_of(result).dump(2) + "\n" : text_of(result);
    write_stdout(text);
    return report_faults(result.faults, scene.materials.size());
}

int run_bake(const SceneCommand& command) {
    const Scene scene = scene_of(command);
    const ScenePlan plan = plan_scene(scene, execution_of(command.threads));
    Progress progress(command.quiet);
    BakeRequest request{command.folder,  command.force,
                        command.verify,  command.prune,
                        command.threads, [&progress](double done) { progress.set(done); }};
    const BakeResult result = bake(scene, plan, request);
    progress.clear();
    if (!command.quiet) {
        for (const std::string& file : result.made) std::cerr << "irido: made " << file << '\n';
        for (const std::string& file : result.pruned)
            std::cerr << "irido: removed " << file << '\n';
        std::cerr << "irido: " << result.made.size() << " made, " << result.kept.size() << " kept"
                  << (result.manifest_written ? ", manifest.json written" : "") << '\n';
    }
    return report_faults(result.faults, scene.materials.size());
}

void add_common(CLI::App& command, SceneCommand& typed) {
    command
        .add_option("SCENE", typed.scene,
                    "scene file (.json; irido validate --schema scene explains it)")
        ->required();
    add_threads_option(command, typed.threads);
    command.add_flag("--quiet", typed.quiet, "no notes on standard error");
}

}  // namespace

void add_plan_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "plan", "What a scene's tables will be, and what is left out and why.");
    const auto typed = std::make_shared<SceneCommand>();
    add_common(*command, *typed);
    command->add_option("-o,--output", typed->folder, "folder of a bake: says what would be kept")
        ->type_name("DIR");
    command->add_option("-f,--format", typed->format, "text or json [text]")->type_name("FORMAT");
    command->add_option("--explain", typed->explained, "the long form for one material")
        ->type_name("NAME");
    set_examples(*command, {"irido plan vehicle.json", "irido plan vehicle.json --explain rim"},
                 "size: samples along the axes; cost: how often the table's function will be\n"
                 "computed; state: new, kept (with -o), or numbers in the manifest.");
    command->callback([typed, &run] { run = [typed] { return run_plan(*typed); }; });
}

void add_bake_command(CLI::App& program, Run& run) {
    CLI::App* command =
        program.add_subcommand("bake", "Writes all tables that a scene needs, and nothing else.");
    const auto typed = std::make_shared<SceneCommand>();
    add_common(*command, *typed);
    command->add_option("-o,--output", typed->folder, "folder for the tables and manifest.json")
        ->type_name("DIR")
        ->required();
    command->add_flag("--force", typed->force, "make every table again");
    command->add_flag("--verify", typed->verify,
                      "read the tables that are kept and compare their checksums");
    command->add_flag("--prune", typed->prune, "remove tables that no material needs");
    set_examples(
        *command,
        {"irido bake vehicle.json -o tables", "irido bake vehicle.json -o tables --prune --quiet"},
        "Tables whose inputs are unchanged stay as they are: files of the size that the\n"
        "manifest says and not newer than it are believed, newer ones are read, and all\n"
        "with --verify. A bake that was interrupted goes on where it was. If a material\n"
        "fails, the others are made, the old manifest stays and the exit status is 1.");
    command->callback([typed, &run] { run = [typed] { return run_bake(*typed); }; });
}

}  // namespace irido
