#include "core/color/quadrature/integration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/color/quadrature/hidden_lines.hpp"
#include "core/color/quadrature/panel_sums.hpp"
#include "core/color/quadrature/resampling.hpp"
#include "core/complex.hpp"
#include "core/error.hpp"
#include "core/math/square.hpp"
#include "core/math/transform.hpp"

namespace irido {

namespace {

/// Panels are not cut below this share of their wavelength.
constexpr double kNarrowest = 1e-7;

/// A panel is halved where twice the degree promises more than this times the error allowed.
constexpr double kHopeful = 10;

/// Part of the error allowed that may be lost to a panel's fitted indices, and to its interpolated
/// denominators.
constexpr double kMostLost = 0.6, kMostUnseen = 0.1;

/// Degree, as an index, at which panels of known denominators begin: their points cost little.
constexpr std::size_t kKnownDegree = 4;

/// Errors of random stacks are up to 1.8 times what coefficients tell.
constexpr double kSafetyOfTail = 2;

/// Where the points are dense for a denominator, differences of neighbours are its slope.
constexpr double kDense = 3.2;

/// The last coefficients of a line that hides between points show its foot on them, which is at
/// most degree times kFoot times the largest of these: 2/degree of what a single point has, and
/// less where the feet on both sides cancel.
constexpr double kFoot = 2;

/// Size of the last coefficients among a rule's sums.
double last_coefficient(const QuadratureRule& rule, std::span<const double> sums) {
    double largest = 0;
    for (const double value : sums.subspan(3 + rule.middle, rule.tail))
        largest = std::max(largest, std::abs(value));
    return largest;
}

class Integration {
public:
    Integration(const Sensitivity& sensitivity, std::size_t denominators, const SampleAt& sample,
                const IntegrationLimits& limits, IntegrationMemory& memory,
                std::span<ColorIntegral> integrals)
        : sensitivity_(sensitivity),
          sample_(sample),
          limits_(limits),
          denominators_(denominators),
          integrals_(integrals),
          memory_(memory),
          reference_(memory.reference),
          errors_(memory.errors),
          next_(memory.next),
          spare_(memory.spare) {
        reference_.resize(integrals.size());
        memory.panel_errors.resize(integrals.size());
        errors_.assign(integrals.size(), {});
        next_.clear();
    }

    void over(const PanelTree::Start& start) {
        Samples samples = room();
        const SpectralPoints* points = &start.points;
        sample({&points, 1}, samples);
        for (std::size_t k = 0; k < integrals_.size(); ++k) {
            reference_[k] = *samples.row(k);
            for (std::size_t c = 0; c < 3; ++c)
                integrals_[k].xyz[c] = reference_[k] * sensitivity_.white()[c];
        }
        const double share = 1 / static_cast<double>(start.panels.size());
        for (const PanelTree::Start::Panel& panel : start.panels) {
            Job job{panel.node, panel.sampled, panel.half_turn, share};
            if (panel.sampled < panel.degree && knows_denominators(job, samples, panel.first)) {
                job.degree = std::max(panel.degree, kKnownDegree);
                follow(std::move(job));
            } else {
                settle_or_refine(std::move(job), samples, panel.first);
            }
        }
        while (!next_.empty()) {
            std::swap(memory_.now, next_);
            next_.clear();
            work_on(memory_.now, samples);
        }
        leave(std::move(samples));
        for (std::size_t k = 0; k < integrals_.size(); ++k) {
            integrals_[k].error = *std::ranges::max_element(errors_[k]);
            integrals_[k].evaluations = evaluations_;
        }
    }

private:
    using Job = IntegrationMemory::Job;
    enum class Outcome { settled, twice_the_degree, halves };

    /// Memory that is used again.
    Samples room() {
        if (spare_.empty()) return {};
        Samples samples = std::move(spare_.back());
        spare_.pop_back();
        return samples;
    }
    void leave(Samples samples) { spare_.push_back(std::move(samples)); }

