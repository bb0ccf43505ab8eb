#include "cli/queries/layered_simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/error.hpp"
#include "schemas/documents/canonical_stack.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/points_csv.hpp"
#include "schemas/readers/text_file.hpp"
#include "tables/files/hash.hpp"
#include "tables/records/record_format.hpp"
#include "tables/version.hpp"

namespace irido::cli {

namespace {

/// Samples with which a simulation to a tolerance begins, and its most.
constexpr std::uint64_t kFirstSamples = 4096, kMostTolerated = 1'000'000'000;

constexpr const char *kFirstSample = "first_sample", *kSamples = "samples",
                     *kAllSamples = "all_samples", *kRequest = "request", *kStderr = "stderr",
                     *kBuild = "build", *kSimd = "simd", *kDigest = "digest";
constexpr std::array<const char*, 3> kShardColors{"X", "Y", "Z"};

/// Columns of a shard that hold the sums of a value, which follow its name.
struct SumColumn {
    const char* ending;
    std::vector<LongSum> LayeredSimulation::Values::*sums;
    double LongSum::*part;
};
constexpr std::array kSumColumns{
    SumColumn{"_sum", &LayeredSimulation::Values::sum, &LongSum::high},
    SumColumn{"_sum_low", &LayeredSimulation::Values::sum, &LongSum::low},
    SumColumn{"_square", &LayeredSimulation::Values::square, &LongSum::high},
    SumColumn{"_square_low", &LayeredSimulation::Values::square, &LongSum::low}};

struct LightColumn {
    const char* name;
    std::string ColorOptions::*option;
};
constexpr std::array kLightColumns{LightColumn{"illuminant", &ColorOptions::illuminant},
                                   LightColumn{"observer", &ColorOptions::observer},
                                   LightColumn{"space", &ColorOptions::space},
                                   LightColumn{"adaptation", &ColorOptions::adaptation}};

/// A whole number that differs for different texts.
double hash_number(const std::string& text) {
    constexpr std::size_t kDigits = 13;  // 52 bits
    const std::string digits = tables::sha256_of(text).substr(0, kDigits);
    return static_cast<double>(std::stoull(digits, nullptr, 16));
}

std::size_t rows_of_column(const schemas::PointsColumn& column) {
    return column.texts.empty() ? column.numbers.size() : column.codes.size();
}

std::string text_of(const schemas::PointsColumn& column, std::size_t row) {
    return column.texts.empty() ? to_text(column.numbers[row]) : column.texts[column.codes[row]];
}

/// Of all cells of a shard, however its numbers are spelt, but for the digest itself.
double digest_of(const std::vector<schemas::PointsColumn>& columns) {
    std::string cells;
    for (const schemas::PointsColumn& column : columns) {
        if (column.path == kDigest) continue;
        cells += column.path + '\n';
        for (std::size_t row = 0; row < rows_of_column(column); ++row)
            cells += text_of(column, row) + '\n';
    }
    return hash_number(cells);
}

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
        values.add(once());
        done += more;
    }
}

/// A shard as its file has it.
struct ShardRows {
    std::string file;
    NumberColumns keys;
    std::vector<std::string> names;  ///< of the values
    double request = 0;
    std::uint64_t first = 0, all_samples = 0;
    LayeredSimulation::Values values;
    std::vector<schemas::PointsColumn> columns;

    [[noreturn]] void fail(const std::string& text) const {
        throw schemas::InputError(file, "", text);
    }
    const std::vector<double>& numbers_of(const std::string& name) const {
        const auto found = std::ranges::find(columns, name, &schemas::PointsColumn::path);
        if (found == columns.end()) fail("must have the column " + name + ", as --shard writes it");
        if (const std::string problem = found->problem_as_numbers(); !problem.empty())
            fail(name + ": " + problem);
        return found->numbers;
    }
    /// "" without such a column.
    std::string first_text_of(const char* name) const {
        const auto found = std::ranges::find(columns, name, &schemas::PointsColumn::path);
        return found == columns.end() ? "" : text_of(*found, 0);
    }
    /// Of a column that is the same in every row.
    std::uint64_t number_of(const char* name) const {
        const std::vector<double>& numbers = numbers_of(name);
        if (std::ranges::any_of(numbers, [&](double x) { return x != numbers.front(); }) ||
            numbers.front() < 0 || numbers.front() != std::floor(numbers.front()))
            fail(std::string(name) + " must be one whole number");
        return static_cast<std::uint64_t>(numbers.front());
    }
};

