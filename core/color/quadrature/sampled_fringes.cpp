#include "core/color/quadrature/sampled_fringes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/coherent/fringe_mean.hpp"
#include "core/coherent/media.hpp"
#include "core/coherent/period.hpp"
#include "core/keep_once.hpp"
#include "core/stack/index_table.hpp"

namespace irido {

namespace {

/// Points at which traces of periods are looked at, and the longest path of a period whose fringes
/// these resolve.
constexpr std::size_t kLooks = 2048;
constexpr double kLongestPeriod_nm = 4e4;

/// A trace that comes as close to 2 as this, but not beyond, is an edge without a gap.
constexpr double kTouches = 1e-3;

constexpr int kBisections = 60;

/// First points of a range: a fringe, and a nm.
constexpr double kPerFringe = 2, kPerNm = 32;
constexpr std::size_t kFewest = 64;

/// Sums of each range, the last of which have an error.
constexpr int kFirstRounds = 3;

/// Random stacks have errors of up to 1.1 times what the last doubling changed.
constexpr double kSampleDoubt = 2;

/// Points computed at once.
constexpr std::size_t kBatch = 4096;

/// Where the error is at most so many tolerances, some more points will do: up to so many times the
/// limit.
constexpr double kNear = 16;
constexpr std::size_t kPointsIfNear = 8;

/// Ranges are refined whose error is above this part of the largest.
constexpr double kRefined = 0.2;

/// Fills one row per spectrum at wavelengths, nm.
using SpectrumRows =
    std::function<void(std::span<const double> wavelength_nm, std::span<std::vector<double>> rows)>;

/// Groups whose Bloch waves have edges, innermost first.
void add_groups(std::span<const Element> elements, const IndexTable& table,
                std::vector<const Group*>& groups, double& path_nm) {
    for (const Element& element : elements) {
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            path_nm += 2 * layer->thickness_nm * table.n(layer->material, 0);
            continue;
        }
        const Group& group = std::get<Group>(element.value);
        double period_nm = 0;
        add_groups(group.elements, table, groups, period_nm);
        if (group.repeat > 1 && group.elements.size() > 1 && period_nm < kLongestPeriod_nm)
            groups.push_back(&group);
        path_nm += static_cast<double>(group.repeat) * period_nm;
    }
}

/// |cos K| - 1 of a group's period, up to a positive factor, at a wavelength.
class Trace {
public:
    Trace(const Stack& stack, IncidentAngle incidence, Polarization polarization)
        : stack_(stack), incidence_(incidence), polarization_(polarization) {}

    double at(const Group& group, double nm) {
        const IndexTable table(stack_, {nm});
        return at(group, table, 0);
    }

    double at(const Group& group, const IndexTable& table, std::size_t wavelength) {
        set_media(table, wavelength, incidence_, polarization_, media_);
        const Matrix m = matrix_of(group.elements, media_, table.k0()[wavelength], polarization_);
        const double one = m.identity();
        return std::abs(((m.a + m.d) / 2.0).real() + one) - one;
    }

private:
    const Stack& stack_;
    IncidentAngle incidence_;
    Polarization polarization_;
    std::vector<Medium> media_;
};

double root_between(Trace& trace, const Group& group, double inside, double outside) {
    for (int i = 0; i < kBisections; ++i) {
        const double middle = (inside + outside) / 2;
        (trace.at(group, middle) > 0 ? inside : outside) = middle;
    }
    return (inside + outside) / 2;
}

/// The place of a largest value between two wavelengths, by golden section.
double largest_between(Trace& trace, const Group& group, double from, double to) {
    constexpr double kGolden = 0.6180339887498949;
    for (int i = 0; i < kBisections; ++i) {
        const double low = to - kGolden * (to - from), high = from + kGolden * (to - from);
        if (trace.at(group, low) < trace.at(group, high))
            from = low;
        else
            to = high;
    }
    return (from + to) / 2;
}

/// A range between two edges. Wavelengths are first + (last - first) x^4 (35 - 84 x + 70 x^2 - 20
/// x^3), with x from 0 to 1.
class Range {
public:
    Range(double first_nm, double last_nm, std::size_t intervals, std::size_t spectra)
        : first_(first_nm),
          last_(last_nm),
          intervals_(intervals),
          sums_(spectra),
          before_(spectra) {}

