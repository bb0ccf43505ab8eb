#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/options/design_options.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/options/search_end.hpp"
#include "cli/options/shard.hpp"
#include "cli/queries/design_report.hpp"
#include "core/design/needle.hpp"
#include "core/design/problem_values.hpp"
#include "core/error.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/text_file.hpp"
#include "tables/files/atomic_file.hpp"

namespace irido::cli {

namespace {

using nlohmann::json;

struct DesignCommand {
    TaskOptions task;
    OutputOptions output;
    std::string report;
    std::optional<std::string> plot;
    std::string shard;
    std::vector<std::string> merge;
    unsigned threads = 0;
    bool quiet = false;
};

/// Searches with needles; `task` becomes that of the resulting stack.
SearchResult synthesized(schemas::DesignTask& task, const SearchSettings& search,
                         const SearchEnd& end) {
    NeedleSettings settings;
    settings.search = search;
    settings.materials = task.materials;
    settings.max_layers = task.max_layers;
    settings.min_thickness_nm = task.min_thickness_nm;
    double highest = 0;
    for (const FreeValue& value : task.problem.free) highest = std::max(highest, value.high);
    if (std::isfinite(highest)) settings.max_thickness_nm = highest;
    const NeedleResult needles = needle_search(task.problem, settings);
    std::vector<schemas::OtherLayer> layers;
    for (const NeedleLayer& layer : needles.layers) {
        layers.push_back({std::nullopt, layer.material, layer.thickness_nm});
        if (layer.origin != NeedleLayer::kNew) layers.back().origin = layer.origin;
    }
    task = schemas::with_layers(
        task, layers,
        problem_of_layers(task.problem, needles.layers, settings.min_thickness_nm,
                          settings.max_thickness_nm));
    SearchResult result;
    if (!task.problem.free.empty() && !end()) result = refine(task.problem, search);
    if (result.x.empty())
        for (const FreeValue& value : task.problem.free) result.x.push_back(value.start);
    result.evaluations += needles.evaluations;
    result.runs.clear();
    for (const double merit : needles.runs) result.runs.push_back({{}, merit});
    result.runs_within = needles.runs_within;
    result.is_stopped = needles.is_stopped;
    return result;
}

SearchResult searched(schemas::DesignTask& task, const SearchEnd& end,
                      const DesignCommand& command) {
    Progress progress(command.quiet);
    SearchSettings settings = search_settings(task, end, progress, command.threads);
    settings.first_run = kSearchRuns * (parse_shard(command.shard).number - 1);
    try {
        if (task.method == "needle") return synthesized(task, settings, end);
        return task.method == "refine" ? refine(task.problem, settings)
                                       : search(task.problem, settings);
    } catch (const DomainError& error) {
        throw schemas::InputError(task.file, "", error.what());
    }
}

/// For each value, the change of the merit when it is 1 % off.
json sensitivity_of(const schemas::DesignTask& task, const std::vector<double>& x) {
    DesignModel model(task.problem);
    model.adapt_colors(x, 1e-4);
    json all = json::array();
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (task.problem.free[i].is_integer) continue;
        const auto merit_at = [&](double factor) -> json {
            std::vector<double> moved = x;
            moved[i] *= factor;
            const double merit = model.merit(model.objective(moved));
            return std::isfinite(merit) ? json(merit) : json();
        };
        all.push_back({{"name", task.problem.free[i].name},
                       {"value", x[i]},
                       {"merit_1_percent_less", merit_at(0.99)},
                       {"merit_1_percent_more", merit_at(1.01)}});
    }
    return all;
}

/// The record of how the result was obtained. `merit` is exact.
json design_member(const schemas::DesignTask& task, const SearchResult& result, double start_merit,
                   double merit, const MetTargets& met) {
    json design{{"merit", merit},
                {"start_merit", start_merit},
                {"method", task.method},
                {"evaluations", result.evaluations},
                {"end", result.is_stopped ? "stopped" : std::string(words_of(result.end))},
                {"targets", met.all},
                {"targets_met", met.met},
                {"sensitivity", sensitivity_of(task, result.x)}};
    if (task.method == "refine") return design;
    design["seed"] = task.seed;
    design["runs"] = result.runs.size();
    design["reproducibility"] = result.runs_within;
    bool has_integers = false;
    for (const FreeValue& value : task.problem.free)
        has_integers = has_integers || value.is_integer;
    constexpr std::size_t kMostOthers = 8;
    json runs = json::array();
    for (const SearchRun& run : result.runs) {
        if (runs.size() == kMostOthers) break;
        if (!has_integers) {
            runs.push_back(run.merit);
            continue;
        }
        json one{{"merit", run.merit}};
        for (std::size_t i = 0; i < run.x.size(); ++i)
            one["values"][task.problem.free[i].name] = run.x[i];
        runs.push_back(std::move(one));
    }
    design["best_of_runs"] = std::move(runs);
    return design;
}

/// Merges the results of shards: the best one, with the runs of all.
int merge_designs(const DesignCommand& command) {
    if (!command.task.task.empty() || !command.task.refine.empty() || !command.shard.empty())
        throw UsageError("--merge: cannot be combined with TASK, --refine and --shard");
    json best;
    std::vector<double> runs;
    double evaluations = 0, run_count = 0;
    std::string folder;
    for (const std::string& file : command.merge) {
        json one = schemas::parse_json(schemas::read_text(file), schemas::shown_path(file));
        try {
            const json& design = one.at("design");
            for (const json& run : design.at("best_of_runs"))
                runs.push_back(run.is_number() ? run.get<double>() : run.value("merit", 0.0));
            evaluations += design.value("evaluations", 0.0);
            run_count += design.value("runs", 0.0);
            const double merit = design.at("merit").get<double>();
            if (!best.is_null() && merit >= best["design"]["merit"]) continue;
        } catch (const json::exception&) {  // keys that are missing or of another type
            throw schemas::InputError(schemas::shown_path(file), "/design",
                                      "must be the result of a search by irido design");
        }
        best = std::move(one);
        folder = std::filesystem::path(file).parent_path().string();
    }
    check_result_files(command.output, "", {});
    json& design = best["design"];
    std::ranges::sort(runs);
    design["evaluations"] = evaluations;
    design["runs"] = run_count;
    design["reproducibility"] = std::ranges::count_if(
        runs, [&](double merit) { return merit <= design["merit"].get<double>() * 1.01 + 1e-12; });
    schemas::move_files(best, folder,
                        std::filesystem::path(command.output.file).parent_path().string());
    schemas::shorten_numbers(best);
    write_bytes(best.dump(2) + "\n", command.output, false);
    return 0;
}

int run_design(const DesignCommand& command) {
    if (!command.merge.empty()) return merge_designs(command);
    schemas::DesignTask task = read_task(command.task);
    note_task(task, command.task.strict, command.quiet);
    check_result_files(command.output, command.report, command.plot);
    const SearchEnd end(task.time_s);
    std::vector<double> start;
    for (const FreeValue& value : task.problem.free)
        start.push_back(std::clamp(value.start, value.low, value.high));
    const auto merit_at = [&](const std::vector<double>& x, DesignRows& of) {
        try {
            return exact_merit(task.problem, x, &of);
        } catch (const DomainError& error) {
            throw schemas::InputError(task.file, "", error.what());
        }
    };
    DesignRows start_rows, rows;
    const double start_merit = merit_at(start, start_rows);
    const schemas::DesignTask before = task;
    SearchResult result = searched(task, end, command);
    if (end.signal() != 0 && command.output.file.empty()) return 128 + end.signal();
    double merit = merit_at(result.x, rows);
    if (merit > start_merit) {
        task = before;
        result.x = start;
        merit = start_merit;
        rows = start_rows;
    }
    const tables::Records report = target_report(task, rows);
    for (const std::string& line : summary_lines(report)) note(line, command.quiet);
    const std::string text = designed_text(
        task, result.x, design_member(task, result, start_merit, merit, met_targets(report)),
        command.output.file);
    std::string picture;
    if (command.plot)
        picture = picture_bytes([&] { return target_figure(task, report, false); }, {},
                                picture_format_of("--plot", *command.plot), *command.plot);
    write_bytes(text, command.output, false);
    if (!command.report.empty()) write_records(report, {command.report, ""});
    if (command.plot) tables::write_file(*command.plot, picture);
    return end.signal() != 0 ? 128 + end.signal() : 0;
}

}  // namespace

