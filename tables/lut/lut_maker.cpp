#include "tables/lut/lut_maker.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "core/math/parallel.hpp"

namespace irido::tables {

namespace {

constexpr std::size_t kMostSamplesOfAxis = 8192, kMostValues = 1U << 27;
constexpr std::size_t kChunks = 64;            ///< of the work, whatever the number of threads
constexpr std::size_t kMostFitted = 1U << 20;  ///< samples of a table whose size is looked for
constexpr double kHelpful = 0.9;               ///< of the error, after a step that helped
constexpr int kMostIdle = 3;
constexpr std::size_t kFirstSize = 4;
constexpr std::size_t kDroppedSamples = 65;  ///< along an axis that has one sample
constexpr std::size_t kCoarseSamples = 9;    ///< along others, while one axis is looked at
constexpr std::size_t kWorstCells = 8;       ///< that are looked at on a finer grid
constexpr std::size_t kFineSamples = 9;      ///< along each side of these
constexpr std::size_t kEndSamples = 1025;    ///< along a range that may end early
constexpr std::size_t kFewSamples = 256;     ///< of a level that is measured, not estimated

std::size_t size_of(const std::vector<LutAxis>& axes, std::size_t first, std::size_t last) {
    std::size_t count = 1;
    for (std::size_t a = first; a < last; ++a) count *= axes[a].count();
    return count;
}

/// The plan's function on a grid, in pieces along the plan's axis.
std::vector<double> evaluated(const LutPlan& plan, const std::vector<LutAxis>& axes,
                              unsigned threads, const std::function<void(double)>& progress = {}) {
    const std::size_t split = plan.split_axis, count = axes[split].count();
    const std::size_t outer = size_of(axes, 0, split);
    const std::size_t inner = size_of(axes, split + 1, axes.size()) * plan.channels.size();
    const std::size_t length = (count + kChunks - 1) / kChunks;
    const std::size_t chunks = (count + length - 1) / length;
    std::vector<double> values(outer * count * inner);
    std::atomic<std::size_t> done = 0;
    parallel_for(chunks, threads, [&](std::size_t chunk) {
        const std::size_t first = chunk * length, last = std::min(count, first + length);
        std::vector<LutAxis> part = axes;
        const auto& all = axes[split].values;
        part[split].values.assign(all.begin() + static_cast<std::ptrdiff_t>(first),
                                  all.begin() + static_cast<std::ptrdiff_t>(last));
        const std::vector<double> block = plan.evaluate(part);
        const std::size_t row = (last - first) * inner;
        for (std::size_t o = 0; o < outer; ++o)
            std::copy_n(block.begin() + static_cast<std::ptrdiff_t>(o * row), row,
                        values.begin() + static_cast<std::ptrdiff_t>((o * count + first) * inner));
        const std::size_t ready = ++done;
        if (progress) progress(static_cast<double>(ready) / static_cast<double>(chunks));
    });
    return values;
}

/// Values on a grid, linearly interpolated at other samples along one of its axes.
std::vector<double> resampled(const std::vector<double>& values, const std::vector<LutAxis>& axes,
                              std::size_t a, const std::vector<double>& at, std::size_t channels) {
    const std::vector<double>& x = axes[a].values;
    const std::size_t outer = size_of(axes, 0, a);
    const std::size_t inner = size_of(axes, a + 1, axes.size()) * channels;
    std::vector<double> result(outer * at.size() * inner);
    for (std::size_t j = 0; j < at.size(); ++j) {
        const std::size_t i = axes[a].cell_of(at[j]);
        const std::size_t next = std::min(i + 1, x.size() - 1);
        const auto place = [&axis = axes[a]](double value) { return axis.place_of(value); };
        const double w =
            next == i ? 0
                      : std::clamp((place(at[j]) - place(x[i])) / (place(x[next]) - place(x[i])),
                                   0.0, 1.0);
        for (std::size_t o = 0; o < outer; ++o) {
            const double* const low = values.data() + (o * x.size() + i) * inner;
            const double* const high = values.data() + (o * x.size() + next) * inner;
            double* const to = result.data() + (o * at.size() + j) * inner;
            for (std::size_t k = 0; k < inner; ++k) to[k] = low[k] * (1 - w) + high[k] * w;
        }
    }
    return result;
}

std::vector<double> middles(const LutAxis& axis) {
    const std::vector<double>& x = axis.values;
    std::vector<double> result;
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
        result.push_back(axis.at_place(0.5 * (axis.place_of(x[i]) + axis.place_of(x[i + 1]))));
    return result;
}

/// One grid with its stored values, for comparison with the plan's function.
class Comparison {
public:
    Comparison(const LutPlan& plan, std::vector<LutAxis> axes, std::vector<double> stored,
               unsigned threads)
        : plan_(plan), axes_(std::move(axes)), stored_(std::move(stored)), threads_(threads) {}