    void sample(std::span<const SpectralPoints* const> parts, Samples& samples) {
        std::size_t count = 0;
        for (const SpectralPoints* part : parts) count += part->wavelength_nm.size();
        samples.resize(integrals_.size(), denominators_, count);
        sample_(parts, samples);
        evaluations_ += count;
    }

    /// All panels that are left, computed together.
    void work_on(std::vector<Job>& jobs, Samples& samples) {
        std::vector<const SpectralPoints*>& parts = memory_.parts;
        parts.clear();
        for (const Job& job : jobs)
            parts.push_back(job.coarse ? &job.node->added_points(job.degree)
                                       : &job.node->all_points(job.degree));
        sample(parts, samples);
        std::size_t first = 0;
        for (std::size_t i = 0; i < jobs.size(); ++i) {
            Job& job = jobs[i];
            const std::size_t count = parts[i]->wavelength_nm.size();
            if (job.coarse) {
                Samples merged = room();
                merge(*job.coarse, samples, first, count, merged);
                leave(std::move(*job.coarse));
                settle_or_refine({job.node, job.degree, job.half_turn, job.share}, merged, 0);
                leave(std::move(merged));
            } else {
                settle_or_refine({job.node, job.degree, job.half_turn, job.share}, samples, first);
            }
            first += count;
        }
    }

    /// The panel's samples begin at the point `first`.
    void settle_or_refine(Job job, const Samples& samples, std::size_t first) {
        Outcome outcome = settle(job, samples, first);
        if (outcome == Outcome::settled && job.known) leave(std::move(*job.known));
        if (outcome != Outcome::settled && knows_denominators(job, samples, first))
            return refine_known(std::move(job), outcome);
        // twice the degree may be what the denominators need, and finer points of these cost little
        if (outcome == Outcome::halves && follows() && job.degree < kKnownDegree)
            outcome = Outcome::twice_the_degree;
        switch (outcome) {
            case Outcome::settled:
                return;
            case Outcome::twice_the_degree: {
                const std::size_t points = kDegrees[job.degree] + 1;
                job.coarse = room();
                job.coarse->resize(integrals_.size(), denominators_, points);
                for (std::size_t row = 0; row < samples.rows(); ++row)
                    std::copy_n(samples.row(row) + first, points, job.coarse->row(row));
                ++job.degree;
                next_.push_back(std::move(job));
                return;
            }
            case Outcome::halves:
                for (std::size_t half = 0; half < 2; ++half) {
                    PanelTree::Node& node = job.node->half(half);
                    next_.push_back({&node, node.seeing(std::max<std::size_t>(job.degree, 1) - 1),
                                     job.node->half_turn(half, job.half_turn), job.share / 2});
                }
        }
    }

    /// Whether spectra follow from denominators.
    bool follows() const { return limits_.transmission && limits_.transmission->holds; }

    /// Whether the denominators of a panel are known between its samples, which begin at the point
    /// `first`, as well as the error allowed needs; keeps them in the job then.
    bool knows_denominators(Job& job, const Samples& samples, std::size_t first) {
        if (job.known) return true;
        if (!follows()) return false;
        const Transmission* const through = limits_.transmission;
        const QuadratureRule& rule = job.rule();
        double unseen = 0;
        for (std::size_t d = 0; d < denominators_; ++d) {
            // T <= 1 has |D|^2 >= flux, so that |dT| = 2 flux |dD| / |D|^3 <= 2 |dD| / sqrt(flux)
            const std::size_t row = integrals_.size() + 3 * d;
            const double off = std::sqrt(square(last_two(rule, samples.row(row) + first)) +
                                         square(last_two(rule, samples.row(row + 1) + first)));
            unseen += 2 * off / std::sqrt(through->flux[d]) / static_cast<double>(denominators_);
        }
        const Triple allowed = budget(rule, job.share);
        for (std::size_t c = 0; c < 3; ++c)
            if (!(unseen * rule.light[c] * sensitivity_.white()[c] <= kMostUnseen * allowed[c]))
                return false;
        job.unseen = unseen;
        job.known_degree = job.degree;
        job.known = room();
        job.known->resize(0, denominators_, rule.points);
        for (std::size_t d = 0; d < denominators_; ++d)
            for (std::size_t part = 0; part < 2; ++part)
                std::copy_n(samples.row(integrals_.size() + 3 * d + part) + first, rule.points,
                            job.known->row(3 * d + part));
        return true;
    }

