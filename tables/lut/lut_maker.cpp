#include "tables/lut/lut_maker.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "tables/lut/interpolation.hpp"
#include "tables/lut/lut_fit.hpp"

namespace irido::tables {

namespace {

constexpr std::size_t kMostValues = 1U << 27;
/// As a fit begins.
constexpr double kLookedAt = 65, kOnLines = 9;
constexpr std::size_t kFewSamples = 256;  ///< of a level that is measured, not estimated

std::string name_of_axis(const LutAxis& axis) {
    return axis.unit.empty() ? axis.name : axis.name + " (" + axis.unit + ")";
}

/// The axes for the requested sizes.
void set_counts(Lut& lut, const LutPlan& plan, const std::vector<std::size_t>& counts) {
    if (counts.size() != plan.axes.size())
        throw LutError("the size must have one number for each of the " +
                       std::to_string(plan.axes.size()) + " axes, or one for all (got " +
                       std::to_string(counts.size()) + ")");
    for (std::size_t a = 0; a < counts.size(); ++a) {
        LutAxis& axis = lut.axes[a];
        if (counts[a] == axis.count()) continue;
        if (plan.axes[a].fixed || (lut.mips && a == 0))
            throw LutError("the size along " + name_of_axis(axis) + " must be " +
                           std::to_string(axis.count()) +
                           ", the number of values in its list (got " + std::to_string(counts[a]) +
                           ")");
        axis.values = counts[a] == 1 ? std::vector{0.5 * (axis.values.front() + axis.values.back())}
                                     : axis.spaced(counts[a]);
    }
}

void fill(Lut& lut, const LutPlan& plan, const LutMaking& making) {
    lut.values.clear();
    Sampler sample(plan, making);
    sample.says("values", true);
    for (const auto& grid : grids_of(lut)) {
        const std::vector<double> values = sample(grid);
        lut.values.insert(lut.values.end(), values.begin(), values.end());
    }
}

/// Of a tolerance, what one may miss that decides by errors; and of an error that is only stated.
constexpr double kOfError = 0.1, kOfMeasured = 0.02;

/// The plan with values that are `error` off at most, in its measure.
LutPlan roughly(const LutPlan& plan, double error) {
    LutPlan rough = plan;
    if (plan.roughly) rough.evaluate = plan.roughly(error);
    return rough;
}

/// Seconds of one sample, without what a function computes once, for the first of two calls.
double seconds_of_sample(const LutPlan::Evaluate& evaluate, const std::vector<LutAxis>& grid) {
    constexpr std::size_t few = 6;  // samples along an axis
    std::vector<LutAxis> some = grid;
    const auto choose = [&](std::size_t shift) {
        for (std::size_t a = 0; a < grid.size(); ++a) {
            const std::size_t count = grid[a].count();
            if (count <= few) continue;
            // what the samples of the last axis share counts little for many of them
            const std::size_t by = a + 1 == grid.size() ? shift : 0;
            some[a].values.clear();
            for (std::size_t i = 0; i < few; ++i)
                some[a].values.push_back(grid[a].values[(2 * i + by) * count / (2 * few)]);
        }
    };
    choose(0);
    evaluate(some);
    choose(1);
    const auto start = std::chrono::steady_clock::now();
    evaluate(some);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    return taken.count() / static_cast<double>(size_of(some, 0, some.size()));
}

std::vector<InterpolationError> errors_of(Sampler& exact, const Lut& lut) {
    std::vector<InterpolationError> errors;
    exact.says("error", false);
    auto from = lut.values.begin();
    for (const auto& grid : grids_of(lut)) {
        const auto count =
            static_cast<std::ptrdiff_t>(size_of(grid, 0, grid.size()) * lut.channels.size());
        errors.push_back(
            Comparison(exact, grid, as_stored({from, from + count}, lut.type)).error());
        from += count;
    }
    return errors;
}

/// A table without values; with a tolerance, the plan's ranges may be cut.
///   trial  of the plan with a tolerance, nullptr otherwise; refers to it
Lut sized(const LutKind& kind, LutPlan& plan, Sampler* trial, const LutMaking& making) {
    Lut lut;
    lut.kind = kind.name;
    lut.channels = plan.channels;
    lut.type = making.type;
    lut.facts = plan.facts;
    lut.facts["error"] = nullptr;
    if (!lut.facts.contains("notes")) lut.facts["notes"] = nlohmann::json::array();
    for (const AxisPlan& axis : plan.axes) lut.axes.push_back(axis.axis);
    lut.mips = making.mips && plan.mips && plan.axes.front().axis.count() > 1;
    if (!making.sizing.counts.empty()) set_counts(lut, plan, making.sizing.counts);
    const std::optional<FittedAxes>& fitted = making.sizing.fitted;
    if (trial && !(fitted && set_fitted_axes(*fitted, plan, lut)))
        fit_axes(plan, *trial, making, lut);
    const std::size_t samples = size_of(lut.axes, 0, lut.axes.size());
    if (samples > kMostValues)
        throw LutError("a table of " + std::to_string(samples) + " samples is too large");
    return lut;
}

}  // namespace

std::vector<InterpolationError> interpolation_errors(const LutPlan& plan, const Lut& lut,
                                                     unsigned threads) {
    LutMaking making;
    making.threads = threads;
    Sampler exact(plan, making);
    return errors_of(exact, lut);
}

double least_evaluations(const LutPlan& plan, const LutMaking& making) {
    const LutSizing& sizing = making.sizing;
    const bool has_counts = sizing.counts.size() == plan.axes.size();
    const bool is_fitted = sizing.fitted && sizing.fitted->ranges.size() == plan.axes.size();
    double samples = 1;
    std::size_t ranges = 0;
    for (std::size_t a = 0; a < plan.axes.size(); ++a) {
        std::size_t count = plan.axes[a].axis.count();
        const bool is_range = !plan.axes[a].fixed && count > 1 && !(plan.mips && a == 0);
        if (is_range) ++ranges;
        if (is_range && sizing.tolerance) count = static_cast<std::size_t>(kOnLines);
        if (is_range && has_counts) count = sizing.counts[a];
        if (is_range && is_fitted) count = sizing.fitted->ranges[a].count;
        samples *= static_cast<double>(count);
    }
    if (sizing.tolerance &&
        !is_fitted)  // each range is looked at, with few samples along the others
        return samples * static_cast<double>(ranges) * kLookedAt / kOnLines;
    return samples + (making.measure ? Comparison::evaluations(samples, ranges) : 0);
}

Lut sized_lut(const LutKind& kind, LutPlan plan, const LutMaking& making) {
    if (!making.sizing.tolerance) return sized(kind, plan, nullptr, making);
    LutPlan rough = roughly(plan, kOfError * *making.sizing.tolerance);
    Sampler trial(rough, making);
    return sized(kind, rough, &trial, making);
}

std::vector<double> estimated_level_errors(const LutPlan& plan, const Lut& sized,
                                           unsigned threads) {
    std::vector<double> errors;
    if (!sized.mips) return errors;
    LutMaking making;
    making.threads = threads;
    Sampler sample(plan, making);
    const auto compared = [&](const std::vector<LutAxis>& grid) {
        return Comparison(sample, grid, as_stored(sample(grid), sized.type));
    };
    for (std::vector<LutAxis> grid : grids_of(sized)) {
        if (size_of(grid, 0, grid.size()) <= kFewSamples) {
            errors.push_back(compared(grid).error().value);
            continue;
        }
        const double sigma =
            std::exchange(grid.front().values.front(), sized.axes.front().values.front());
        const Comparison sharp = compared(grid);
        double& worst = errors.emplace_back(0);
        for (const Comparison::Difference& place : sharp.worst_middles()) {
            std::vector<LutAxis> cell = sharp.ends_of_cell(place.at);
            cell.front().values = {sigma};
            worst = std::max(worst, compared(cell).worst_middles().front().value);
        }
    }
    return errors;
}

double estimated_seconds(const LutPlan& plan, const Lut& sized, const LutMaking& making) {
    const std::vector<std::vector<LutAxis>> grids = grids_of(sized);
    LutPlan rough = plan;
    if (grids.size() > 1) rough = roughly(plan, kOfError * making.sizing.tolerance.value_or(0));
    double seconds = 0;
    bool is_first = true;  // whose error the sizing knows
    for (const std::vector<LutAxis>& grid : grids) {
        const auto samples = static_cast<double>(size_of(grid, 0, grid.size()));
        seconds += samples * seconds_of_sample(plan.evaluate, grid);
        const auto ranges = static_cast<std::size_t>(
            std::ranges::count_if(grid, [](const LutAxis& axis) { return axis.count() > 1; }));
        if (!is_first)
            seconds +=
                Comparison::evaluations(samples, ranges) * seconds_of_sample(rough.evaluate, grid);
        is_first = false;
    }
    const unsigned cores =
        making.threads > 0 ? making.threads : std::max(1U, std::thread::hardware_concurrency());
    return seconds / cores;
}

Lut make_lut(const LutKind& kind, LutPlan plan, const LutMaking& making) {
    const std::optional<double> tolerance = making.sizing.tolerance;
    LutPlan rough = tolerance ? roughly(plan, kOfError * *tolerance) : plan;
    Sampler trial(rough, making);
    Lut lut = sized(kind, rough, tolerance ? &trial : nullptr, making);
    fill(lut, plan, making);
    if (!making.measure) return lut;
    if (!tolerance && plan.roughly) {
        const std::vector<LutAxis> grid = grids_of(lut).front();
        std::vector<double> stored = lut.values;
        stored.resize(size_of(grid, 0, grid.size()) * lut.channels.size());
        const Comparison first(trial, grid, as_stored(std::move(stored), lut.type));
        rough.evaluate = plan.roughly(kOfMeasured * first.foreseen());
    }
    const std::vector<InterpolationError> errors = errors_of(trial, lut);
    nlohmann::json& facts = lut.facts["error"];
    facts = {{"measure", plan.measure.name}, {"value", errors.front().value}};
    for (std::size_t a = 0; a < lut.axes.size(); ++a)
        facts["at"][lut.axes[a].name] = errors.front().at[a];
    if (lut.mips)
        for (const InterpolationError& error : errors) facts["levels"].push_back(error.value);
    return lut;
}

}  // namespace irido::tables