void add_design_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "design", "Find the thicknesses, indices and repeats with which a stack meets targets.");
    const auto options = std::make_shared<DesignCommand>();
    add_task_options(*command, options->task);
    add_needle_options(*command, options->task);
    command
        ->add_option_function<std::string>(
            "-o,--output",
            [options](const std::string& file) { options->output.file = file == "-" ? "" : file; },
            "write the stack there (.json), - being standard output; after Ctrl-C the\n"
            "best so far [-]")
        ->type_name("FILE");
    command
        ->add_option("--report", options->report,
                     "a table of values beside their targets (.csv, .json, ...)")
        ->type_name("FILE");
    command->add_option("--plot", options->plot, "a picture of the same (.svg, .png, .pdf)")
        ->type_name("FILE");
    command
        ->add_option("--shard", options->shard,
                     "eight other runs for every K of 1 to N: shards together are one long\n"
                     "search; for --merge")
        ->type_name("K/N");
    command
        ->add_option("--merge", options->merge,
                     "write the best of the results of shards, instead of a search")
        ->type_name("FILE");
    add_threads_option(*command, options->threads);
    add_quiet_option(*command, options->quiet, "no notes and no progress");
    set_examples(
        *command,
        {"irido design task.json -o best.json --report report.csv --plot best.svg",
         "irido design \"air | MgF2@90 | TiO2@20 | MgF2@30 | TiO2@10 | BK7\" --method global\n"
         "      --free layers.*.thickness_nm=0:250 --target \"R 400:700:5 = 0\" -o best.json",
         "irido design \"air | SiO2@400 | BK7\" --method needle --materials SiO2,TiO2\n"
         "      --free layers.0.thickness_nm --target \"R 400:700:5 = 0\" --max-layers 8",
         "irido design --refine best.json --target \"R 400:700:5 @0,30 = 0\" -o better.json"},
        "The result is a stack for every command, with a member \"design\": merit, evaluations,\n"
        "how many of the runs came to within 1 % of the best (reproducibility), and for each\n"
        "value the merit where it is 1 % off. --report: a value counts as met within its sigma,\n"
        "or without any within 0.01 of R, T and A and 1 of all others.");
    set_run(*command, run, options, run_design);
}

}  // namespace irido::cli
