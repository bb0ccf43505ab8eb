#include "core/color/bloch/bloch_color.hpp"

#include <algorithm>
#include <cmath>

#include "core/color/bloch/bloch_sums.hpp"
#include "core/color/bloch/one_mirror.hpp"
#include "core/color/fourier/film_parts.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/pool.hpp"

namespace irido {

namespace {

/// Radians that the fastest harmonic that counts as resolved turns from one point of a band to the
/// next, in its middle.
constexpr double kLargestStep = 0.7 * kPi;

/// Harmonics that are resolved where T is: at least so many, and so many times what makes the
/// narrowest fringe, next to a gap, where T is lowest.
constexpr double kFewest = 7;
constexpr double kPerWidth = 2;

/// Of bounds that look at a few points of a band.
constexpr double kSafety = 1.2;

/// A doubling of points divides the error at least by kFall, and two of them by kFallOfTwo.
constexpr double kFall = 2;
constexpr double kFallOfTwo = 32;

/// Fewest points of a range.
constexpr std::size_t kFewestPoints = 16;

/// Gaps with a transmittance below this share of the tolerance are taken as opaque.
constexpr double kOpaque = 0.02;

/// Largest error from rounding.
constexpr double kRounding = 1e-12;

/// The series at one point of a band.
struct Sample {
    double average, bounce;  ///< the latter's size
    double opd_nm;           ///< of the first harmonic: its phase turns by 2 pi opd_nm d nu
};

/// A band or a gap of one mirror, with what its fringes are like.
struct Range {
    BlochRange omega;
    double phase = 0;   ///< N KL turns by so much over a band, radians
    double enough = 0;  ///< who resolves so many harmonics resolves T
    std::array<Sample, 7> samples{};
};

/// KL in [0, pi].
double bloch_phase(const BlochMirror& mirror, double omega) {
    const BlochPoint at = bloch_point(mirror, omega);
    return 2 * std::atan2(std::sqrt(std::max(0.0, at.sin2)), std::sqrt(std::max(0.0, at.cos2)));
}

Sample sample(const BlochMirror& mirror, double omega) {
    const BlochSeries series = bloch_series(mirror, omega);
    const double turn = std::abs(bloch_phase_slope(mirror.period, omega));
    return {series.average, std::abs(series.bounce), 2 * static_cast<double>(mirror.repeat) * turn};
}

/// What the harmonics of a band may add that are left out: those from the number `terms` on (0:
/// none) and those of a path that is longer than flat_nm, which the smooth sensitivity does not
/// have. As large as each is at some place of the band, against all that the sensitivity has of its
/// fringes.
double hidden_by(const Range& band, std::uint64_t terms, double flat_nm,
                 const SensitivityDecay& decay) {
    double largest = 0;
    for (const Sample& at : band.samples) {
        double m = std::floor(flat_nm / at.opd_nm) + 1;
        if (terms > 0) m = std::min(m, static_cast<double>(terms));
        // the next ones fall by the bounce, and as 1/m^2 at least
        const double those_after = std::min(1 / (1 - std::min(at.bounce, 0.999)), m);
        largest = std::max(
            largest, 2 * at.average * std::pow(at.bounce, m) * decay(m * at.opd_nm) * those_after);
    }
    return kSafety * largest;
}

void add_band(const BlochMirror& mirror, double low, double high, std::vector<Range>& ranges) {
    if (!(low < high)) return;
    Range band{{low, high}};
    band.phase = static_cast<double>(mirror.repeat) *
                 std::abs(bloch_phase(mirror, high) - bloch_phase(mirror, low));
    for (std::size_t i = 0; i < band.samples.size(); ++i) {
        const double psi =
            kPi * (static_cast<double>(i) + 0.5) / static_cast<double>(band.samples.size());
        band.samples[i] = sample(mirror, (low + high) / 2 + (high - low) / 2 * std::cos(psi));
    }
    const double darkest = std::min(bloch_transmittance(mirror, low + 1e-9 * (high - low)),
                                    bloch_transmittance(mirror, high - 1e-9 * (high - low)));
    band.enough = std::max(kFewest, kPerWidth / std::sqrt(darkest));
    ranges.push_back(band);
}

/// The bands and gaps that cover `reach`, ascending.
void find_ranges(const BlochMirror& mirror, const OmegaRange& reach, std::vector<Range>& ranges) {
    ranges.clear();
    const double path = mirror.period.path1_nm + mirror.period.path2_nm;
    const double first = std::floor(reach.low_per_nm * path / kPi);
    if ((reach.high_per_nm - reach.low_per_nm) * path / kPi > kMostGaps)
        throw DomainError("gaps in the visible range must be at most " + to_text(kMostGaps) +
                          " for Bloch waves");
    double at = reach.low_per_nm;
    for (double order = std::max(1.0, first); at < reach.high_per_nm; ++order) {
        const BandGap gap = band_gap(mirror.period, order, Roots::quick);
        const double low = std::clamp(gap.low_per_nm, at, reach.high_per_nm);
        const double high = std::clamp(gap.high_per_nm, low, reach.high_per_nm);
        add_band(mirror, at, low, ranges);
        if (low < high) ranges.push_back({{low, high, true, std::fmod(order, 2) != 0}});
        at = high;
    }
}

/// Integrals over all ranges at one level.
struct LevelSum {
    Triple T{};
    double error = 0;  ///< bound of what is left out
    std::size_t points = 0;
    bool has_harmonics = true;  ///< all that were asked for
};

class BlochColor : public ColorAlgorithm {
public:
    BlochColor(const ColorTables& tables, const ColorMethod& method, const ColorRequest& request)
        : tables_(tables), terms_(method.count), request_(request) {}