    std::size_t intervals() const { return intervals_; }
    double error() const { return error_; }
    const Triple& sum(std::size_t spectrum) const { return sums_[spectrum]; }

    /// The first sum, or one with twice the points; returns how many these are.
    std::size_t refine(const Sensitivity& sensitivity, const SpectrumRows& rows,
                       std::span<std::vector<double>> values) {
        const std::size_t step = is_begun_ ? 2 : 1;
        if (is_begun_) {
            intervals_ *= 2;
            before_ = sums_;
            for (Triple& sum : sums_)
                for (double& part : sum) part /= 2;
        }
        std::vector<double> nm, slope;
        std::size_t points = 0;
        const auto add = [&] {
            rows(nm, values);
            for (std::size_t j = 0; j < nm.size(); ++j) {
                const Triple weight = sensitivity.at(nm[j]);
                for (std::size_t k = 0; k < sums_.size(); ++k)
                    for (std::size_t c = 0; c < 3; ++c)
                        sums_[k][c] += weight[c] * slope[j] * values[k][j];
            }
            points += nm.size();
            nm.clear();
            slope.clear();
        };
        const auto n = static_cast<double>(intervals_);
        for (std::size_t i = 1; i < intervals_; i += step) {
            const bool is_upper = 2 * i > intervals_;
            const double x = static_cast<double>(is_upper ? intervals_ - i : i) / n, y = 1 - x;
            const double way =
                (last_ - first_) * x * x * x * x * (35 - x * (84 - x * (70 - 20 * x)));
            nm.push_back(is_upper ? last_ - way : first_ + way);
            slope.push_back((last_ - first_) * 140 * x * x * x * y * y * y / n);
            if (nm.size() == kBatch) add();
        }
        if (!nm.empty()) add();
        estimate();
        is_begun_ = true;
        return points;
    }

private:
    void estimate() {
        double change = 0;
        for (std::size_t k = 0; k < sums_.size(); ++k)
            for (std::size_t c = 0; c < 3; ++c)
                change = std::max(change, std::abs(sums_[k][c] - before_[k][c]));
        error_ = kSampleDoubt * std::max(change, change_ / 4);
        change_ = change;
    }