    /// Samples between those of the grid at which an axis is checked; none if it is a list.
    std::vector<double> between(std::size_t a) const {
        const LutAxis& planned = plan_.axes[a].axis;
        if (plan_.mips && a == 0) return {};
        if (plan_.axes[a].fixed && axes_[a].half_at == 0 &&
            (axes_[a].count() < 3 || !axes_[a].is_linear()))
            return {};
        if (axes_[a].count() > 1) return middles(axes_[a]);
        if (plan_.axes[a].fixed || planned.count() < 2) return {};
        return equally_spaced(planned.values.front(), planned.values.back(), kDroppedSamples);
    }

    struct Difference {
        double value = 0;
        std::vector<double> at;
    };

    /// The largest differences at the samples of `targets`, the largest first, and where.
    std::vector<Difference> largest(const std::vector<LutAxis>& targets, std::size_t most) const {
        std::vector<LutAxis> axes = axes_;
        std::vector<double> approximate = stored_;
        for (std::size_t a = 0; a < axes.size(); ++a) {
            if (targets[a] == axes[a]) continue;
            approximate = resampled(approximate, axes, a, targets[a].values, channels());
            axes[a] = targets[a];
        }
        const std::vector<double> exact = evaluated(plan_, targets, threads_);
        const std::vector<double> d = plan_.measure.differences(targets, exact, approximate);
        std::vector<std::size_t> order(d.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        most = std::min(most, order.size());
        std::ranges::partial_sort(
            order, order.begin() + static_cast<std::ptrdiff_t>(most),
            [&](std::size_t i, std::size_t j) { return d[i] > d[j] || (d[i] == d[j] && i < j); });
        std::vector<Difference> result;
        for (std::size_t i = 0; i < most; ++i) {
            std::size_t place = order[i];
            Difference& one = result.emplace_back(Difference{d[place], {}});
            one.at.resize(axes.size());
            for (std::size_t a = axes.size(); a-- > 0; place /= axes[a].count())
                one.at[a] = axes[a].values[place % axes[a].count()];
        }
        return result;
    }

    InterpolationError error() const {
        InterpolationError result;
        result.of_axis.resize(axes_.size());
        std::vector<LutAxis> all = axes_;
        std::vector<Difference> worst;
        const auto look_at = [&](const std::vector<LutAxis>& targets) {
            const std::vector<Difference> found = largest(targets, kWorstCells);
            worst.insert(worst.end(), found.begin(), found.end());
            keep(result, found.front());
            return found.front().value;
        };
        std::size_t ranges = 0;
        for (std::size_t a = 0; a < axes_.size(); ++a) {
            const std::vector<double> samples = between(a);
            if (samples.empty()) continue;
            std::vector<LutAxis> targets = axes_;
            targets[a].values = all[a].values = samples;
            ++ranges;
            result.of_axis[a] = look_at(targets);
        }
        if (ranges != 1) look_at(all);  // without ranges: the rounding error of the type
        if (ranges == 0) return result;
        std::ranges::stable_sort(worst, std::ranges::greater(), &Difference::value);
        worst.resize(std::min(worst.size(), kWorstCells));
        for (const Difference& one : worst) keep(result, largest(cell_of(one.at), 1).front());
        return result;
    }

    /// The largest differences at the middles of all cells, and where.
    std::vector<Difference> worst_middles() const {
        std::vector<LutAxis> targets = axes_;
        for (std::size_t a = 0; a < axes_.size(); ++a)
            if (const std::vector<double> samples = between(a); !samples.empty())
                targets[a].values = samples;
        return largest(targets, kWorstCells);
    }

    /// The samples of the grid around a place.
    std::vector<LutAxis> ends_of_cell(const std::vector<double>& at) const {
        std::vector<LutAxis> ends = axes_;
        for (std::size_t a = 0; a < axes_.size(); ++a) {
            const std::vector<double>& x = axes_[a].values;
            const std::size_t i = axes_[a].cell_of(at[a]);
            ends[a].values = {x[i]};
            if (x.size() > 1) ends[a].values.push_back(x[i + 1]);
        }
        return ends;
    }

private:
    std::size_t channels() const { return plan_.channels.size(); }

    static void keep(InterpolationError& result, const Difference& one) {
        if (!result.at.empty() && !(one.value > result.value)) return;
        result.value = one.value;
        result.at = one.at;
    }

    /// A fine grid over the cell around a place.
    std::vector<LutAxis> cell_of(const std::vector<double>& at) const {
        std::vector<LutAxis> cell = axes_;
        for (std::size_t a = 0; a < axes_.size(); ++a) {
            const std::vector<double>& x = axes_[a].values;
            cell[a].values = {at[a]};
            if (x.size() < 2 || between(a).empty()) continue;
            const std::size_t i = axes_[a].cell_of(at[a]);
            cell[a].values = equally_spaced(x[i], x[i + 1], kFineSamples);
        }
        return cell;
    }

    const LutPlan& plan_;
    std::vector<LutAxis> axes_;
    std::vector<double> stored_;
    unsigned threads_;
};

std::vector<double> as_stored(std::vector<double> values, LutType type) {
    for (double& value : values) value = rounded(value, type);
    return values;
}

/// The parts of a table that are sampled together, as grids of the plan's axes.
std::vector<std::vector<LutAxis>> grids_of(const Lut& lut) {
    if (!lut.mips) return {lut.axes};
    std::vector<std::vector<LutAxis>> grids;
    for (std::size_t level = 0; level < lut.levels(); ++level) {
        std::vector<LutAxis> axes = lut.axes_of_level(level);
        LutAxis of_level = lut.axes.front();
        of_level.values = {of_level.values[level]};
        axes.insert(axes.begin(), std::move(of_level));
        grids.push_back(std::move(axes));
    }
    return grids;
}

std::string name_of_axis(const LutAxis& axis) {
    return axis.unit.empty() ? axis.name : axis.name + " (" + axis.unit + ")";
}

/// Finds axes for a tolerance.
class Fit {
public:
    Fit(LutPlan& plan, const LutMaking& making, Lut& lut)
        : plan_(plan), making_(making), lut_(lut), tolerance_(*making.sizing.tolerance) {}