    void operator()(const Stack& stack, std::span<const double> angles_deg,
                    std::span<StackColor> colors) const override {
        const OneMirror mirror = one_mirror("bloch", stack);
        const std::size_t sides = request_.sides.size();
        const Pool<Scratch>::Loan scratch = scratch_.borrow();
        for (std::size_t i = 0; i < angles_deg.size(); ++i)
            compute(mirror, cos_of_incidence(angles_deg[i]), colors.subspan(i * sides, sides),
                    *scratch);
    }

private:
    struct Scratch {
        std::vector<Range> ranges;
        BlochMemory memory;
    };

    void compute(const OneMirror& one, double cos_theta, std::span<StackColor> colors,
                 Scratch& scratch) const {
        const std::array share = weights(request_.light, cos_theta);
        Triple T{};
        double error = terms_ > 0 ? kInfinity : kRounding;
        std::size_t points = 0;
        for (std::size_t k = 0; k < 2; ++k) {
            if (share[k] == 0 || cos_theta == 0) continue;
            const BlochMirror mirror =
                bloch_mirror(one.first, one.second, one.repeat, one.n_in, one.n_out, cos_theta,
                             k == 0 ? Polarization::s : Polarization::p);
            const LevelSum sum = integrate(mirror, scratch);
            for (std::size_t c = 0; c < 3; ++c) T[c] += share[k] * sum.T[c];
            error += share[k] * sum.error;
            points += sum.points;
        }
        const Triple& white = tables_.sensitivity().white();
        for (std::size_t c = 0; c < 3; ++c) T[c] = std::clamp(T[c], 0.0, white[c]);
        Lighting{white, request_.sides, "bloch", points}.store(T, error, colors);
    }