    double first_, last_;
    std::size_t intervals_;
    std::vector<Triple> sums_, before_;
    double change_ = 0, error_ = 0;
    bool is_begun_ = false;
};

/// Wavelengths, nm, ascending, at which the Bloch waves of groups begin or cease to travel, the
/// ends of the range first and last. Groups inside of groups count, periods with very many fringes
/// do not.
std::vector<double> band_edges(const SampledStack& of, Polarization polarization,
                               WavelengthRange range) {
    std::vector<double> looks(kLooks);
    const double from = 1 / range.first_nm, to = 1 / range.last_nm;
    for (std::size_t i = 0; i < kLooks; ++i)
        looks[i] = std::clamp(1 / (from + (to - from) * static_cast<double>(i) / (kLooks - 1)),
                              range.first_nm, range.last_nm);
    const IndexTable table(of.materials, looks);
    std::vector<const Group*> groups;
    double path_nm = 0;
    add_groups(of.stack.elements, table, groups, path_nm);
    std::vector<double> edges{range.first_nm, range.last_nm};
    Trace trace(of.materials, of.incidence, polarization);
    std::vector<double> at(kLooks);
    for (const Group* group : groups) {
        for (std::size_t i = 0; i < kLooks; ++i) at[i] = trace.at(*group, table, i);
        for (std::size_t i = 1; i < kLooks; ++i) {
            if ((at[i] > 0) != (at[i - 1] > 0)) {
                const std::size_t inside = at[i] > 0 ? i : i - 1, outside = 2 * i - 1 - inside;
                edges.push_back(root_between(trace, *group, looks[inside], looks[outside]));
            }
            const bool is_top =
                i + 1 < kLooks && at[i] <= 0 && at[i] >= at[i - 1] && at[i] > at[i + 1];
            if (!is_top) continue;
            const double top = largest_between(trace, *group, looks[i - 1], looks[i + 1]);
            const double most = trace.at(*group, top);
            if (most > 0) {
                edges.push_back(root_between(trace, *group, top, looks[i - 1]));
                edges.push_back(root_between(trace, *group, top, looks[i + 1]));
            } else if (most > -kTouches) {
                edges.push_back(top);
            }
        }
    }
    keep_once(edges);
    return edges;
}

/// The sums of one polarization.
void sample(const Sensitivity& sensitivity, std::span<const double> ends, const SpectrumRows& rows,
            const SampleLimits& limits, std::span<SampledSum> sums) {
    std::vector<Range> ranges;
    std::size_t evaluations = 0;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const double fringes = limits.path_nm * (1 / ends[i] - 1 / ends[i + 1]);
        const double first = kPerFringe * fringes + kPerNm * (ends[i + 1] - ends[i]);
        ranges.emplace_back(ends[i], ends[i + 1],
                            std::max(kFewest, static_cast<std::size_t>(std::ceil(first))),
                            sums.size());
    }
    std::vector<std::vector<double>> values(sums.size());
    for (int round = 0; round < kFirstRounds; ++round)
        for (Range& range : ranges) evaluations += range.refine(sensitivity, rows, values);
    const auto total = [&] {
        double error = 0;
        for (const Range& range : ranges) error += range.error();
        return error;
    };
    for (double error = total(); error > limits.tolerance; error = total()) {
        const bool is_near = error <= kNear * limits.tolerance;
        const std::size_t most = limits.evaluations * (is_near ? kPointsIfNear : 1);
        const double largest = std::ranges::max_element(ranges, {}, &Range::error)->error();
        bool is_refined = false;
        for (Range& range : ranges) {
            if (range.error() < kRefined * largest) continue;
            if (evaluations + range.intervals() > most) continue;
            evaluations += range.refine(sensitivity, rows, values);
            is_refined = true;
        }
        if (!is_refined) break;
    }
    for (std::size_t k = 0; k < sums.size(); ++k) {
        sums[k].error += total();
        sums[k].evaluations += evaluations;
        for (const Range& range : ranges)
            for (std::size_t c = 0; c < 3; ++c) sums[k].xyz[c] += range.sum(k)[c];
    }
}

}  // namespace

std::vector<SampledSum> sampled_fringes(const Sensitivity& sensitivity, const SampledStack& of,
                                        std::span<const Side> sides, const SampleLimits& limits) {
    std::vector<SampledSum> sums(sides.size());
    std::vector<Medium> media;
    for (const Polarization polarization : of.polarizations) {
        const SpectrumRows rows = [&](std::span<const double> nm,
                                      std::span<std::vector<double>> values) {
            const IndexTable indices(of.materials, {nm.begin(), nm.end()});
            for (std::vector<double>& row : values) row.resize(nm.size());
            for (std::size_t j = 0; j < nm.size(); ++j) {
                set_media(indices, j, of.incidence, polarization, media);
                const FringeMean mean =
                    fringe_mean(of.stack, of.fast, media, indices.k0()[j], polarization);
                for (std::size_t k = 0; k < sides.size(); ++k)
                    values[k][j] = sides[k] == Side::reflected ? mean.R : mean.T;
            }
        };
        sample(sensitivity, band_edges(of, polarization, sensitivity.support()), rows, limits,
               sums);
    }
    const auto count = static_cast<double>(of.polarizations.size());
    for (SampledSum& sum : sums) {
        sum.error /= count;
        for (double& value : sum.xyz) value /= count;
        if (!std::isfinite(sum.xyz[0] + sum.xyz[1] + sum.xyz[2]))
            sum.error = std::numeric_limits<double>::infinity();
    }
    return sums;
}

}  // namespace irido