    void run() {
        for (std::size_t a = 0; a < plan_.axes.size(); ++a)
            if (plan_.axes[a].may_end_early && is_free(a)) end_early(a);
        for (std::size_t a = 0; a < plan_.axes.size(); ++a)
            if (is_free(a)) start(a);
        grow();
        shrink();
    }

private:
    bool is_free(std::size_t a) const {
        return !plan_.axes[a].fixed && plan_.axes[a].axis.count() > 1 && !(lut_.mips && a == 0);
    }

    void note(const std::string& text) { lut_.facts["notes"].push_back(text); }

    LutAxis range(std::size_t a, std::size_t count) const {
        LutAxis axis = plan_.axes[a].axis;
        axis.values = axis.spaced(count);
        return axis;
    }

    /// Few samples along the other axes.
    std::vector<LutAxis> coarse() const {
        std::vector<LutAxis> axes;
        for (std::size_t a = 0; a < plan_.axes.size(); ++a)
            axes.push_back(is_free(a) ? range(a, kCoarseSamples) : plan_.axes[a].axis);
        // larger spreads only leave less to see
        if (lut_.mips) axes.front().values.resize(1);
        return axes;
    }

    /// Along axis a of a grid: the last sample that differs from the last of all.
    std::size_t last_different(std::size_t a, const std::vector<LutAxis>& axes,
                               std::size_t reference) const {
        const std::vector<double> values = evaluated(plan_, axes, making_.threads);
        const std::size_t channels = plan_.channels.size();
        const std::vector<double> constant =
            resampled(values, axes, a,
                      std::vector<double>(axes[a].count(), axes[a].values[reference]), channels);
        const std::vector<double> d = plan_.measure.differences(axes, values, constant);
        const std::size_t inner = size_of(axes, a + 1, axes.size()), count = axes[a].count();
        std::size_t last = 0;
        for (std::size_t i = 0; i < d.size(); ++i)
            if (!(d[i] <= tolerance_ / 4)) last = std::max(last, 1 + i / inner % count);
        return last;
    }

    /// The range ends where the function has become constant.
    void end_early(std::size_t a) {
        std::vector<LutAxis> axes = coarse();
        axes[a] = range(a, kEndSamples);
        const std::size_t last = last_different(a, axes, kEndSamples - 1);
        if (last == 0 || last + kEndSamples / 16 >= kEndSamples) return;
        LutAxis& axis = plan_.axes[a].axis;
        axis.values = {axis.values.front(), axes[a].values[last]};
        const std::string reason(plan_.axes[a].end_reason);
        note(axis.name + ": " + (reason.empty() ? "" : reason + ", ") + "constant beyond " +
             to_text(axis.values.back()) + ": range cut there");
    }