    /// Doubles the points until the error is below the tolerance: the last change, and that before
    /// it, since one may be small by chance.
    LevelSum integrate(const BlochMirror& mirror, Scratch& scratch) const {
        const SmoothSensitivity::Reach nu = tables_.smooth(0).reach();
        find_ranges(mirror, {2 * kPi * nu.low, 2 * kPi * nu.high}, scratch.ranges);
        LevelSum before = level_sum(mirror, 0, scratch);
        std::size_t points = before.points;
        double change_before = terms_ > 0 ? 0 : 1;
        for (std::size_t level = 1;; ++level) {
            LevelSum now = level_sum(mirror, level, scratch);
            points += now.points;
            const double change = largest_difference(now.T, before.T);
            now.error += std::max(change / kFall, change_before / kFallOfTwo);
            const bool is_good = now.error <= request_.tolerance && now.has_harmonics;
            if (is_good || level + 1 == ColorTables::kSmoothLevels ||
                points + 2 * now.points > request_.evaluations) {
                now.points = points;
                return now;
            }
            before = now;
            change_before = change;
        }
    }

    LevelSum level_sum(const BlochMirror& mirror, std::size_t level, Scratch& scratch) const {
        const SmoothSensitivity& sensitivity = tables_.smooth(level);
        LevelSum sum;
        double in_gaps = 0, hidden = 0, edges = 0;
        for (const Range& range : scratch.ranges) {
            const auto& [low, high, is_gap, is_odd] = range.omega;
            if (is_gap && is_opaque(mirror, range.omega, sum)) continue;
            const CosineNodes& nodes = tables_.nodes(std::max(
                kFewestPoints, static_cast<std::size_t>(sensitivity.opd_nm() * (high - low) / 2)));
            std::uint64_t terms = 0;
            if (!is_gap) terms = terms_of(range, nodes.n, sum.has_harmonics);
            const Triple part = bloch_sum(mirror, range.omega, terms, nodes, sensitivity,
                                          scratch.memory, request_.simd);
            for (std::size_t c = 0; c < 3; ++c) sum.T[c] += part[c];
            sum.points += nodes.n + 1;
            if (is_gap) {
                in_gaps += *std::ranges::max_element(part);
            } else if (terms_ == 0) {
                hidden = std::max(
                    hidden, hidden_by(range, terms, SmoothSensitivity::kFlat * sensitivity.opd_nm(),
                                      tables_.decay()));
                const auto m = static_cast<double>(terms);
                if (terms > 0) edges = std::max(edges, 2 / (m * m));
            }
        }
        sum.error += hidden + edges * in_gaps;
        return sum;
    }

    /// Adds an error if it is.
    bool is_opaque(const BlochMirror& mirror, const BlochRange& gap, LevelSum& sum) const {
        const double T =
            std::max(bloch_transmittance(mirror, gap.low), bloch_transmittance(mirror, gap.high));
        if (!(T <= kOpaque * request_.tolerance)) return false;
        sum.error += T * std::ranges::max(tables_.sensitivity().white());
        return true;
    }

    /// Of bloch_sum(): harmonics that the points of a band resolve, or what was asked for.
    std::uint64_t terms_of(const Range& range, std::size_t points, bool& has_harmonics) const {
        const double resolved = kLargestStep * static_cast<double>(points) / (2 * range.phase);
        if (terms_ > 0) {
            const auto asked = static_cast<double>(terms_ - 1);
            has_harmonics = has_harmonics && resolved >= asked;
            return 1 + static_cast<std::uint64_t>(std::min(resolved, asked));
        }
        if (resolved >= range.enough) return 0;
        std::uint64_t terms = 1;
        while (static_cast<double>(2 * terms - 1) <= resolved) terms *= 2;
        return terms;
    }

    const ColorTables& tables_;
    std::size_t terms_;  ///< 0: as many as the tolerance needs
    ColorRequest request_;
    mutable Pool<Scratch> scratch_;
};

}  // namespace

std::unique_ptr<ColorAlgorithm> bloch_color(const ColorTables& tables, const Stack&,
                                            const ColorMethod& method,
                                            const ColorRequest& request) {
    return std::make_unique<BlochColor>(tables, method, request);
}

}  // namespace irido
