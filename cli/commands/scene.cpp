#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>

#include "cli/options/color_options.hpp"
#include "cli/options/command.hpp"
#include "cli/options/long_work.hpp"
#include "cli/progress.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/error.hpp"
#include "schemas/documents/canonical_stack.hpp"
#include "schemas/documents/scene_document.hpp"
#include "tables/files/atomic_file.hpp"
#include "tables/shaders/scene/bake.hpp"
#include "tables/shaders/scene/plan_file.hpp"
#include "tables/shaders/scene/scene_error.hpp"
#include "tables/shaders/scene/scratched_material.hpp"

namespace irido::cli {

namespace {

using nlohmann::json;

constexpr int kMaterialFailed = 1;

struct SceneCommand {
    std::string scene;
    tables::BakePlace place;
    std::string format = "text", explained;
    std::string planned;  ///< file of a plan; "" without one
    bool force = false, verify = false, prune = false;
    unsigned threads = 0;
    bool strict = false, quiet = false;
};

std::string size_text(const json& axes) {
    std::string text;
    for (const json& axis : axes)
        text += (text.empty() ? "" : " x ") + std::to_string(axis["count"].get<std::size_t>());
    return text;
}

/// Number of samples of a table, including mip levels.
std::size_t samples_of_entry(const json& entry) {
    const json& axes = entry["axes"];
    const bool mips = entry.value("mips", false);
    std::size_t samples = 0;
    for (std::size_t level = 0; level < (mips ? axes[0]["count"].get<std::size_t>() : 1); ++level) {
        std::size_t of_level = 1;
        for (std::size_t a = mips ? 1 : 0; a < axes.size(); ++a)
            of_level *= std::max<std::size_t>(1, axes[a]["count"].get<std::size_t>() >> level);
        samples += of_level;
    }
    return samples;
}

/// Bytes of a table's numbers, without headers and metadata.
std::size_t bytes_of_entry(const json& entry, const std::string& format) {
    if (entry.contains("values")) return 0;
    if (entry["kind"] == tables::kGridKind) return entry["bytes"].get<std::size_t>();
    std::size_t channels = entry["channels"].size();
    if (format == "ktx2" && channels % 3 == 0) channels = channels / 3 * 4;
    const auto type = tables::find_lut_type(entry["dtype"].get<std::string>());
    return samples_of_entry(entry) * channels * tables::bytes_of(type.value());
}

/// One line of the plan.
struct PlanRow {
    std::size_t index = 0;  ///< of the table
    std::string materials, role, table, size;
    double bytes = 0, samples = 0;
    std::string state{};  ///< new, kept or numbers
    std::string why{};    ///< reason for being new, with -o
};

struct PlannedScene {
    tables::ScenePlan plan;
    tables::TableEntries entries;  ///< of the tables that can be made
    std::vector<PlanRow> rows;
    tables::MaterialFaults faults;
    std::vector<std::string> stale, notes;
    double seconds = 0;  ///< estimated time to make the new tables
};

std::string role_of(const tables::ScenePlan& plan, std::size_t table) {
    for (const tables::MaterialPlan& material : plan.materials)
        for (const tables::MaterialPlan::Use& use : material.tables)
            if (use.table == table) return use.role;
    return "";
}

/// For a loss: the largest Delta E 2000 between the shaded and the exact colour.
std::optional<double> delta_e_of(const schemas::Scene& scene, const tables::ScenePlan& plan,
                                 std::size_t m, const tables::Omission& loss,
                                 const SceneCommand& command) {
    constexpr std::size_t points = 300;
    const Execution execution = execution_of(command.threads);
    if (loss.delta_e) return loss.delta_e;
    if (loss.what == "dispersion")
        return tables::dispersion_difference(scene, scene.materials[m], execution);
    if (loss.what == tables::kProductOfColors)
        return tables::product_difference(
            scene, *scene.materials[m].scratches,
            tables::color_request_of(scene, scene.materials[m], execution));
    if (plan.materials[m].shading != schemas::Shading::fourier ||
        loss.what != tables::kPastCriticalAngle)
        return std::nullopt;
    const tables::SceneTable& table = plan.tables[plan.materials[m].tables.front().table];
    const tables::Lut lut =
        tables::make_lut(*table.kind, table.kind->plan(table.request), table.making);
    return tables::worst_fourier_difference(scene, scene.materials[m], plan.materials[m], &lut,
                                            execution, {points, 1, command.threads, false});
}

/// Plans one table: its row, and its entry.
void plan_table(const schemas::Scene& scene, PlannedScene& result, std::size_t t,
                const tables::Baked& before, const SceneCommand& command, StepProgress& progress) {
    tables::SceneTable& table = result.plan.tables[t];
    table.making.threads = command.threads;
    table.making.progress = [&progress](double done, const std::string& what) {
        progress.set(done, what);
    };
    tables::Keeping keeping;
    if (!command.place.folder.empty() && !command.force)
        keeping = tables::keeping_of(scene, result.plan, table, before, command.place, false);
    const bool is_kept = !keeping.entry.is_null();
    json entry = is_kept ? keeping.entry : tables::planned_entry(table);
    PlanRow row{t, joined(table.materials, ", "), role_of(result.plan, t), table.file,
                size_text(entry["axes"])};
    row.state = entry.contains("values") ? "numbers" : is_kept ? "kept" : "new";
    row.why = keeping.why;
    row.bytes = static_cast<double>(bytes_of_entry(entry, scene.format));
    if (!is_kept) {
        row.samples = entry["samples"].get<double>();
        result.seconds += entry["seconds"].get<double>();
    }
    result.rows.push_back(std::move(row));
    result.entries[table.id] = std::move(entry);
}

PlannedScene planned(const schemas::Scene& scene, const SceneCommand& command) {
    PlannedScene result;
    result.plan = tables::plan_scene(scene, execution_of(command.threads));
    result.faults = tables::faults_of(result.plan);
    tables::Baked before;
    if (!command.place.folder.empty()) before = tables::baked_scene(command.place, scene);
    if (!before.note.empty()) result.notes.push_back(before.note);
    const std::size_t count = result.plan.tables.size();
    StepProgress progress(command.quiet, count + 1);
    for (std::size_t t = 0; t < count; ++t) {
        const tables::SceneTable& table = result.plan.tables[t];
        progress.begin(table.materials.front());
        try {
            plan_table(scene, result, t, before, command, progress);
        } catch (const std::exception& error) {  // of any type: affects only these materials
            tables::add_faults(result.faults, scene, table, error);
        }
    }
    for (tables::SceneTable& table : result.plan.tables) table.making.progress = {};
    progress.begin("losses");
    for (tables::Omission& omission : result.plan.omissions) {
        const auto m =
            std::ranges::find(scene.materials, omission.material, &schemas::SceneMaterial::name);
        if (omission.kind == tables::Omission::Kind::loss)
            omission.delta_e = delta_e_of(scene, result.plan,
                                          static_cast<std::size_t>(m - scene.materials.begin()),
                                          omission, command);
    }
    if (!command.place.folder.empty())
        result.stale = tables::stale_files(command.place, before, result.entries);
    return result;
}

std::vector<tables::Omission> all_omissions(const PlannedScene& scene) {
    std::vector<tables::Omission> all;
    for (const tables::MaterialPlan& material : scene.plan.materials)
        std::ranges::move(tables::omissions_of(scene.plan, material, scene.entries),
                          std::back_inserter(all));
    return all;
}

/// Rounded to two significant digits, enough for a sampled maximum.
std::string two_digits(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2g", value);
    return to_text(std::stod(text.data()));
}

std::string delta_e_text(const tables::Omission& loss) {
    return loss.delta_e ? "Delta E " + two_digits(*loss.delta_e) : "";
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
        {"material", "role", "table", "size", "bytes", "cost", "state", ""}};
    double bytes = 0, samples = 0;
    for (const PlanRow& row : scene.rows) {
        cells.push_back({row.materials, row.role, row.table, row.size, to_text(row.bytes),
                         to_text(row.samples), row.state, row.why});
        bytes += row.bytes;
        samples += row.samples;
    }
    cells.push_back({"total", "", "", "", to_text(bytes), to_text(samples), "", ""});
    std::string out = aligned(cells);
    std::vector<std::vector<std::string>> losses, skipped, forms;
    for (const tables::MaterialPlan& material : scene.plan.materials)
        for (const tables::MaterialPlan::Use& use : material.tables)
            if (!use.why.empty() && !scene.faults.contains(material.name))
                forms.push_back({"  " + material.name, use.role, use.why});
    for (const tables::Omission& omission : all_omissions(scene)) {
        const std::string material = "  " + omission.material;
        if (omission.kind == tables::Omission::Kind::loss)
            losses.push_back({material, omission.what, delta_e_text(omission), omission.reason});
        if (omission.kind == tables::Omission::Kind::skipped)
            skipped.push_back({material, omission.what, omission.reason});
    }
    if (!forms.empty()) out += "chosen:\n" + aligned(forms);
    if (!losses.empty()) out += "losses:\n" + aligned(losses);
    if (!skipped.empty()) out += "skipped:\n" + aligned(skipped);
    if (!scene.stale.empty()) out += "stale, removed by bake --prune:\n";
    for (const std::string& file : scene.stale) out += "  " + file + "\n";
    return out;
}

json json_of(const PlannedScene& scene) {
    json tables = json::array(), skipped = json::array(), losses = json::array(),
         chosen = json::array();
    for (const tables::MaterialPlan& material : scene.plan.materials)
        for (const tables::MaterialPlan::Use& use : material.tables)
            if (!use.why.empty() && !scene.faults.contains(material.name))
                chosen.push_back(
                    {{"material", material.name}, {"role", use.role}, {"reason", use.why}});
    for (const PlanRow& row : scene.rows) {
        const tables::SceneTable& table = scene.plan.tables[row.index];
        json line = tables::planned_table(table, scene.entries.at(table.id));
        line.update({{"materials", row.materials},
                     {"role", row.role},
                     {"table", row.table},
                     {"size", row.size},
                     {"bytes", row.bytes},
                     {"cost", row.samples},
                     {"state", row.state},
                     {"why", row.why}});
        tables.push_back(std::move(line));
    }
    for (const tables::Omission& omission : all_omissions(scene)) {
        json line = {
            {"material", omission.material}, {"what", omission.what}, {"reason", omission.reason}};
        if (omission.delta_e) line["delta_e"] = *omission.delta_e;
        (omission.kind == tables::Omission::Kind::loss ? losses : skipped)
            .push_back(std::move(line));
    }
    json faults = json::object();
    for (const auto& [name, all] : scene.faults)
        for (const schemas::SceneFault& fault : all)
            faults[name].push_back({{"pointer", fault.pointer}, {"reason", fault.reason}});
    return {{"tables", tables},   {"chosen", chosen},     {"losses", losses},
            {"skipped", skipped}, {"stale", scene.stale}, {"faults", faults}};
}

std::string axis_text(const json& axis) {
    const std::string unit = axis["unit"].get<std::string>();
    return "    " + axis["name"].get<std::string>() + ": " +
           std::to_string(axis["count"].get<std::size_t>()) + " from " +
           to_text(axis["first"].get<double>()) + " to " + to_text(axis["last"].get<double>()) +
           (unit.empty() ? "" : " " + unit) + "\n";
}

/// The details of one material, for --explain.
std::string explained(const schemas::Scene& scene, const PlannedScene& planned,
                      const std::string& name) {
    const auto material = std::ranges::find(scene.materials, name, &schemas::SceneMaterial::name);
    if (material == scene.materials.end()) {
        std::vector<std::string_view> names;
        for (const schemas::SceneMaterial& m : scene.materials) names.push_back(m.name);
        throw UsageError("--explain: " + not_one_of(names, name));
    }
    const tables::MaterialPlan& plan =
        *std::ranges::find(planned.plan.materials, name, &tables::MaterialPlan::name);
    std::string out = name + ": shading " + std::string(name_of(plan.shading)) + ", angles " +
                      to_text(material->angles_deg.first) + " to " +
                      to_text(material->angles_deg.last) + " degrees\n";
    if (!material->document.stack.materials.empty())
        out += std::string(material->scratches ? "  base " : "  stack ") +
               schemas::canonical_stack(material->document.stack).dump() + "\n";
    for (const schemas::VariedRange& vary : material->vary)
        out += "  varies " + vary.path + " from " + to_text(vary.range.first) + " to " +
               to_text(vary.range.last) + "\n";
    for (const tables::MaterialPlan::Use& use : plan.tables) {
        const tables::SceneTable& table = planned.plan.tables[use.table];
        const auto entry = planned.entries.find(table.id);
        out += "  table " + use.role + ": " + table.file +
               (table.grid
                    ? ", of " + to_text(static_cast<double>(table.grid->scratches.size())) +
                          " scratches"
                    : ", interpolation error at most " + to_text(*table.making.sizing.tolerance)) +
               "\n";
        if (!use.why.empty()) out += "    " + use.why + "\n";
        if (entry == planned.entries.end()) continue;
        for (const json& axis : entry->second["axes"]) out += axis_text(axis);
        const json& error = entry->second["error"];
        if (error.is_object() && error.contains("levels")) {
            std::vector<std::string> levels;
            for (const json& level : error["levels"])
                levels.push_back(two_digits(level.get<double>()));
            out += "    error of each mip level: " + joined(levels, ", ") + " (" +
                   error["measure"].get<std::string>() + ")\n";
        }
    }
    if (!plan.constants.empty()) out += "  constants " + plan.constants.dump() + "\n";
    if (!plan.snippets.empty()) out += "  snippets " + joined(plan.snippets, ", ") + "\n";
    for (const tables::Omission& omission : all_omissions(planned)) {
        if (omission.material != name) continue;
        const bool is_loss = omission.kind == tables::Omission::Kind::loss;
        const std::string delta_e = delta_e_text(omission);
        out += (is_loss ? "  loss " : "  skipped ") + omission.what + ": " + omission.reason +
               (delta_e.empty() ? "" : ", " + delta_e) + "\n";
    }
    return out;
}

int report_faults(const schemas::Scene& scene, const tables::MaterialFaults& faults) {
    if (faults.empty()) return 0;
    for (const schemas::SceneMaterial& material : scene.materials)
        if (const auto found = faults.find(material.name); found != faults.end())
            for (const schemas::SceneFault& fault : found->second)
                print_error(schemas::fault_text(scene, material.name, fault));
    print_error(scene.file + ": " + std::to_string(faults.size()) + " of " +
                std::to_string(scene.materials.size()) + " materials failed");
    return kMaterialFailed;
}

/// Reads the scene; a material that colours clamp to its end values is noted or, if that is to be
/// refused, at fault.
schemas::Scene scene_of(const SceneCommand& command) {
    schemas::Scene scene = schemas::read_scene(command.scene);
    Notes notes(command.quiet);
    for (const std::string& text : scene.notes) notes(text);
    const Sensitivity sensitivity(observer(scene.observer_deg), illuminant(scene.illuminant));
    for (schemas::SceneMaterial& material : scene.materials) {
        if (!material.faults.empty()) continue;
        std::vector<std::string> clamped;
        try {
            report_held_ranges(material.document, sensitivity, command.strict,
                               [&](const std::string& text) { clamped.push_back(text); });
        } catch (const schemas::InputError& error) {
            material.faults.push_back(schemas::fault_of(material, error));
        }
        for (const std::string& text : clamped)
            notes(scene.file + ": material " + material.name + ": " + text);
    }
    return scene;
}

/// The plan goes to standard output: the folder is one of an earlier bake, or not there yet.
void require_folder(const std::string& folder) {
    std::error_code ignored;
    if (std::filesystem::exists(folder, ignored) && !std::filesystem::is_directory(folder, ignored))
        throw UsageError("--output: must name a folder (got '" + folder +
                         "'); the plan goes to standard output");
}

int run_plan(const SceneCommand& command) {
    constexpr std::array<std::string_view, 2> formats{"text", "json"};
    if (std::ranges::find(formats, command.format) == formats.end())
        throw UsageError("--format: " + not_one_of(formats, command.format));
    require_folder(command.place.folder);
    const schemas::Scene scene = scene_of(command);
    const PlannedScene result = planned(scene, command);
    for (const std::string& text : result.notes) note(text, command.quiet);
    std::string text;
    if (!command.explained.empty())
        text = explained(scene, result, command.explained);
    else
        text =
            command.format == "json" ? tables::plan_text(scene, json_of(result)) : text_of(result);
    tables::write_stdout(text);
    if (result.seconds > 0)
        note("making the new tables will take about " + coarse_time(result.seconds), command.quiet);
    return report_faults(scene, result.faults);
}

/// Announces a bake that will take long.
void note_long_bake(const schemas::Scene& scene, const tables::ScenePlan& plan,
                    const SceneCommand& command) {
    const auto say = [&](const std::string& text) { note(text, command.quiet); };
    const tables::Baked before = tables::baked_scene(command.place, scene);
    const double share = 1 / static_cast<double>(std::max<std::size_t>(1, plan.tables.size()));
    double seconds = 0;
    for (const tables::SceneTable& table : plan.tables) {
        if (table.grid || (!command.force && before.tables.contains(table.id))) continue;
        if (is_slow(*table.kind, table.request)) return say(kSlowNote);
        try {
            tables::LutMaking making = table.making;
            making.threads = command.threads;
            seconds += least_seconds(table.kind->plan(table.request), making, share);
        } catch (const std::exception&) {  // the bake will report it
        }
    }
    note_long_work(seconds, true, say);
}

/// Names the tables whose sizes had to be looked for, although there is a plan.
void note_unplanned(const tables::ScenePlan& plan, const tables::BakeResult& result,
                    const SceneCommand& command) {
    for (const tables::SceneTable& table : plan.tables) {
        const bool is_made = std::ranges::any_of(
            result.made, [&](const std::string& made) { return made.starts_with(table.file); });
        if (is_made && !table.grid && !table.making.sizing.fitted)
            note(schemas::shown_path(command.planned) + ": does not have " + table.file + " of " +
                     joined(table.materials, ", ") + ": its size was looked for",
                 command.quiet);
    }
}

int run_bake(const SceneCommand& command) {
    const schemas::Scene scene = scene_of(command);
    tables::ScenePlan plan = tables::plan_scene(scene, execution_of(command.threads));
    if (!command.planned.empty()) tables::use_plan(plan, scene, command.planned);
    note_long_bake(scene, plan, command);
    Progress progress(command.quiet);
    const tables::BakeRequest request{command.place,
                                      command.force,
                                      command.verify,
                                      command.prune,
                                      command.threads,
                                      [&progress](double done, const std::string& text) {
            progress.set(done, text); }};
    const tables::BakeResult result = tables::bake(scene, plan, request);
    progress.clear();
    for (const std::string& text : result.notes) note(text, command.quiet);
    if (!command.planned.empty()) note_unplanned(plan, result, command);
    if (!command.quiet) {
        for (const std::string& file : result.made) std::cerr << "irido: made " << file << '\n';
        for (const std::string& file : result.pruned)
            std::cerr << "irido: removed " << file << '\n';
        std::cerr << "irido: " << result.made.size() << " made, " << result.kept.size() << " kept"
                  << (result.manifest_written ? ", " + command.place.manifest + " written" : "")
                  << '\n';
    }
    return report_faults(scene, result.faults);
}

/// The manifest's file name, with .json appended if missing.
std::string manifest_name(std::string typed) {
    if (!typed.ends_with(".json")) typed += ".json";
    const bool is_name = typed.front() != '.' && std::ranges::all_of(typed, [](unsigned char c) {
                             return std::isalnum(c) || c == '.' || c == '-' || c == '_';
                         });
    const std::size_t longest = 200;
    if (!is_name || typed.size() > longest)
        throw UsageError(
            "--manifest: must be a file name of letters, digits, ., - and _ that does not begin "
            "with . (got '" +
            typed + "')");
    return typed;
}

void add_manifest_option(CLI::App& command, SceneCommand& typed) {
    command
        .add_option_function<std::string>(
            "--manifest",
            [&typed](const std::string& name) { typed.place.manifest = manifest_name(name); },
            "file name of the manifest; each scene baked into the same folder needs\n"
            "its own [manifest.json]")
        ->type_name("FILE");
}

void add_common(CLI::App& command, SceneCommand& typed) {
    command
        .add_option("SCENE", typed.scene, "scene file (.json; see irido validate --schema scene)")
        ->required();
    add_threads_option(command, typed.threads);
    add_strict_option(command, typed.strict);
    add_quiet_option(command, typed.quiet, "no notes and no progress");
}

}  // namespace

