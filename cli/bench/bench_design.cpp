#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "cli/bench/bench.hpp"
#include "cli/bench/design_cases.hpp"
#include "core/design/global_search.hpp"
#include "core/design/needle.hpp"
#include "schemas/documents/design_document.hpp"
#include "schemas/documents/json_document.hpp"

namespace irido::cli {

namespace {

struct BenchDesignOptions {
    std::string cases = "all";
    std::string seed = "1";
    std::string evaluations;
    OutputOptions output;
    bool quiet = false;
    unsigned threads = 0;
};

struct DesignRow {
    DesignCase one;
    std::size_t values = 0, layers = 0;
    double merit = 0, evaluations = 0, seconds = 0, jacobians_per_s = 0;
    std::size_t within = 0, runs = 0;
};

/// Gradients per second on one thread, at the starting point.
double gradient_rate(const DesignProblem& problem) {
    constexpr double kEnough_s = 0.02;
    DesignModel model(problem);
    const std::vector<double> x = model.start();
    model.adapt_colors(x, 0.02);
    std::vector<double> gradient(x.size()), hessian(x.size() * x.size());
    using Clock = std::chrono::steady_clock;
    for (std::size_t count = 1;; count *= 2) {
        const Clock::time_point begin = Clock::now();
        for (std::size_t i = 0; i < count; ++i) model.objective(x, gradient, hessian);
        const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
        if (seconds > kEnough_s) return static_cast<double>(count) / seconds;
    }
}

DesignRow measured_design(const DesignCase& one, const SearchSettings& settings) {
    const schemas::DesignTask task = schemas::read_design(
        schemas::parse_json(one.task, std::string(one.name)), std::string(one.name), "");
    DesignRow row{.one = one};
    row.jacobians_per_s = gradient_rate(task.problem);
    row.values = task.problem.free.size();
    row.layers = task.problem.stack.elements.size();
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    if (task.method == "needle") {
        NeedleSettings needles;
        needles.search = settings;
        needles.materials = task.materials;
        needles.max_layers = task.max_layers;
        needles.min_thickness_nm = task.min_thickness_nm;
        const NeedleResult result = needle_search(task.problem, needles);
        row.merit = result.merit;
        row.layers = result.layers.size();
        row.values = result.layers.size();
        row.evaluations = static_cast<double>(result.evaluations);
        row.within = result.runs_within;
        row.runs = result.runs.size();
    } else {
        const SearchResult result = search(task.problem, settings);
        row.merit = result.merit;
        row.evaluations = static_cast<double>(result.evaluations);
        row.within = result.runs_within;
        row.runs = result.runs.size();
    }
    row.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    return row;
}

tables::Records design_records(const std::vector<DesignRow>& rows) {
    tables::Column::Texts names;
    for (const DesignRow& row : rows) names.emplace_back(row.one.name);
    tables::Records records{{{"case", std::move(names)}}};
    const auto add = [&](std::string name, auto value) {
        add_numbers(records, std::move(name), rows, value);
    };
    add("layers", [](const DesignRow& row) { return static_cast<double>(row.layers); });
    add("free", [](const DesignRow& row) { return static_cast<double>(row.values); });
    add("best_known", [](const DesignRow& row) { return row.one.best; });
    add("merit", [](const DesignRow& row) { return row.merit; });
    add("above_best_percent", [](const DesignRow& row) {
        return row.one.best > 0 ? 100 * (row.merit / row.one.best - 1) : std::nan("");
    });
    add("evaluations", [](const DesignRow& row) { return row.evaluations; });
    add("time_s", [](const DesignRow& row) { return row.seconds; });
    add("jacobians_per_s", [](const DesignRow& row) { return row.jacobians_per_s; });
    add("runs_within_1_percent",
        [](const DesignRow& row) { return static_cast<double>(row.within); });
    add("runs", [](const DesignRow& row) { return static_cast<double>(row.runs); });
    return records;
}

int run_bench_design(const BenchDesignOptions& options) {
    resolved_record_format(options.output);
    SearchSettings settings;
    settings.seed = parse_whole_number("--seed", options.seed, 0, kLargestSeed);
    settings.threads = options.threads;
    settings.simd = execution_of().simd;
    if (!options.evaluations.empty())
        settings.evaluations = parse_whole_number("--evaluations", options.evaluations, 1, 1e12);
    std::vector<DesignRow> rows;
    const auto cases = chosen_cases(options.cases, design_cases(), "design");
    StepProgress progress(options.quiet, cases.size());
    for (const DesignCase& one : cases) {
        progress.begin(std::string(one.name));
        rows.push_back(measured_design(one, settings));
    }
    progress.clear();
    write_records(design_records(rows), options.output);
    return 0;
}

}  // namespace

void add_bench_design(CLI::App& bench, Run& run) {
    CLI::App* command = bench.add_subcommand(
        "design",
        "Searches on published problems and on problems of its own, beside the best merits known.");
    const auto options = std::make_shared<BenchDesignOptions>();
    command->add_option("-c,--cases", options->cases, cases_help(design_cases()))
        ->type_name("NAMES");
    offer(
        *command, "cases", [] { return case_names(design_cases()); }, OfferedWords::Use::several);
    command->add_option("-s,--seed", options->seed, "of the searches, [0, 2^53] [1]")
        ->type_name("S");
    command
        ->add_option("--evaluations", options->evaluations,
                     "that each search may take, [1, 1e12] [300000]")
        ->type_name("N");
    add_output_options(*command, options->output, record_formats_text());
    add_threads_option(*command, options->threads);
    add_quiet_option(*command, options->quiet, "no progress");
    set_examples(
        *command,
        {"irido bench design -o design.csv", "irido bench design --cases ar8,ar8-45 --seed 7"},
        "Columns: layers and free values; the best merit known (0: an exact answer exists)\n"
        "and the one found; evaluations, time and runs that came to within 1 % of their\n"
        "best; Jacobians per second on one thread.");
    set_run(*command, run, options, run_bench_design);
}

}  // namespace irido::cli