    /// The larger of the last two coefficients: those of a denominator fall faster and faster.
    double last_two(const QuadratureRule& rule, const double* values) const {
        std::array<double, 2> last{};
        row_sums(rule.coefficients.data() + (rule.middle + rule.tail - 2) * rule.stride, 2,
                 rule.stride, values, 0, last.data(), limits_.simd);
        return std::max(std::abs(last[0]), std::abs(last[1]));
    }

    /// Settles or refines a panel of known denominators at the points of its degree.
    void follow(Job job) {
        Samples samples = room();
        fill_known(job, samples);
        settle_or_refine(std::move(job), samples, 0);
        leave(std::move(samples));
    }

    /// Samples that follow from a panel's denominators.
    void fill_known(const Job& job, Samples& samples) {
        const std::size_t points = kDegrees[job.degree] + 1;
        samples.resize(integrals_.size(), denominators_, points);
        followed_ += points;
        Powers powers{1 / static_cast<double>(denominators_)};
        for (std::size_t k = 0; k < integrals_.size(); ++k)
            (limits_.transmission->sides[k] == Side::reflected ? powers.R : powers.T) =
                samples.row(k);
        resample(resampling(job.known_degree, job.degree), *job.known, samples, integrals_.size(),
                 powers);
    }

    /// Both parts of every denominator at other points.
    ///   from    denominators only
    ///   to      with `spectra` rows before the denominators
    ///   powers  that follow
    void resample(const Resampling& by, const Samples& from, Samples& to, std::size_t spectra,
                  const Powers& powers) const {
        std::array<const double*, 4> in{};
        std::array<double*, 4> out{};
        for (std::size_t d = 0; d < denominators_; ++d) {
            for (std::size_t part = 0; part < 2; ++part) {
                in[2 * d + part] = from.row(3 * d + part);
                out[2 * d + part] = to.row(spectra + 3 * d + part);
            }
            std::fill_n(to.row(spectra + 3 * d + 2), to.points(), 0.0);
        }
        resampled_denominators(by.columns.data(), by.inputs, by.stride, denominators_, in.data(),
                               out.data(), limits_.transmission->flux.data(), powers, limits_.simd);
    }

    void refine_known(Job job, Outcome outcome) {
        if (outcome == Outcome::twice_the_degree || job.degree < kKnownDegree) {
            job.degree = std::max(job.degree + 1, kKnownDegree);
            return follow(std::move(job));
        }
        for (std::size_t half = 0; half < 2; ++half) {
            PanelTree::Node& node = job.node->half(half);
            Job part{&node, job.degree - 1, job.node->half_turn(half, job.half_turn),
                     job.share / 2};
            part.known_degree = job.known_degree;
            part.unseen = job.unseen;
            part.known = room();
            part.known->resize(0, denominators_, kDegrees[job.known_degree] + 1);
            resample(resampling_of_half(job.known_degree, half), *job.known, *part.known, 0, {});
            follow(std::move(part));
        }
        leave(std::move(*job.known));
    }

    /// Every second point from each.
    void merge(const Samples& coarse, const Samples& fresh, std::size_t first, std::size_t count,
               Samples& merged) const {
        merged.resize(integrals_.size(), denominators_, coarse.points() + count);
        for (std::size_t row = 0; row < merged.rows(); ++row) {
            const double *even = coarse.row(row), *odd = fresh.row(row) + first;
            double* all = merged.row(row);
            for (std::size_t j = 0; j < count; ++j) {
                all[2 * j] = even[j];
                all[2 * j + 1] = odd[j];
            }
            all[2 * count] = even[count];
        }
    }