void add_plan_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "plan", "Show the tables that a scene needs, and what is left out and why.");
    const auto typed = std::make_shared<SceneCommand>();
    add_common(*command, *typed);
    command
        ->add_option("-o,--output", typed->place.folder,
                     "folder of an earlier bake: show which tables would be kept")
        ->type_name("DIR");
    add_manifest_option(*command, *typed);
    command->add_option("-f,--format", typed->format, "text or json [text]")->type_name("FORMAT");
    offer(*command, "format", "text json");
    command->add_option("--explain", typed->explained, "show the details of one material")
        ->type_name("MATERIAL");
    set_examples(
        *command, {"irido plan vehicle.json", "irido plan vehicle.json --explain rim"},
        "size: samples along the axes; bytes: size of the table's numbers, of a grid with its\n"
        "companion; cost: number of evaluations of the table's function; state: new, kept\n"
        "(with -o; new ones show the reason), or numbers (stored in the manifest). losses:\n"
        "where shading differs from the scene's description, with the largest Delta E 2000\n"
        "found; mip levels are estimated where a single thickness would be worst. Omissions\n"
        "that the scene itself requests appear with --explain only. The estimated time is\n"
        "printed on standard error.");
    set_run(*command, run, typed, run_plan);
}

void add_bake_command(CLI::App& program, Run& run) {
    CLI::App* command =
        program.add_subcommand("bake", "Write all tables that a scene needs, and nothing else.");
    const auto typed = std::make_shared<SceneCommand>();
    add_common(*command, *typed);
    command
        ->add_option("-o,--output", typed->place.folder,
                     "folder for the tables and manifest.json, made if there is none")
        ->type_name("DIR")
        ->required();
    add_manifest_option(*command, *typed);
    command
        ->add_option("--plan", typed->planned,
                     "sizes of the tables, from irido plan SCENE -f json: the same bytes,\n"
                     "without the trials that find the sizes; - is standard input")
        ->type_name("FILE");
    command->add_flag("--force", typed->force, "remake every table");
    command->add_flag("--verify", typed->verify, "read the kept tables and verify their checksums");
    command->add_flag("--prune", typed->prune,
                      "remove tables of this scene that no material\nneeds any more");
    set_examples(
        *command,
        {"irido bake vehicle.json -o tables", "irido bake vehicle.json -o tables --plan plan.json"},
        "Tables whose inputs are unchanged are kept: files of the size recorded in the manifest\n"
        "and not touched since are trusted, others are read, and with --verify all are. The\n"
        "folder belongs to irido: anything else in a table's place is replaced, symbolic links\n"
        "included. An interrupted bake resumes where it stopped. If a material fails, the\n"
        "others are made, the manifest gives the reason and the exit status is 1. Several\n"
        "scenes can share a folder if each has its own --manifest; --prune removes nothing\n"
        "that another manifest lists. A --plan must be of this scene; tables that have\n"
        "changed since are measured, and a note names them.");
    set_run(*command, run, typed, run_bake);
}

}  // namespace irido::cli
