#include "tables/lut/lut_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace irido::tables {

namespace {

constexpr std::size_t kMostSamplesOfAxis = 8192;
constexpr std::size_t kMostFitted = 1U << 20;  ///< samples of a table whose size is looked for
constexpr double kHelpful = 0.9;               ///< of the error, after a step that helped
constexpr int kMostIdle = 3;
constexpr std::size_t kFirstSize = 4;
constexpr std::size_t kConstantSamples = 65;  ///< along an axis that may get one sample
constexpr std::size_t kCoarseSamples = 9;     ///< along others, while one axis is looked at
constexpr std::size_t kEndSamples = 1025;     ///< along a range that may end early
constexpr std::size_t kFewOnLines = 64;  ///< samples up to which all lines along an axis are tried

/// Whether an error will be small enough before there are too many samples along an axis, going by
/// how it fell so far. Fringes that are not resolved yet tell nothing: the error of few samples
/// counts only where it is near the tolerance.
class Prospect {
public:
    explicit Prospect(double tolerance) : tolerance_(tolerance) {}

    /// False if twice in a row the errors so far promised too many samples.
    bool is_good(double error, std::size_t count) {
        const auto samples = static_cast<double>(count);
        if (samples_ > 0) {
            const double power = std::log(error_ / error) / std::log(samples / samples_);
            const bool is_telling = count >= kManySamples || error <= kNear * tolerance_;
            const bool is_far =
                !(power > 0) || samples * std::pow(error / tolerance_, 1 / power) >
                                    kFarOff * static_cast<double>(kMostSamplesOfAxis);
            far_ = is_telling && is_far ? far_ + 1 : 0;
        }
        error_ = error;
        samples_ = samples;
        return far_ < kMostFar;
    }

private:
    static constexpr double kFarOff = 2, kNear = 16;
    static constexpr std::size_t kManySamples = 256;
    static constexpr int kMostFar = 2;

    double tolerance_, error_ = 0, samples_ = 0;
    int far_ = 0;
};

/// Whether the tolerance decides how many samples an axis has.
bool is_sized(const LutPlan& plan, const Lut& lut, std::size_t a) {
    return !plan.axes[a].fixed && plan.axes[a].axis.count() > 1 && !(lut.mips && a == 0);
}

/// Finds axes for a tolerance.
class Fit {
public:
    /// sample  of the plan, exact enough for its errors
    Fit(LutPlan& plan, Sampler& sample, const LutMaking& making, Lut& lut)
        : plan_(plan),
          sample_(sample),
          making_(making),
          lut_(lut),
          tolerance_(*making.sizing.tolerance),
          worst_lines_(plan.axes.size()) {}

    void run() {
        for (std::size_t a = 0; a < plan_.axes.size(); ++a)
            if (plan_.axes[a].may_end_early && is_free(a)) end_early(a);
        for (std::size_t a = 0; a < plan_.axes.size(); ++a)
            if (is_free(a)) start(a);
        grow();
        shrink();
    }

private:
    bool is_free(std::size_t a) const { return is_sized(plan_, lut_, a); }

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
        const std::vector<double> values = sample_(axes);
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
        axes[a] = range(a, kConstantSamples);
        const LutAxis whole = range(a, 3);
        // parts side by side cannot be told apart in one texel
        const bool is_needed = lut_.mips && lut_.channels.size() > 4 && a + 1 == lut_.axes.size();
        if (!is_needed && last_different(a, axes, kConstantSamples / 2) == 0) {
            lut_.axes[a].values = {whole.values[1]};
            note(whole.name + ": constant over [" + to_text(whole.values.front()) + ", " +
                 to_text(whole.values.back()) + "]: stored as one sample");
        } else {
            lut_.axes[a] = range(a, first_size(a));
        }
    }

    /// The largest error along axis a of so many samples, on a few lines that are exact along the
    /// other axes: no table of as many can be much better. Of many samples, on the line where fewer
    /// were worst.
    Comparison::Difference error_on_lines(std::size_t a, std::size_t count) {
        std::vector<LutAxis> axes =
            count > kFewOnLines && !worst_lines_[a].empty() ? worst_lines_[a] : coarse();
        axes[a] = range(a, count);
        Comparison::Difference worst{0, places_of(axes)};
        const Comparison comparison(sample_, axes, as_stored(sample_(axes), lut_.type));
        const std::vector<double> between = comparison.between(a);
        if (between.empty()) return worst;
        std::vector<LutAxis> targets = axes;
        targets[a].values = between;
        worst = comparison.largest(targets, 1).front();
        if (lut_.mips) worst.at.front() = axes.front().values.front();
        worst_lines_[a] = axes;
        for (std::size_t b = 0; b < axes.size(); ++b)
            if (b != a && is_free(b)) worst_lines_[a][b].values = {worst.at[b]};
        return worst;
    }

