#include "cli/queries/layered_simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/points_csv.hpp"
#include "schemas/readers/text_file.hpp"

namespace irido::cli {

namespace {

/// Samples with which a simulation to a tolerance begins, and its most.
constexpr std::uint64_t kFirstSamples = 4096, kMostTolerated = 1'000'000'000;

constexpr const char *kFirstSample = "first_sample", *kSamples = "samples", *kStderr = "stderr";

/// The largest standard error relative to max(floor, |value|).
double worst_of(const LayeredSimulation::Values& values, double floor) {
    double worst = 0;
    for (std::size_t k = 0; k < values.mean.size(); ++k)
        if (values.error[k] > 0)
            worst = std::max(worst, values.error[k] / std::max(floor, std::abs(values.mean[k])));
    return worst;
}

LayeredSimulation::Values to_tolerance(const schemas::SurfaceDocument& document, double tolerance,
                                       LayeredSimulation& simulation,
                                       const std::function<LayeredSimulation::Values()>& once,
                                       double floor) {
    simulation.set_paths(0, kFirstSamples);
    LayeredSimulation::Values values = once();
    for (std::uint64_t done = kFirstSamples;;) {
        const double ratio = worst_of(values, floor) / tolerance;
        if (ratio <= 1) return values;
        const double whole = static_cast<double>(done) * std::min(16.0, 1.1 * ratio * ratio);
        if (static_cast<double>(done) * ratio * ratio > kMostTolerated)
            throw ToleranceError(document.file + ": the tolerance " + to_text(tolerance) +
                                 " would take more than 1e9 samples (the error is " +
                                 to_text(ratio * tolerance) + " after " + std::to_string(done) +
                                 ")");
        const auto more = static_cast<std::uint64_t>(whole) - done;
        simulation.set_paths(done, more);
        values.add(static_cast<double>(done), once(), static_cast<double>(more));
        done += more;
    }
}

/// A shard as its file has it.
struct ShardRows {
    std::string file;
    std::uint64_t first = 0, samples = 0;
    LayeredSimulation::Values values;
};

ShardRows read_shard(const std::string& path, const NumberColumns& keys,
                     const std::vector<std::string>& names) {
    ShardRows shard;
    shard.file = schemas::shown_path(path);
    const auto columns = schemas::read_points_csv(schemas::read_text(path), shard.file);
    const std::size_t rows = keys.front().second.size();
    const auto numbers_of = [&](const std::string& name) -> const std::vector<double>& {
        const auto found = std::ranges::find(columns, name, &schemas::PointsColumn::path);
        if (found == columns.end() || found->numbers.size() != rows)
            throw schemas::InputError(shard.file, "",
                                      "must have the numbers " + name + " of " +
                                          std::to_string(rows) + " rows, as --shard writes them");
        return found->numbers;
    };
    for (const auto& [name, numbers] : keys)
        if (numbers_of(name) != numbers)
            throw schemas::InputError(shard.file, "",
                                      "is a shard of another request: " + name + " differs");
    const std::vector<double>& errors = numbers_of(kStderr);
    for (std::size_t r = 0; r < rows; ++r)
        for (const std::string& name : names) {
            shard.values.mean.push_back(numbers_of(name)[r]);
            shard.values.error.push_back(errors[r]);
        }
    const auto one_of = [&](const char* name) {
        const std::vector<double>& numbers = numbers_of(name);
        if (std::ranges::any_of(numbers, [&](double x) { return x != numbers.front(); }) ||
            numbers.front() < 0 || numbers.front() != std::floor(numbers.front()))
            throw schemas::InputError(shard.file, "",
                                      std::string(name) + " must be one whole number");
        return static_cast<std::uint64_t>(numbers.front());
    };
    shard.first = one_of(kFirstSample);
    shard.samples = one_of(kSamples);
    return shard;
}

LayeredSimulation::Values merged(const SimulationPlan& plan, const NumberColumns& keys,
                                 const std::vector<std::string>& names) {
    std::vector<ShardRows> shards;
    for (const std::string& file : plan.merge) shards.push_back(read_shard(file, keys, names));
    std::ranges::sort(shards, {}, &ShardRows::first);
    LayeredSimulation::Values all = shards.front().values;
    std::uint64_t done = 0;
    for (const ShardRows& shard : shards) {
        if (shard.first != done)
            throw schemas::InputError(shard.file, "",
                                      "begins with sample " + std::to_string(shard.first) +
                                          "; the shards before it end at " + std::to_string(done));
        if (done > 0)
            all.add(static_cast<double>(done), shard.values, static_cast<double>(shard.samples));
        done += shard.samples;
    }
    if (done != plan.request.samples)
        throw schemas::InputError(shards.back().file, "",
                                  "the shards end at sample " + std::to_string(done) + " of " +
                                      std::to_string(plan.request.samples));
    return all;
}

}  // namespace

bool is_simulated(const SurfaceQuery& query) {
    return query.paths.starts_with("simulation");
}

SimulationPlan parse_simulation(const SurfaceQuery& query, Crossings crossings) {
    constexpr double kMostSamples = 1e12, kMostSeed = 9007199254740992;
    constexpr std::array<std::string_view, 2> choices{"sampled", "filter"};
    SimulationPlan plan;
    SimulationRequest& request = plan.request;
    request.paths = parse_paths(query.paths);
    request.crossings = crossings;
    if (!query.samples.empty())
        request.samples = parse_whole_number("--samples", query.samples, 2, kMostSamples);
    if (!query.seed.empty()) request.seed = parse_whole_number("--seed", query.seed, 0, kMostSeed);
    if (query.facets == choices[1])
        request.facets = FacetChoice::filter;
    else if (!query.facets.empty() && query.facets != choices[0])
        throw UsageError("--facets: " + not_one_of(choices, query.facets));
    if (crossings == Crossings::multiple && request.facets == FacetChoice::sampled)
        throw UsageError("--transmission multiple: a simulation takes it with --facets filter");
    plan.merge = query.merge;
    if (!query.shard.empty()) plan.shard = parse_shard(query.shard);
    if (plan.shard && !plan.merge.empty())
        throw UsageError("--shard and --merge are mutually exclusive");
    if (plan.shard && request.samples / plan.shard->of < 2)
        throw UsageError("--shard: every part must have 2 samples or more");
    if (!query.color.tolerance.empty()) {
        if (!query.samples.empty() || plan.shard || !plan.merge.empty())
            throw UsageError("--tolerance of a simulation excludes --samples, --shard and --merge");
        plan.tolerance = parse_tolerance(query.color.tolerance);
    }
    return plan;
}

void require_no_simulation(const SurfaceQuery& query) {
    const auto require = [](const char* name, bool is_typed) {
        if (is_typed)
            throw UsageError(std::string(name) +
                             ": requires --paths simulation or simulation-single");
    };
    require("--samples", !query.samples.empty());
    require("--seed", !query.seed.empty());
    require("--facets", !query.facets.empty());
    require("--shard", !query.shard.empty());
    require("--merge", !query.merge.empty());
}

SimulatedValues simulate(const schemas::SurfaceDocument& document, const SimulationPlan& plan,
                         LayeredSimulation& simulation,
                         const std::function<LayeredSimulation::Values()>& once,
                         const NumberColumns& keys, const std::vector<std::string>& names,
                         double floor) {
    if (!plan.merge.empty()) return {merged(plan, keys, names), {}, {}};
    if (plan.tolerance)
        return {to_tolerance(document, *plan.tolerance, simulation, once, floor), {}, {}};
    if (!plan.shard) return {once(), {}, {}};
    const auto begin_of = [&](std::uint64_t number) {
        const std::uint64_t each = plan.request.samples / plan.shard->of;
        return each * number + std::min(number, plan.request.samples % plan.shard->of);
    };
    const std::uint64_t first = begin_of(plan.shard->number - 1);
    const std::uint64_t samples = begin_of(plan.shard->number) - first;
    simulation.set_paths(first, samples);
    return {once(), first, samples};
}

void add_simulated_columns(const SimulatedValues& simulated, std::size_t values_per_row,
                           SurfaceRows& rows) {
    const std::vector<double>& errors = simulated.values.error;
    tables::Column::Numbers largest;
    for (std::size_t k = 0; k < errors.size(); k += values_per_row)
        largest.push_back(
            *std::max_element(errors.begin() + static_cast<std::ptrdiff_t>(k),
                              errors.begin() + static_cast<std::ptrdiff_t>(k + values_per_row)));
    const std::size_t count = largest.size();
    rows.records.columns.push_back({kStderr, std::move(largest)});
    if (!simulated.samples) return;
    for (const auto& [name, value] :
         {std::pair(kFirstSample, *simulated.first), {kSamples, *simulated.samples}})
        rows.records.columns.push_back(
            {name, tables::Column::Numbers(count, static_cast<double>(value))});
}

}  // namespace irido::cli