    /// One sample for an axis along which the function is constant, few for others.
    void start(std::size_t a) {
        std::vector<LutAxis> axes = coarse();
        axes[a] = range(a, kDroppedSamples);
        const LutAxis whole = range(a, 3);
        // parts side by side cannot be told apart in one texel
        const bool is_needed = lut_.mips && lut_.channels.size() > 4 && a + 1 == lut_.axes.size();
        if (!is_needed && last_different(a, axes, kDroppedSamples / 2) == 0) {
            lut_.axes[a].values = {whole.values[1]};
            note(whole.name + ": constant over [" + to_text(whole.values.front()) + ", " +
                 to_text(whole.values.back()) + "]: stored as one sample");
        } else {
            lut_.axes[a] = range(a, std::max(kFirstSize, least()));
        }
    }

    /// The fewest samples along a non-constant axis: two, also in the last mip level.
    std::size_t least() const { return lut_.mips ? std::size_t{2} << (lut_.levels() - 1) : 2; }

    /// Of the first mip level, where there are any.
    InterpolationError error_now() {
        const std::vector<LutAxis> grid = grids_of(lut_).front();
        const Comparison comparison(plan_, grid,
                                    as_stored(evaluated(plan_, grid, making_.threads), lut_.type),
                                    making_.threads);
        return comparison.error();
    }

    void grow() {
        double before = std::numeric_limits<double>::infinity();
        int idle = 0;  // steps without improvement
        for (InterpolationError error = error_now(); error.value > tolerance_;
             error = error_now()) {
            idle = error.value > kHelpful * before ? idle + 1 : 0;
            before = error.value;
            if (idle == kMostIdle || !has_grown(error) ||
                size_of(lut_.axes, 0, lut_.axes.size()) > kMostFitted)
                give_up(error);
        }
    }

    /// Enlarges the axes that contribute most to the error, if possible.
    bool has_grown(const InterpolationError& error) {
        double largest = 0;
        for (std::size_t a = 0; a < plan_.axes.size(); ++a)
            if (is_free(a)) largest = std::max(largest, error.of_axis[a]);
        bool has_grown = false;
        for (std::size_t a = 0; a < plan_.axes.size(); ++a) {
            // errors of the axes add up: each may take its share
            const std::size_t count = lut_.axes[a].count();
            if (!is_free(a) || !(error.of_axis[a] > largest / 2) || count >= kMostSamplesOfAxis)
                continue;
            // the error falls with the square of the spacing, once it is small
            const std::size_t factor = error.of_axis[a] > 16 * tolerance_ ? 4 : 2;
            lut_.axes[a] = range(a, std::max(kFirstSize, count * factor));
            has_grown = true;
        }
        return has_grown;
    }

    [[noreturn]] void give_up(const InterpolationError& error) const {
        std::string place;
        for (std::size_t a = 0; a < lut_.axes.size(); ++a)
            place += (a > 0 ? ", " : "") + lut_.axes[a].name + " " + to_text(error.at[a]);
        throw ToleranceError("no table of a reasonable size reaches an interpolation error of " +
                             to_text(tolerance_) + " (" + plan_.measure.name +
                             "): the function is too steep at " + place + ", where " +
                             to_text(error.value) + " remains; a range that excludes it may work");
    }

    /// Fewer samples along one axis after the other, the largest first, while the error allows.
    void shrink() {
        std::vector<std::size_t> order;
        for (std::size_t a = 0; a < plan_.axes.size(); ++a)
            if (is_free(a) && lut_.axes[a].count() > 1) order.push_back(a);
        std::ranges::stable_sort(order, std::ranges::greater(),
                                 [&](std::size_t a) { return lut_.axes[a].count(); });
        for (const std::size_t a : order) {
            std::size_t enough = lut_.axes[a].count();
            while (enough > least() && suffices(a, enough / 2)) enough /= 2;
            if (!making_.sizing.power_of_two && enough > least())
                enough = fewest(a, enough / 2, enough);
            lut_.axes[a] = range(a, enough);
        }
    }

    bool suffices(std::size_t a, std::size_t count) {
        lut_.axes[a] = range(a, count);
        return error_now().value <= tolerance_;
    }

    /// Bisects between too few and enough samples, to 3 %.
    std::size_t fewest(std::size_t a, std::size_t few, std::size_t enough) {
        while (enough - few > std::max<std::size_t>(1, enough / 32)) {
            const std::size_t middle = (enough + few) / 2;
            (suffices(a, middle) ? enough : few) = middle;
        }
        return enough;
    }