    static bool is_narrow(WavelengthRange range) {
        return range.last_nm - range.first_nm < kNarrowest * range.first_nm;
    }

    /// Half of the tolerance is shared out by the light in a panel, half by its rank.
    Triple budget(const QuadratureRule& rule, double share) const {
        Triple result{};
        for (std::size_t c = 0; c < 3; ++c)
            result[c] = limits_.tolerance / 2 * (rule.light[c] + share);
        return result;
    }

    /// Adds the panel's integrals if they meet its budget or it must end here.
    Outcome settle(const Job& job, const Samples& samples, std::size_t first) {
        const QuadratureRule& rule = job.rule();
        const Triple allowed = budget(rule, job.share);
        const bool last_degree = job.degree + 1 == kDegrees.size();
        const bool narrow = is_narrow(job.node->range());
        const bool must_end =
            evaluations_ + followed_ >= limits_.evaluations || (last_degree && narrow);
        const double root_rate = root_rate_of(job);
        const bool has_root = root_rate < kFallRates[0];
        std::size_t most_rate = kFallRates.size() - 1;
        while (most_rate > 0 && kFallRates[most_rate] > root_rate) --most_rate;
        Poles poles = poles_of(job, samples, first);
        poles.rate = std::min(poles.rate, most_rate);
        Triple lost = lost_by_fit(job, poles, has_root);
        for (std::size_t c = 0; c < 3; ++c)
            lost[c] += job.unseen * rule.light[c] * sensitivity_.white()[c];
        if (!must_end && !is_below(lost, scaled(allowed, kMostLost))) return Outcome::halves;
        const std::size_t width = rule.sum_count();
        memory_.sums.resize(integrals_.size() * width);
        std::vector<Triple>& panel_errors = memory_.panel_errors;
        for (std::size_t k = 0; k < integrals_.size(); ++k) {
            double* sums = memory_.sums.data() + k * width;
            rule.sum(samples.row(k) + first, reference_[k], sums, limits_.simd);
            panel_errors[k] = has_root ? rule.error_with_root({sums, width})
                                       : rule.error({sums, width}, poles.rate, most_rate);
            if (job.known || !has_root) panel_errors[k] = scaled(panel_errors[k], kSafetyOfTail);
            for (std::size_t c = 0; c < 3; ++c) panel_errors[k][c] += lost[c];
            if (must_end || is_below(panel_errors[k], allowed)) continue;
            const bool halves =
                last_degree ||
                (!narrow && !doubling_helps(rule, {sums, width}, panel_errors[k], allowed));
            return halves ? Outcome::halves : Outcome::twice_the_degree;
        }
        if (!poles.all_far && denominators_ > 0) {
            mark_points(job, samples, first);
            const bool resolved = static_cast<double>(kDegrees[job.degree]) >= job.half_turn;
            for (std::size_t k = 0; k < integrals_.size(); ++k) {
                const double foot =
                    kFoot * static_cast<double>(kDegrees[job.degree]) *
                    last_coefficient(rule, {memory_.sums.data() + k * width, width});
                const Triple hidden =
                    hidden_weight(rule, samples.row(k) + first, resolved ? foot : 1);
                for (std::size_t c = 0; c < 3; ++c) panel_errors[k][c] += hidden[c];
                if (!must_end && !is_below(panel_errors[k], allowed))
                    return last_degree ? Outcome::halves : Outcome::twice_the_degree;
            }
        }
        for (std::size_t k = 0; k < integrals_.size(); ++k) {
            for (std::size_t c = 0; c < 3; ++c) {
                integrals_[k].xyz[c] += memory_.sums[k * width + c];
                errors_[k][c] += panel_errors[k][c];
            }
        }
        return Outcome::settled;
    }

