#include "tables/lut/interpolation.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "core/math/parallel.hpp"

namespace irido::tables {

namespace {

constexpr std::size_t kChunks = 64;                ///< of the work, whatever the number of threads
constexpr std::size_t kMostRemembered = 1U << 22;  ///< values of grids
constexpr std::size_t kDroppedSamples = 65;        ///< along an axis that has one sample
constexpr std::size_t kWorstCells = 8;             ///< that are looked at on a finer grid
constexpr std::size_t kFineSamples = 9;            ///< along each side of these

/// Of a grid that is larger, so many samples are looked at: half of the columns along its longest
/// axis where curvature promises the largest errors, half evenly spaced.
constexpr std::size_t kManySamples = 2048, kFewestColumns = 16;

std::vector<double> middles(const LutAxis& axis) {
    const std::vector<double>& x = axis.values;
    std::vector<double> result;
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
        result.push_back(axis.at_place(0.5 * (axis.place_of(x[i]) + axis.place_of(x[i + 1]))));
    return result;
}

/// Values in the middles of an axis, by parabolas through four samples, or three at the ends.
std::vector<double> curved(const std::vector<double>& values, const std::vector<LutAxis>& axes,
                           std::size_t a, std::size_t channels) {
    const std::size_t count = axes[a].count(), outer = size_of(axes, 0, a);
    const std::size_t inner = size_of(axes, a + 1, axes.size()) * channels;
    std::vector<double> result(outer * (count - 1) * inner);
    for (std::size_t o = 0; o < outer; ++o) {
        for (std::size_t i = 0; i + 1 < count; ++i) {
            const double* low = values.data() + (o * count + i) * inner;
            const double *high = low + inner, *before = i > 0 ? low - inner : nullptr;
            const double* after = i + 2 < count ? high + inner : nullptr;
            double* to = result.data() + (o * (count - 1) + i) * inner;
            for (std::size_t k = 0; k < inner; ++k) {
                const double below = before  ? before[k]
                                     : after ? 3 * (low[k] - high[k]) + after[k]
                                             : 0;
                const double above = after    ? after[k]
                                     : before ? 3 * (high[k] - low[k]) + before[k]
                                              : 0;
                to[k] = before || after ? (9 * (low[k] + high[k]) - below - above) / 16
                                        : (low[k] + high[k]) / 2;
            }
        }
    }
    return result;
}

void keep(InterpolationError& result, const Comparison::Difference& one) {
    if (!result.at.empty() && !(one.value > result.value)) return;
    result.value = one.value;
    result.at = one.at;
}

}  // namespace

std::size_t size_of(const std::vector<LutAxis>& axes, std::size_t first, std::size_t last) {
    std::size_t count = 1;
    for (std::size_t a = first; a < last; ++a) count *= axes[a].count();
    return count;
}

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

void Sampler::says(std::string what, bool shares) {
    what_ = std::move(what);
    shares_ = shares;
    tell(0);
}

void Sampler::tell(double done) const {
    if (progress_) progress_(shares_ ? done : 0, what_);
}

std::vector<double> Sampler::operator()(const std::vector<LutAxis>& axes) {
    for (const Remembered& known : known_)
        if (std::ranges::equal(known.axes, axes, {}, {}, &LutAxis::values)) return known.values;
    std::vector<double> values = evaluated(axes);
    if (values.size() > kMostRemembered) return values;
    std::vector<std::vector<double>> key;
    for (const LutAxis& axis : axes) key.push_back(axis.values);
    known_.push_back({std::move(key), values});
    remembered_ += values.size();
    for (; remembered_ > kMostRemembered; known_.pop_front())
        remembered_ -= known_.front().values.size();
    return values;
}

std::vector<double> Sampler::evaluated(const std::vector<LutAxis>& axes) const {
    const std::size_t split = plan_.split_axis, count = axes[split].count();
    const std::size_t outer = size_of(axes, 0, split);
    const std::size_t inner = size_of(axes, split + 1, axes.size()) * plan_.channels.size();
    const std::size_t length = (count + kChunks - 1) / kChunks;
    const std::size_t chunks = (count + length - 1) / length;
    std::vector<double> values(outer * count * inner);
    std::atomic<std::size_t> done = 0;
    parallel_for(chunks, threads_, [&](std::size_t chunk) {
        const std::size_t first = chunk * length, last = std::min(count, first + length);
        std::vector<LutAxis> part = axes;
        const auto& all = axes[split].values;
        part[split].values.assign(all.begin() + static_cast<std::ptrdiff_t>(first),
                                  all.begin() + static_cast<std::ptrdiff_t>(last));
        const std::vector<double> block = plan_.evaluate(part);
        const std::size_t row = (last - first) * inner;
        for (std::size_t o = 0; o < outer; ++o)
            std::copy_n(block.begin() + static_cast<std::ptrdiff_t>(o * row), row,
                        values.begin() + static_cast<std::ptrdiff_t>((o * count + first) * inner));
        tell(static_cast<double>(++done) / static_cast<double>(chunks));
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

std::vector<double> Comparison::between(std::size_t a) const {
    const LutAxis& planned = plan_.axes[a].axis;
    if (plan_.mips && a == 0) return {};
    if (plan_.axes[a].fixed && axes_[a].half_at == 0 &&
        (axes_[a].count() < 3 || !axes_[a].is_linear()))
        return {};
    if (axes_[a].count() > 1) return middles(axes_[a]);
    if (plan_.axes[a].fixed || planned.count() < 2) return {};
    return equally_spaced(planned.values.front(), planned.values.back(), kDroppedSamples);
}

/// The stored values, interpolated at the samples of `targets`.
std::vector<double> Comparison::interpolated(const std::vector<LutAxis>& targets) const {
    std::vector<LutAxis> axes = axes_;
    std::vector<double> approximate = stored_;
    for (std::size_t a = 0; a < axes.size(); ++a) {
        if (targets[a] == axes[a]) continue;
        approximate = resampled(approximate, axes, a, targets[a].values, channels());
        axes[a] = targets[a];
    }
    return approximate;
}

std::vector<Comparison::Difference> Comparison::largest(const std::vector<LutAxis>& targets,
                                                        std::size_t most) const {
    const std::vector<double> approximate = interpolated(targets);
    const std::vector<double> exact = exact_(targets);
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
        one.at.resize(targets.size());
        for (std::size_t a = targets.size(); a-- > 0; place /= targets[a].count())
            one.at[a] = targets[a].values[place % targets[a].count()];
    }
    return result;
}

/// Differences at the targets, by the curvature of the stored values.
std::vector<double> Comparison::foreseen(const std::vector<LutAxis>& targets) const {
    std::vector<LutAxis> axes = axes_;
    std::vector<double> guess = stored_;
    for (std::size_t a = 0; a < axes.size(); ++a) {
        if (targets[a] == axes[a]) continue;
        guess = axes[a].count() > 1 ? curved(guess, axes, a, channels())
                                    : resampled(guess, axes, a, targets[a].values, channels());
        axes[a] = targets[a];
    }
    return plan_.measure.differences(targets, guess, interpolated(targets));
}

double Comparison::foreseen() const {
    double largest = 0;
    for (const double d : foreseen(all_middles()))
        if (d > largest) largest = d;
    return largest;
}

/// Those of the targets that are worth looking at, if they are many.
std::vector<LutAxis> Comparison::promising(const std::vector<LutAxis>& targets) const {
    const std::size_t all = size_of(targets, 0, targets.size());
    std::size_t longest = 0;
    for (std::size_t a = 0; a < targets.size(); ++a)
        if (targets[a].count() > targets[longest].count()) longest = a;
    const std::size_t columns = targets[longest].count();
    const std::size_t wanted = std::max(kFewestColumns, kManySamples * columns / all);
    if (all <= kManySamples || columns <= wanted) return targets;
    const std::vector<double> d = foreseen(targets);
    const std::size_t inner = size_of(targets, longest + 1, targets.size());
    std::vector<double> worst(columns);
    for (std::size_t i = 0; i < d.size(); ++i) {
        double& of_column = worst[i / inner % columns];
        of_column = std::max(of_column, d[i]);
    }
    std::vector<std::size_t> order(columns);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::ranges::greater(),
                             [&](std::size_t i) { return worst[i]; });
    std::vector<bool> taken(columns);
    for (std::size_t i = 0; i < wanted / 2; ++i) {
        taken[order[i]] = true;
        taken[(2 * i + 1) * columns / (wanted / 2 * 2)] = true;
    }
    std::vector<LutAxis> some = targets;
    some[longest].values.clear();
    for (std::size_t i = 0; i < columns; ++i)
        if (taken[i]) some[longest].values.push_back(targets[longest].values[i]);
    return some;
}

InterpolationError Comparison::error() const {
    InterpolationError result;
    result.of_axis.resize(axes_.size());
    std::vector<LutAxis> all = axes_;
    std::vector<Difference> worst;
    const auto look_at = [&](const std::vector<LutAxis>& targets) {
        const std::vector<Difference> found = largest(promising(targets), kWorstCells);
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

double Comparison::evaluations(double samples, std::size_t ranges) {
    return std::min(samples, static_cast<double>(kManySamples)) * static_cast<double>(ranges + 1);
}

std::vector<LutAxis> Comparison::all_middles() const {
    std::vector<LutAxis> targets = axes_;
    for (std::size_t a = 0; a < axes_.size(); ++a)
        if (const std::vector<double> samples = between(a); !samples.empty())
            targets[a].values = samples;
    return targets;
}

std::vector<Comparison::Difference> Comparison::worst_middles() const {
    return largest(all_middles(), kWorstCells);
}

std::vector<LutAxis> Comparison::ends_of_cell(const std::vector<double>& at) const {
    std::vector<LutAxis> ends = axes_;
    for (std::size_t a = 0; a < axes_.size(); ++a) {
        const std::vector<double>& x = axes_[a].values;
        const std::size_t i = axes_[a].cell_of(at[a]);
        ends[a].values = {x[i]};
        if (x.size() > 1) ends[a].values.push_back(x[i + 1]);
    }
    return ends;
}

/// A fine grid over the cell around a place.
std::vector<LutAxis> Comparison::cell_of(const std::vector<double>& at) const {
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

}  // namespace irido::tables
