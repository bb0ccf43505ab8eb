#include "core/periodic/bragg.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/stack/stack.hpp"

namespace irido {

namespace {

constexpr double kRounding = std::numeric_limits<double>::epsilon() / 2;

double total_path(const BraggPeriod& period) {
    return period.path1_nm + period.path2_nm;
}

/// Bloch phase of order M in the absence of interface reflections, in terms of the share w <= 1/2
/// of the shorter path: M w = integer + phi / pi.
struct Detuning {
    double share;  ///< w
    double phi;    ///< [-pi/2, pi/2]; 0 where the gap of order M is closed
    bool odd_whole;
};

Detuning detuning(const BraggPeriod& period, double order) {
    const double smaller = std::min(period.path1_nm, period.path2_nm);
    const double share = smaller / total_path(period);
    const double turns = order * share, whole = std::round(turns);
    const double rest = turns - whole;
    const bool is_closed = std::abs(rest) <= 8 * kRounding * turns;
    return {share, is_closed ? 0 : kPi * rest, std::fmod(whole, 2) != 0};
}

/// The root in [0, pi/2] of sin(delta) = rho sin(phi - side (1 - 2w) delta), rho = x / (x + 2), phi
/// in [0, pi/2], side +1 or -1. With alpha = phi/2 + side w delta and beta = side delta - alpha
/// this becomes
///     f(delta) = side sin(alpha + beta) + x (side > 0 ? cos(alpha) sin(beta)
///                                                     : -sin(alpha) cos(beta)) = 0,
/// free of any cancellation that would affect the root, whether rho is close to 0 or 1 or w is
/// small. f(0) <= 0 <= f(pi/2), and the root is simple.
///   x              contrast, >= 0
///   w              share of the shorter path, [0, 1/2]
///   phi            detuning, [0, pi/2]
///   positive_side  whether side is +1
///   step           relative size of a Newton step at which the iteration stops
double deviation(double x, double w, double phi, bool positive_side, double step) {
    if (x == 0 || phi == 0) return 0;
    double low = 0, high = kPi / 2;
    double delta = std::min(phi, 1.0) * x / (x + 2);
    for (int i = 0; i < 200; ++i) {
        const double alpha = positive_side ? phi / 2 + w * delta : phi / 2 - w * delta;
        const double beta = positive_side ? (1 - w) * delta - phi / 2 : (1 - w) * delta + phi / 2;
        const double sin_a = std::sin(alpha), cos_a = std::cos(alpha);
        const double sin_b = std::sin(beta), cos_b = std::cos(beta);
        const double f = std::sin(delta) + x * (positive_side ? cos_a * sin_b : -sin_a * cos_b);
        const double straight = positive_side ? cos_a * cos_b : sin_a * sin_b;
        const double crossed = positive_side ? -sin_a * sin_b : cos_a * cos_b;
        const double slope = std::cos(delta) + x * ((1 - w) * straight + w * crossed);
        (f < 0 ? low : high) = delta;
        double next = delta - f / slope;
        if (!(next > low && next < high)) next = low + (high - low) / 2;
        if (std::abs(next - delta) <= step * delta || next == low || next == high) return next;
        delta = next;
    }
    return delta;
}

/// t = order pi/2 + delta, with delta the root in [-pi/2, pi/2] of
///     sin(delta) = +-rho sin(phi - (1 - 2w) delta)
/// for phi of either sign: its magnitude is found with all signs positive.
double total_phase(double x, const Detuning& at, double order, bool negative,
                   double step = kRounding) {
    const double size = deviation(x, at.share, std::abs(at.phi), !negative, step);
    double t = order * (kPi / 2) + ((at.phi < 0) == negative ? size : -size);
    if (order != 1 || t >= 1) return t;
    // only here can t be near 0, at high contrast: there cos(wt) cos(t - wt) equals
    // (x + 1) sin(wt) sin(t - wt)
    for (int i = 0; i < 3; ++i) {
        const double alpha = at.share * t, beta = (1 - at.share) * t;
        const double f =
            std::cos(alpha) * std::cos(beta) - (x + 1) * std::sin(alpha) * std::sin(beta);
        const double from_alpha = std::sin(alpha) * std::cos(beta);
        const double from_beta = std::cos(alpha) * std::sin(beta);
        t += f / (at.share * (from_alpha + (x + 1) * from_beta) +
                  (1 - at.share) * (from_beta + (x + 1) * from_alpha));
    }
    return t;
}

/// Relative size of the last step; most steps square the error.
double last_step(Roots roots) {
    return roots == Roots::exact ? kRounding : 1e-10;
}

/// max(q, 1/q) - 1, or 0 if that is within the rounding errors of q.
double contrast(double q) {
    const double excess = q < 1 ? (1 - q) / q : q - 1;
    return excess <= 16 * kRounding ? 0 : excess;
}

/// The fixed point of(omega) = omega. `of` is positive and bounded.
template <class Of>
double self_consistent(const Of& of) {
    double x = of(1e-2);
    double y = of(x);
    if (y == x) return x;
    // of(low) > low, of(high) < high
    double low = x, high = x;
    if (y > x) {
        for (double factor = 1.01; of(high) > high; factor *= factor) high *= factor;
    } else {
        for (double factor = 1.01; of(low) < low; factor *= factor) low /= factor;
    }
    double above = of(low) - low, below = of(high) - high;
    for (int i = 0; i < 300 && above > 0 && below < 0; ++i) {
        // secant through both ends, bisection every third step
        x = i % 3 == 2 ? low + (high - low) / 2 : low + (high - low) * (above / (above - below));
        if (!(x > low && x < high)) x = low + (high - low) / 2;
        if (!(x > low && x < high)) return low;
        y = of(x) - x;
        if (std::abs(y) <= 2 * kRounding * x) return x;
        (y > 0 ? low : high) = x;
        (y > 0 ? above : below) = y;
    }
    return above > 0 ? high : low;
}

/// Smallest and largest omega path / pi over a range.
struct TurnRange {
    double least = std::numeric_limits<double>::infinity();
    double most = 0;
};

/// Throws unless both phases increase with omega, as the landmark formulas assume. Gap edges may
/// lie outside the range, so it is checked somewhat beyond it, wherever the period exists.
void require_growing_phases(const PeriodAt& period, const OmegaRange& range) {
    constexpr int kSamples = 2000;
    constexpr double kBeyond = 1.5;
    const double low = range.low_per_nm / kBeyond, high = range.high_per_nm * kBeyond;
    double a = 0, b = 0;
    for (int i = 0; i <= kSamples; ++i) {
        const double omega = low + (high - low) * (i / double{kSamples});
        BraggPeriod at;
        try {
            at = period(omega);
        } catch (const DomainError&) {
            if (omega >= range.low_per_nm && omega <= range.high_per_nm) throw;
            continue;
        }
        const double next_a = omega * at.path1_nm, next_b = omega * at.path2_nm;
        if (next_a < a || next_b < b)
            throw DomainError("the phase of a layer must grow with 1/wavelength (it falls near " +
                              to_text(std::round(2 * kPi / omega)) +
                              " nm): its landmarks are not unique");
        a = next_a;
        b = next_b;
    }
}

template <class Path>
TurnRange turns_in(const PeriodAt& period, const OmegaRange& range, const Path& path) {
    constexpr int kSamples = 64;
    TurnRange result;
    for (int i = 0; i <= kSamples; ++i) {
        const double omega =
            range.low_per_nm + (range.high_per_nm - range.low_per_nm) * (i / double{kSamples});
        const double turns = omega * path(period(omega)) / kPi;
        result.least = std::min(result.least, turns);
        result.most = std::max(result.most, turns);
    }
    if (!(result.most - result.least <= kMostOrders))
        throw DomainError("orders of landmarks must be at most " + to_text(kMostOrders) +
                          " in the range (got " + to_text(std::ceil(result.most - result.least)) +
                          ")");
    return result;
}

/// The integers just below and above.
std::int64_t first_order(double turns, std::int64_t least) {
    return std::max(least, static_cast<std::int64_t>(std::floor(turns)));
}
std::int64_t last_order(const TurnRange& range) {
    return static_cast<std::int64_t>(std::floor(range.most)) + 1;
}

}  // namespace

BraggPeriod bragg_period(const RealLayer& first, const RealLayer& second, double n0,
                         IncidentAngle incidence, Polarization polarization) {
    require_in_range("thickness_nm", first.thickness_nm, 0, kLargestThickness_nm);
    require_in_range("thickness_nm", second.thickness_nm, 0, kLargestThickness_nm);
    require_in_range("cos_theta", incidence.cos, 0, 1);
    if (first.thickness_nm == 0 && second.thickness_nm == 0)
        throw DomainError("a period must have a thickness (got 0 nm)");
    const double q2_1 = medium(first.n, n0, incidence).q2.real();
    const double q2_2 = medium(second.n, n0, incidence).q2.real();
    for (const auto& [q2, n] : {std::pair{q2_1, first.n}, std::pair{q2_2, second.n}})
        if (!(q2 > 0))
            throw DomainError("there are no landmarks past the critical angle of a layer (n = " +
                              to_text(n) + ")");
    const double kz1 = std::sqrt(q2_1), kz2 = std::sqrt(q2_2);
    const double ratio = first.n / second.n;
    return {kz1 * first.thickness_nm, kz2 * second.thickness_nm,
            polarization == Polarization::s ? kz2 / kz1 : ratio * ratio * (kz2 / kz1)};
}

bool reaches_brewster(double n1, double n2, double n0) {
    return n1 * n2 <= n0 * std::hypot(n1, n2);
}

double omega_of_mode(const BraggPeriod& period, double order) {
    return order * kPi / total_path(period);
}

double omega_of_zero(const BraggPeriod& period, double order) {
    return order * kPi / period.path2_nm;
}

// With h = (a + b)/2 = M pi/4 + delta/2, Q = (q + 1/q)/2 and R = (Q - 1)/(Q + 1), cos KL = 0 reads
// cos 2h = R cos 2g, hence sin(delta) = -+R sin(phi - (1 - 2w) delta) for M = 2m + 1.
double omega_of_airy(const BraggPeriod& period, double order, Roots roots) {
    const double q = period.admittance_ratio;
    const Detuning at = detuning(period, 2 * order + 1);
    const double x = (q - 1) * (q - 1) / (2 * q);
    return total_phase(x, at, 2 * order + 1, !at.odd_whole, last_step(roots)) / total_path(period);
}

// cos KL = 1 where sin h = +-r sin g, cos KL = -1 where cos h = +-r cos g, r = (q - 1)/(q + 1).
// With h = m pi/2 + delta both become sin(delta) = +-r sin(phi - (1 - 2w) delta), with one root per
// sign.
BandGap band_gap(const BraggPeriod& period, double order, Roots roots) {
    const double x = contrast(period.admittance_ratio);
    const Detuning at = detuning(period, order);
    const double one = total_phase(x, at, order, false, last_step(roots));
    const double other = total_phase(x, at, order, true, last_step(roots));
    const double path = total_path(period);
    return {order, 2 * std::min(one, other) / path, 2 * std::max(one, other) / path};
}

BandGap band_gap(const PeriodAt& period, double order) {
    const double low =
        self_consistent([&](double omega) { return band_gap(period(omega), order).low_per_nm; });
    const double high =
        self_consistent([&](double omega) { return band_gap(period(omega), order).high_per_nm; });
    return {order, low, std::max(low, high)};
}

std::vector<Landmark> landmarks(const PeriodAt& period, const OmegaRange& range) {
    std::vector<Landmark> found;
    const auto keep = [&](LandmarkKind kind, double order, double omega) {
        if (omega >= range.low_per_nm && omega <= range.high_per_nm)
            found.push_back({kind, order, omega});
    };
    require_growing_phases(period, range);
    const TurnRange all = turns_in(period, range, total_path);
    for (std::int64_t i = first_order(all.least - 1, 0); i <= last_order(all); ++i) {
        const auto m = static_cast<double>(i);
        if (m > 0) {
            const BandGap gap = band_gap(period, m);
            keep(LandmarkKind::edge, m, gap.low_per_nm);
            keep(LandmarkKind::mode, m,
                 self_consistent([&](double omega) { return omega_of_mode(period(omega), m); }));
            keep(LandmarkKind::edge, m, gap.high_per_nm);
        }
        keep(LandmarkKind::airy, m,
             self_consistent([&](double omega) { return omega_of_airy(period(omega), m); }));
    }
    const TurnRange zeros =
        turns_in(period, range, [](const BraggPeriod& at) { return at.path2_nm; });
    for (std::int64_t i = first_order(zeros.least, 1); zeros.most > 0 && i <= last_order(zeros);
         ++i) {
        const auto z = static_cast<double>(i);
        keep(LandmarkKind::zero, z,
             self_consistent([&](double omega) { return omega_of_zero(period(omega), z); }));
    }
    std::ranges::stable_sort(found, {}, &Landmark::omega_per_nm);
    return found;
}

std::vector<BandGap> band_gaps(const PeriodAt& period, const OmegaRange& range) {
    std::vector<BandGap> found;
    require_growing_phases(period, range);
    const TurnRange all = turns_in(period, range, total_path);
    for (std::int64_t i = first_order(all.least - 1, 1); i <= last_order(all); ++i) {
        const BandGap gap = band_gap(period, static_cast<double>(i));
        if (gap.high_per_nm >= range.low_per_nm && gap.low_per_nm <= range.high_per_nm)
            found.push_back(gap);
    }
    return found;
}

}  // namespace irido
