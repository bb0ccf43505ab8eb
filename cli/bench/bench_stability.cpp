#include <algorithm>
#include <iostream>
#include <memory>

#include "cli/bench/bench.hpp"
#include "cli/exit_status.hpp"
#include "core/error.hpp"
#include "core/nearest.hpp"
#include "core/truth/stability.hpp"

namespace irido::cli {

namespace {

struct StabilityOptions {
    std::string count = "80";
    std::string seed = "1";
    std::string regimes = "all";
    OutputOptions output;
    bool quiet = false;
    unsigned threads = 0;
};

const Regime& regime_named(std::string_view name) {
    if (const Regime* found = find_regime(name)) return *found;
    std::vector<std::string> names;
    for (const Regime& regime : regimes()) names.emplace_back(regime.name);
    throw UsageError("--regime: there is no regime '" + std::string(name) + "'" +
                     did_you_mean(name, names) + " (see irido bench stability --help)");
}

/// Parses "a,b" into regimes, in that order.
std::vector<Regime> parse_regimes(const std::string& text) {
    if (text == "all") return {regimes().begin(), regimes().end()};
    std::vector<Regime> chosen;
    for (const std::string_view name : comma_separated(text)) chosen.push_back(regime_named(name));
    return chosen;
}

tables::Records to_records(const std::vector<RegimeReport>& reports) {
    tables::Column::Texts names;
    for (const RegimeReport& report : reports) names.emplace_back(report.regime);
    tables::Records records{{{"regime", std::move(names)}}};
    const auto add = [&](std::string name, auto value) {
        add_numbers(records, std::move(name), reports, value);
    };
    const auto add_count = [&](std::string name, std::uint64_t RegimeReport::*count) {
        add(std::move(name), [=](const RegimeReport& r) { return static_cast<double>(r.*count); });
    };
    const auto add_error = [&](const std::string& name, ErrorSummary RegimeReport::*error) {
        add("worst_" + name, [=](const RegimeReport& r) { return (r.*error).worst; });
        add("p99_" + name, [=](const RegimeReport& r) { return (r.*error).p99; });
        add("condition_" + name, [=](const RegimeReport& r) { return (r.*error).condition; });
        add("roundings_" + name, [=](const RegimeReport& r) { return (r.*error).roundings; });
    };
    add_count("count", &RegimeReport::count);
    add_error("R", &RegimeReport::R);
    add_error("T", &RegimeReport::T);
    add_error("T_relative", &RegimeReport::T_relative);
    add_error("A", &RegimeReport::A);
    add_error("A_relative", &RegimeReport::A_relative);
    add_count("not_finite", &RegimeReport::not_finite);
    add_count("negative", &RegimeReport::negative);
    add_count("above_one", &RegimeReport::excess);
    add_count("beyond_bound", &RegimeReport::beyond);
    add_count("thresholds", &RegimeReport::thresholds);
    return records;
}

/// The violated bounds, by regime; "" if there are none.
std::string violations(const std::vector<RegimeReport>& reports) {
    std::string text;
    for (const RegimeReport& report : reports)
        if (!report.passed())
            text += (text.empty() ? "" : "; ") + std::string(report.regime) + ": " +
                    report.first_violation + " (--regime " + std::string(report.regime) +
                    " --count 1 --seed " + std::to_string(report.first_seed) + ")";
    return text;
}

int run_stability(const StabilityOptions& options) {
    resolved_record_format(options.output);
    const std::uint64_t count =
        parse_whole_number("--count", options.count, 1, kLargestStabilityCount);
    const std::uint64_t seed = parse_whole_number("--seed", options.seed, 0, kLargestSeed);
    const Execution execution = execution_of(options.threads);
    std::vector<RegimeReport> reports;
    const std::vector<Regime> chosen = parse_regimes(options.regimes);
    StepProgress progress(options.quiet, chosen.size());
    for (const Regime& regime : chosen) {
        progress.begin(std::string(regime.name));
        reports.push_back(measure_stability(regime, count, seed, execution));
    }
    progress.clear();
    write_records(to_records(reports), options.output);
    const std::string wrong = violations(reports);
    if (wrong.empty()) return 0;
    std::cerr << "irido: error: " << wrong << '\n';
    return kCheckFailed;
}

std::string regimes_help() {
    std::string text = "all, or some of these, separated by commas [all]:";
    for (const Regime& regime : regimes())
        text += "\n" + std::string(regime.name) + ": " + std::string(regime.summary);
    return text;
}

}  // namespace

void add_bench_stability(CLI::App& bench, Run& run) {
    CLI::App* command = bench.add_subcommand(
        "stability",
        "Errors of R, T, A where precision is lost; exit status 1 if one exceeds its bound.");
    const auto options = std::make_shared<StabilityOptions>();
    command
        ->add_option("-n,--count", options->count,
                     "random stacks of each regime, two polarizations each,\n[1, 1e6] [80]")
        ->type_name("N");
    command
        ->add_option("-s,--seed", options->seed,
                     "stack i of a regime depends on seed + i only, [0, 2^53] [1]")
        ->type_name("S");
    command->add_option("-r,--regime", options->regimes, regimes_help())->type_name("NAMES");
    offer(
        *command, "regime", [] { return case_names(regimes()); }, OfferedWords::Use::several);
    add_output_options(*command, options->output, record_formats_text());
    add_threads_option(*command, options->threads);
    add_quiet_option(*command, options->quiet, "no progress");
    set_examples(
        *command,
        {"irido bench stability --count 1000 -o stability.csv",
         "irido bench stability --regime band_edge,critical --seed 7 -f json"},
        "Columns: count of evaluations (two polarizations per stack); worst and p99 (99 of 100)\n"
        "error against 50 digits of R, T, A and relative T and A; condition at the worst\n"
        "one: its change over the relative change of all inputs; roundings: the largest\n"
        "error / (2^-53 (1 + condition)). not_finite, negative and above_one (R + T) must\n"
        "be 0 without gain, and so must beyond_bound: errors above max(1e-13, 10 condition\n"
        "2^-53), 100 for relative T, max(1e-9, ...) for relative A, and refusals of passive "
        "stacks.\n"
        "thresholds: stacks refused because they amplify without bound.");
    set_run(*command, run, options, run_stability);
}

}  // namespace irido::cli