    static Triple scaled(const Triple& values, double factor) {
        return {factor * values[0], factor * values[1], factor * values[2]};
    }

    static bool is_below(const Triple& error, const Triple& allowed) {
        return error[0] <= allowed[0] && error[1] <= allowed[1] && error[2] <= allowed[2];
    }

    /// Whether twice the degree promises an error that is allowed.
    static bool doubling_helps(const QuadratureRule& rule, std::span<const double> sums,
                               const Triple& error, const Triple& allowed) {
        if (rule.middle == 0) return true;
        // coefficients fall as much again in the next half of the degree, and in the one after it
        const double fall = square(rule.fall_seen(sums));
        for (std::size_t c = 0; c < 3; ++c)
            if (error[c] > kHopeful * fall * allowed[c]) return false;
        return true;
    }

    /// Rate, like kFallRates, at which branch points let coefficients fall.
    double root_rate_of(const Job& job) const {
        return fall_rate(limits_.branch_points, job.node->range()) *
               static_cast<double>(kDegrees[job.degree]);
    }

    struct Poles {
        bool all_far;      ///< none is closer to a point than the next one, for certain
        std::size_t rate;  ///< at which coefficients fall, an index into kFallRates
        double slope;      ///< largest |D'|/|D| seen, in x
    };
    /// What differences of the denominators say at once.
    Poles poles_of(const Job& job, const Samples& samples, std::size_t first) const {
        const QuadratureRule& rule = job.rule();
        const auto degree = static_cast<double>(kDegrees[job.degree]);
        const bool is_dense = degree >= kDense * job.half_turn;
        if (denominators_ == 0 || (!is_dense && !job.node->fit())) return {false, 0, 0};
        double largest = 0;
        for (std::size_t d = 0; d < denominators_; ++d) {
            const std::size_t row = integrals_.size() + 3 * d;
            largest = std::max(largest,
                               steepness(samples.row(row) + first, samples.row(row + 1) + first,
                                         samples.row(row + 2) + first, rule.inverse_spacing.data(),
                                         rule.stride, limits_.simd));
        }
        if (!is_dense || !(largest < degree / std::numbers::pi))
            return {false, 0, std::max(largest, job.half_turn)};
        std::size_t rate = 0;
        while (limits_.has_all_poles && rate + 1 < kFallRates.size() &&
               largest <= rule.steepest[rate + 1])
            ++rate;
        return {true, rate, largest};
    }

    /// What the fit of the panel's indices takes from X, Y, Z at most: not known where these pass a
    /// square root.
    Triple lost_by_fit(const Job& job, const Poles& poles, bool has_root) const {
        Triple lost{};
        const IndexFit* fit = job.node->fit();
        if (!fit || limits_.index_effects.empty()) return lost;
        if (has_root || job.degree >= IndexFit::kLevels) {
            lost.fill(std::numeric_limits<double>::infinity());
            return lost;
        }
        const WavelengthRange range = job.node->range();
        const double per_log = 2 / (1 - range.first_nm / range.last_nm);  // dx / d ln lambda
        Triple root{};
        for (const IndexFit::Error& error : fit->errors(job.degree, poles.rate)) {
            const double kz_effect =
                std::max(limits_.index_effects[error.material],
                         effect_of_branch(limits_.branch_points, error.material, range));
            const double effect = index_effect(kz_effect, poles.slope * per_log);
            for (std::size_t c = 0; c < 3; ++c) {
                lost[c] += effect * error.first[c];
                root[c] += effect * std::sqrt(error.second[c]);
            }
        }
        for (std::size_t c = 0; c < 3; ++c) lost[c] += root[c] * root[c];
        return lost;
    }