    LutPlan& plan_;
    const LutMaking& making_;
    Lut& lut_;
    double tolerance_;
};

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
    for (const auto& grid : grids_of(lut)) {
        const std::vector<double> values = evaluated(plan, grid, making.threads, making.progress);
        lut.values.insert(lut.values.end(), values.begin(), values.end());
    }
}

/// A table without values; with a tolerance, the plan's ranges may be cut.
Lut sized(const LutKind& kind, LutPlan& plan, const LutMaking& making) {
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
    if (making.sizing.tolerance) Fit(plan, making, lut).run();
    const std::size_t samples = size_of(lut.axes, 0, lut.axes.size());
    if (samples > kMostValues)
        throw LutError("a table of " + std::to_string(samples) + " samples is too large");
    return lut;
}

}  // namespace

std::vector<InterpolationError> interpolation_errors(const LutPlan& plan, const Lut& lut,
                                                     unsigned threads) {
    std::vector<InterpolationError> errors;
    auto from = lut.values.begin();
    for (const auto& grid : grids_of(lut)) {
        const auto count =
            static_cast<std::ptrdiff_t>(size_of(grid, 0, grid.size()) * lut.channels.size());
        const Comparison comparison(plan, grid, as_stored({from, from + count}, lut.type), threads);
        from += count;
        errors.push_back(comparison.error());
    }
    return errors;
}

double least_evaluations(const LutPlan& plan, const LutMaking& making) {
    const LutSizing& sizing = making.sizing;
    const bool has_counts = sizing.counts.size() == plan.axes.size();
    double samples = 1;
    std::size_t ranges = 0;
    for (std::size_t a = 0; a < plan.axes.size(); ++a) {
        std::size_t count = plan.axes[a].axis.count();
        const bool is_range = !plan.axes[a].fixed && count > 1 && !(plan.mips && a == 0);
        if (is_range) ++ranges;
        if (is_range && sizing.tolerance) count = kCoarseSamples;
        if (is_range && has_counts) count = sizing.counts[a];
        samples *= static_cast<double>(count);
    }
    if (sizing.tolerance)  // each range is looked at, with few samples along the others
        return samples * static_cast<double>(ranges * kDroppedSamples) / kCoarseSamples;
    // the values; and to measure their error, between them along each range and along all
    return samples * (making.measure ? 2 + static_cast<double>(ranges) : 1);
}

Lut sized_lut(const LutKind& kind, LutPlan plan, const LutMaking& making) {
    return sized(kind, plan, making);
}

std::vector<double> estimated_level_errors(const LutPlan& plan, const Lut& sized,
                                           unsigned threads) {
    std::vector<double> errors;
    if (!sized.mips) return errors;
    const auto compared = [&](const std::vector<LutAxis>& grid) {
        return Comparison(plan, grid, as_stored(evaluated(plan, grid, threads), sized.type),
                          threads);
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

double estimated_seconds(const LutPlan& plan, const Lut& sized, unsigned threads) {
    constexpr std::size_t few = 8;  // samples along an axis
    constexpr double evaluations =
        4;  // of the values, between them along each of two axes and both
    double seconds = 0;
    for (std::vector<LutAxis> grid : grids_of(sized)) {
        const auto all = static_cast<double>(size_of(grid, 0, grid.size()));
        for (LutAxis& axis : grid)
            if (axis.count() > few)
                axis.values = equally_spaced(axis.values.front(), axis.values.back(), few);
        const auto start = std::chrono::steady_clock::now();
        plan.evaluate(grid);
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        seconds += taken.count() * evaluations *
                   std::max(1.0, all / static_cast<double>(size_of(grid, 0, grid.size())));
    }
    const unsigned cores =
        threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
    return seconds / cores;
}

Lut make_lut(const LutKind& kind, LutPlan plan, const LutMaking& making) {
    Lut lut = sized(kind, plan, making);
    fill(lut, plan, making);
    if (!making.measure) return lut;
    const std::vector<InterpolationError> errors = interpolation_errors(plan, lut, making.threads);
    nlohmann::json& facts = lut.facts["error"];
    facts = {{"measure", plan.measure.name}, {"value", errors.front().value}};
    for (std::size_t a = 0; a < lut.axes.size(); ++a)
        facts["at"][lut.axes[a].name] = errors.front().at[a];
    if (lut.mips)
        for (const InterpolationError& error : errors) facts["levels"].push_back(error.value);
    return lut;
}

}  // namespace irido::tables