ShardRows read_shard(const std::string& path) {
    ShardRows shard;
    shard.file = schemas::shown_path(path);
    shard.columns = schemas::read_points_csv(schemas::read_text(path), shard.file);
    const auto place_of = [&](const char* name) {
        return std::ranges::find(shard.columns, name, &schemas::PointsColumn::path);
    };
    shard.numbers_of(kStderr);
    const bool is_color = place_of(kShardColors[0]) != shard.columns.end();
    auto value = is_color ? place_of(kShardColors[0]) : place_of(kStderr);
    if (!is_color && value != shard.columns.begin()) --value;
    if (is_color)
        shard.names.assign(kShardColors.begin(), kShardColors.end());
    else
        shard.names = {value->path};
    for (auto key = shard.columns.begin(); key != value; ++key)
        shard.keys.emplace_back(key->path, shard.numbers_of(key->path));
    if (static_cast<double>(shard.number_of(kDigest)) != digest_of(shard.columns))
        shard.fail("was altered: it does not match its digest; run the shard again");
    shard.request = static_cast<double>(shard.number_of(kRequest));
    shard.first = shard.number_of(kFirstSample);
    shard.all_samples = shard.number_of(kAllSamples);
    shard.values.samples = shard.number_of(kSamples);
    const std::size_t rows = shard.numbers_of(kStderr).size(), size = shard.names.size();
    shard.values.sum.resize(rows * size);
    shard.values.square.resize(rows * size);
    for (std::size_t n = 0; n < size; ++n)
        for (const SumColumn& column : kSumColumns) {
            const std::vector<double>& numbers = shard.numbers_of(shard.names[n] + column.ending);
            for (std::size_t r = 0; r < rows; ++r)
                (shard.values.*column.sums)[r * size + n].*column.part = numbers[r];
        }
    if (shard.values.samples < 2) shard.fail("must have 2 samples or more");
    shard.values.set_means();
    return shard;
}

/// Refuses shards that belong to different requests or that were computed differently.
void require_same(const ShardRows& shard, const ShardRows& first) {
    const auto require = [&](const char* name, const std::string& words, const std::string& hint) {
        const std::string a = shard.first_text_of(name), b = first.first_text_of(name);
        if (a != b) shard.fail(words + a + ", " + first.file + " " + b + hint);
    };
    require(kBuild, "was written by irido ",
            ", whose numbers may differ: run all shards with the same build");
    for (const LightColumn& column : kLightColumns)
        require(column.name, std::string("has the ") + column.name + " ", "");
    if (shard.request != first.request || shard.keys != first.keys || shard.names != first.names ||
        shard.all_samples != first.all_samples)
        shard.fail("is a shard of another request than " + first.file);
    require(kSimd, "was computed at SIMD level ",
            ", whose last digits differ: run all shards at one level (set the environment variable "
            "IRIDO_SIMD)");
}

/// The shards of one request, by their samples, of which none is missing.
std::vector<ShardRows> read_shards(const std::vector<std::string>& files) {
    std::vector<ShardRows> shards;
    for (const std::string& file : files) shards.push_back(read_shard(file));
    std::ranges::sort(shards, {}, &ShardRows::first);
    std::uint64_t done = 0;
    for (const ShardRows& shard : shards) {
        require_same(shard, shards.front());
        if (shard.first != done)
            shard.fail("begins with sample " + std::to_string(shard.first) +
                       "; the shards before it end at " + std::to_string(done));
        done += shard.values.samples;
    }
    if (done != shards.front().all_samples)
        shards.back().fail("the shards end at sample " + std::to_string(done) + " of " +
                           std::to_string(shards.front().all_samples));
    return shards;
}

LayeredSimulation::Values sum_of(const std::vector<ShardRows>& shards) {
    LayeredSimulation::Values all = shards.front().values;
    for (std::size_t s = 1; s < shards.size(); ++s) all.add(shards[s].values);
    return all;
}

/// A whole number that differs for different requests.
double request_number(const SimulationPlan& plan, const NumberColumns& keys,
                      const std::vector<std::string>& names) {
    nlohmann::json facts = plan.facts;
    for (const auto& [name, numbers] : keys) facts["keys"][name] = numbers;
    facts["names"] = names;
    return hash_number(facts.dump());
}

LayeredSimulation::Values merged(const SimulationPlan& plan, const NumberColumns& keys,
                                 const std::vector<std::string>& names) {
    const std::vector<ShardRows> shards = read_shards(plan.merge);
    if (shards.front().request != request_number(plan, keys, names))
        shards.front().fail("is a shard of another request than this one");
    return sum_of(shards);
}

std::vector<Triple> colors_of(const LayeredSimulation::Values& values) {
    std::vector<Triple> xyz;
    for (std::size_t k = 0; k < values.mean.size(); k += 3)
        xyz.push_back({values.mean[k], values.mean[k + 1], values.mean[k + 2]});
    return xyz;
}

}  // namespace

bool is_simulated(const SurfaceQuery& query) {
    return query.paths.starts_with("simulation");
}