    /// Marks the points that have a zero of a denominator next to them.
    void mark_points(const Job& job, const Samples& samples, std::size_t first) const {
        const QuadratureRule& rule = job.rule();
        std::vector<bool>& marked = memory_.marked;
        marked.assign(rule.points, false);
        if (job.known && job.known_degree < job.degree)
            return mark_known_points(job, samples, first);
        for (std::size_t d = 0; d < denominators_; ++d) {
            const auto row = [&](std::size_t r) {
                return std::span(samples.row(integrals_.size() + 3 * d + r) + first, rule.points);
            };
            mark_hidden_zeros(rule, slope_rows(job.degree), {row(0), row(1), row(2)}, limits_.simd,
                              memory_.zeros, marked);
        }
    }

    /// The same by slopes of denominators on the points at which they are known.
    void mark_known_points(const Job& job, const Samples& samples, std::size_t first) const {
        const std::size_t inputs = kDegrees[job.known_degree] + 1;
        std::array<const double*, 4> from{};
        std::array<double*, 4> to{};
        for (std::size_t i = 0; i < 2 * denominators_; ++i) {
            std::vector<double>& slope = memory_.known_slopes[i];
            slope.resize(inputs);
            const double* const values = job.known->row(i / 2 * 3 + i % 2);
            row_sums(slope_rows(job.known_degree).data(), inputs, whole_vectors(inputs), values,
                     *values, slope.data(), limits_.simd);
            memory_.slopes[i].resize(job.rule().stride);
            from[i] = slope.data();
            to[i] = memory_.slopes[i].data();
        }
        const Resampling& by = resampling(job.known_degree, job.degree);
        resampled_denominators(by.columns.data(), by.inputs, by.stride, denominators_, from.data(),
                               to.data(), limits_.transmission->flux.data(), {}, limits_.simd);
        const auto row = [&](std::size_t r) { return samples.row(integrals_.size() + r) + first; };
        for (std::size_t d = 0; d < denominators_; ++d)
            mark_hidden_zeros(job.rule(), {row(3 * d), row(3 * d + 1)}, {to[2 * d], to[2 * d + 1]},
                              memory_.marked);
    }

    /// Weight that lines next to marked points can hide in one spectrum.
    Triple hidden_weight(const QuadratureRule& rule, const double* values, double foot) const {
        Triple weight{};
        for (std::size_t j = 0; j < rule.points; ++j) {
            if (!memory_.marked[j]) continue;
            const double share = hidden_share(foot, values[j]);
            for (std::size_t c = 0; c < 3; ++c)
                weight[c] += share * std::abs(rule.weights[c * rule.stride + j]);
        }
        return weight;
    }

    const Sensitivity& sensitivity_;
    const SampleAt& sample_;
    IntegrationLimits limits_;
    std::size_t denominators_;
    std::span<ColorIntegral> integrals_;
    IntegrationMemory& memory_;
    std::vector<double>& reference_;  ///< each spectrum at the short end
    std::vector<Triple>& errors_;     ///< of each channel
    std::vector<Job>& next_;          ///< panels that are not settled
    std::vector<Samples>& spare_;
    std::size_t evaluations_ = 0;
    std::size_t followed_ = 0;  ///< points that followed from denominators
};

}  // namespace

void Samples::resize(std::size_t spectra, std::size_t denominators, std::size_t points) {
    rows_ = spectra + 3 * denominators;
    points_ = points;
    stride_ = (points + 2 * kMostLanes) / kMostLanes * kMostLanes;
    numbers_.resize(std::max(numbers_.size(), rows_ * stride_));
    for (std::size_t row = 0; row < rows_; ++row)
        std::fill_n(numbers_.begin() + static_cast<std::ptrdiff_t>(row * stride_ + points),
                    stride_ - points, 0.0);
}

void integrate_color(const Sensitivity& sensitivity, const PanelTree::Start& start,
                     std::size_t denominators, const SampleAt& sample,
                     const IntegrationLimits& limits, IntegrationMemory& memory,
                     std::span<ColorIntegral> integrals) {
    require_in_range("tolerance", limits.tolerance, 1e-12, 1);
    Integration(sensitivity, denominators, sample, limits, memory, integrals).over(start);
}

}  // namespace irido
