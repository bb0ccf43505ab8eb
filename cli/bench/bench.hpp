#pragma once

#include <algorithm>
#include <span>

#include "cli/options/command.hpp"
#include "cli/progress.hpp"
#include "core/nearest.hpp"

namespace irido::cli {

inline constexpr double kLargestSeed = 0x1p53;

/// The subcommands of `irido bench`, each in a file of its own.
void add_bench_design(CLI::App& bench, Run& run);
void add_bench_speed(CLI::App& bench, Run& run);
void add_bench_stability(CLI::App& bench, Run& run);
void add_bench_pareto(CLI::App& bench, Run& run);
void add_bench_render(CLI::App& bench, Run& run);
void add_bench_layered(CLI::App& bench, Run& run);
void add_bench_scene(CLI::App& bench, Run& run);
void add_bench_scratch(CLI::App& bench, Run& run);

/// The names of cases, "all" first.
template <class Case>
std::vector<std::string> case_names(std::span<const Case> all) {
    std::vector<std::string> names{"all"};
    for (const Case& one : all) names.emplace_back(one.name);
    return names;
}

/// The cases named in "a,b", in that order, or all of them for "all". Throws UsageError, which
/// refers to the help of the subcommand `bench`.
template <class Case>
std::vector<Case> chosen_cases(const std::string& text, std::span<const Case> all,
                               const std::string& bench) {
    if (text == "all") return {all.begin(), all.end()};
    std::vector<Case> chosen;
    for (const std::string_view name : comma_separated(text)) {
        const auto found = std::ranges::find(all, name, &Case::name);
        if (found != all.end()) {
            chosen.push_back(*found);
            continue;
        }
        throw UsageError("--cases: unknown case '" + std::string(name) + "'" +
                         did_you_mean(name, case_names(all)) + " (see irido bench " + bench +
                         " --help)");
    }
    return chosen;
}

/// The help of --cases.
template <class Case>
std::string cases_help(std::span<const Case> all) {
    std::string text = "all, or some of these, separated by commas [all]:";
    for (const Case& one : all)
        text += "\n" + std::string(one.name) + ": " + std::string(one.summary);
    return text;
}

/// Appends a column of numbers.
/// records  receives the column
/// name     name of the column
/// rows     one per record
/// value    value(row) gives the number
template <class Row, class Value>
void add_numbers(tables::Records& records, std::string name, const std::vector<Row>& rows,
                 const Value& value) {
    tables::Column::Numbers numbers(rows.size());
    std::ranges::transform(rows, numbers.begin(), value);
    records.columns.push_back({std::move(name), std::move(numbers)});
}

}  // namespace irido::cli