SimulationPlan parse_simulation(const LayeredSurface& surface, const SurfaceQuery& query,
                                Crossings crossings) {
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
    if (!plan.shard && plan.merge.empty()) return plan;
    plan.facts = surface_facts(surface, query);
    plan.facts["quantity"] = query.quantity;
    plan.facts["samples"] = request.samples;
    plan.facts["seed"] = request.seed;
    plan.facts["facets"] = choices[static_cast<std::size_t>(request.facets)];
    plan.facts["media"] = schemas::canonical_stack({{surface.outside, surface.inside}, 0, {}, 1});
    if (query.wants_color) {
        const Table light = parse_illuminant(query.color.illuminant);  // its file may have changed
        plan.facts["light"] = {light.wavelength_nm, light.value};
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
    if (!plan.merge.empty()) return {merged(plan, keys, names), {}};
    if (plan.tolerance)
        return {to_tolerance(document, *plan.tolerance, simulation, once, floor), {}};
    if (!plan.shard) return {once(), {}};
    const auto begin_of = [&](std::uint64_t number) {
        const std::uint64_t each = plan.request.samples / plan.shard->of;
        return each * number + std::min(number, plan.request.samples % plan.shard->of);
    };
    const std::uint64_t first = begin_of(plan.shard->number - 1);
    simulation.set_paths(first, begin_of(plan.shard->number) - first);
    return {once(), ShardFacts{first, plan.request.samples, request_number(plan, keys, names)}};
}

void add_simulated_columns(const SimulatedValues& simulated, const std::vector<std::string>& names,
                           SurfaceRows& rows) {
    const LayeredSimulation::Values& values = simulated.values;
    const std::size_t size = names.size(), count = values.error.size() / size;
    const auto add = [&](std::string name, const auto& number_of) {
        tables::Column::Numbers numbers;
        for (std::size_t row = 0; row < count; ++row) numbers.push_back(number_of(row));
        rows.records.columns.push_back({std::move(name), std::move(numbers)});
    };
    add(kStderr, [&](std::size_t row) {
        return std::ranges::max(std::span(values.error).subspan(row * size, size));
    });
    if (!simulated.shard) return;
    for (const auto& [name, number] :
         {std::pair(kFirstSample, static_cast<double>(simulated.shard->first)),
          {kSamples, static_cast<double>(values.samples)},
          {kAllSamples, static_cast<double>(simulated.shard->all_samples)},
          {kRequest, simulated.shard->request}})
        add(name, [number = number](std::size_t) { return number; });
    for (std::size_t n = 0; n < size; ++n)
        for (const SumColumn& column : kSumColumns)
            add(names[n] + column.ending, [&](std::size_t row) {
                return (values.*column.sums)[row * size + n].*column.part;
            });
}

namespace {

/// The options of the query, those that were not typed as the shard has them.
ColorOptions light_of(const ShardRows& shard, const ColorOptions& typed) {
    ColorOptions light = typed;
    const ColorOptions untyped;
    for (const LightColumn& column : kLightColumns) {
        const std::string text = shard.first_text_of(column.name);
        if (!text.empty() && light.*column.option == untyped.*column.option)
            light.*column.option = text;
    }
    return light;
}

}  // namespace

void add_shard_marks(const SurfaceQuery& query, SurfaceRows& rows) {
    const std::size_t count = rows.records.rows();
    const auto add = [&](const char* name, const std::string& text) {
        rows.records.columns.push_back({name, tables::Column::Texts(count, text)});
    };
    if (query.wants_color)
        for (const LightColumn& column : kLightColumns)
            add(column.name, query.color.*column.option);
    add(kBuild, tables::version_text(tables::this_build()));
    add(kSimd, std::string(name_of(query.execution.simd)));
    const std::string csv = tables::written(*tables::find_record_format("csv"), rows.records);
    rows.records.columns.push_back(
        {kDigest, tables::Column::Numbers(count, digest_of(schemas::read_points_csv(csv, "")))});
}

SurfaceRows rows_of_shards(const SurfaceQuery& query) {
    std::vector<ShardRows> shards = read_shards(query.merge);
    const ShardRows& first = shards.front();
    const SimulatedValues all{sum_of(shards), {}};
    NumberColumns keys = first.keys;
    SurfaceRows rows;
    if (first.names.size() > 1) {
        const ColorColumns columns(light_of(first, query.color));
        // the colours of the first shard tell whether the light and the space are those typed
        for (const tables::Column& column :
             columns.rows(keys, colors_of(first.values)).records.columns)
            if (const auto* numbers = std::get_if<tables::Column::Numbers>(&column.values))
                if (first.numbers_of(column.name) != *numbers)
                    first.fail(
                        "has colours in another --space, --illuminant, --observer or --adaptation: "
                        "leave these options to the shards");
        rows = columns.rows(std::move(keys), colors_of(all.values));
    } else {
        const std::size_t count = keys.size();
        keys.emplace_back(first.names.front(), all.values.mean);
        rows = rows_of(std::move(keys), count);
    }
    add_simulated_columns(all, first.names, rows);
    return rows;
}

}  // namespace irido::cli