    static std::vector<double> places_of(const std::vector<LutAxis>& axes) {
        std::vector<double> places;
        for (const LutAxis& axis : axes) places.push_back(axis.values.front());
        return places;
    }

    /// Samples along an axis that suffice on lines along it.
    std::size_t first_size(std::size_t a) {
        std::size_t count = std::max(kFirstSize, least());
        Prospect prospect(tolerance_);
        while (true) {
            sample_.says("size along " + plan_.axes[a].axis.name + ", " + std::to_string(count),
                         false);
            const Comparison::Difference error = error_on_lines(a, count);
            if (error.value <= tolerance_) return count;
            if (count >= kMostSamplesOfAxis || !prospect.is_good(error.value, count))
                give_up({error.value, error.at, {}});
            count = std::min(kMostSamplesOfAxis, count * growth(error.value));
        }
    }

    /// The error falls with the square of the spacing, once it is small.
    std::size_t growth(double error) const { return error > 16 * tolerance_ ? 4 : 2; }

    /// The fewest samples along a non-constant axis: two, also in the last mip level.
    std::size_t least() const { return lut_.mips ? std::size_t{2} << (lut_.levels() - 1) : 2; }

    /// Of the first mip level, where there are any.
    InterpolationError error_now() {
        const std::vector<LutAxis> grid = grids_of(lut_).front();
        std::string size;
        for (const LutAxis& axis : grid)
            size += (size.empty() ? "" : " x ") + std::to_string(axis.count());
        sample_.says("error of " + size, false);
        return Comparison(sample_, grid, as_stored(sample_(grid), lut_.type)).error();
    }

    void grow() {
        double before = std::numeric_limits<double>::infinity();
        int idle = 0;  // steps without improvement
        bool was_in_corner = false;
        for (InterpolationError error = error_now(); error.value > tolerance_;
             error = error_now()) {
            idle = error.value > kHelpful * before ? idle + 1 : 0;
            before = error.value;
            // where the cells of a corner become smaller and the error does not, the function is
            // the same on any scale there
            const bool in_corner = is_in_corner(error);
            const bool is_hopeless = idle > 0 && was_in_corner && in_corner;
            was_in_corner = in_corner;
            if (is_hopeless || idle == kMostIdle || !has_grown(error) ||
                size_of(lut_.axes, 0, lut_.axes.size()) > kMostFitted)
                give_up(error);
        }
    }

    /// Whether a place is in the first or the last cell along every axis.
    bool is_in_corner(const InterpolationError& error) const {
        for (std::size_t a = 0; a < lut_.axes.size(); ++a) {
            const std::vector<double>& values = lut_.axes[a].values;
            if (is_free(a) && values.size() > 2 && error.at[a] > values[1] &&
                error.at[a] < values[values.size() - 2])
                return false;
        }
        return true;
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
            lut_.axes[a] = range(a, std::max(kFirstSize, count * growth(error.of_axis[a])));
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
        if (error_on_lines(a, count).value > tolerance_) return false;
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
    Sampler& sample_;
    const LutMaking& making_;
    Lut& lut_;
    double tolerance_;
    std::vector<std::vector<LutAxis>> worst_lines_;  ///< along each axis
};

}  // namespace

bool set_fitted_axes(const FittedAxes& fitted, LutPlan& plan, Lut& lut) {
    std::vector<AxisPlan> planned = plan.axes;
    std::vector<LutAxis> axes = lut.axes;
    if (fitted.ranges.size() != axes.size()) return false;
    for (std::size_t a = 0; a < axes.size(); ++a) {
        const auto& [first, last, count] = fitted.ranges[a];
        LutAxis& range = planned[a].axis;
        if (is_sized(plan, lut, a)) {
            if (planned[a].may_end_early && count > 1) range.values = {range.values.front(), last};
            axes[a].values = count > 1 ? range.spaced(count) : std::vector{range.spaced(3)[1]};
        }
        const std::vector<double>& values = axes[a].values;
        if (values.size() != count || values.front() != first || values.back() != last)
            return false;
    }
    plan.axes = std::move(planned);
    lut.axes = std::move(axes);
    lut.facts["notes"] = fitted.notes;
    return true;
}

void fit_axes(LutPlan& plan, Sampler& sample, const LutMaking& making, Lut& lut) {
    Fit(plan, sample, making, lut).run();
}

}  // namespace irido::tables
