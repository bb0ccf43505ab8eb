#include "core/thickness/fringe_series.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/faddeeva.hpp"

namespace irido {

namespace {

/// Terms below this are left out.
constexpr double kSmallestTerm = 1e-16;

/// More terms than this take longer than quadrature; with a cut at zero, each of them takes longer.
constexpr double kMostTerms = 3000, kMostCutTerms = 300;

/// Below this the logarithm of a bounce loses digits of the sum.
constexpr double kSlowestDecay = 1e-3;

/// A Gaussian phase of this standard deviation is any phase.
constexpr double kLargestPhase = 8.6;  // exp(-8.6^2/2) = 1e-16

/// Standard deviations from which on a cut removes less than 1e-15.
constexpr double kUncut = 8;

double size(Complex z) {
    return std::abs(z.real()) + std::abs(z.imag());
}

/// Means of exp(i k phase - q loss) over thicknesses, phase + i loss = turn d, for whole k and q,
/// and their sums over the round trips of a layer.
class RoundTrips {
public:
    RoundTrips(Complex bounce, Complex turn_per_nm, double mean_nm, double sigma_nm)
        : bounce_(bounce),
          phase_(turn_per_nm.real() * mean_nm),
          loss_(turn_per_nm.imag() * mean_nm),
          phase_spread_(turn_per_nm.real() * sigma_nm),
          loss_spread_(turn_per_nm.imag() * sigma_nm),
          depth_(mean_nm / sigma_nm) {
        if (depth_ >= kUncut) return;
        cut_ = std::exp(-depth_ * depth_ / 2) / 2;
        inside_ = std::erfc(-depth_ / std::numbers::sqrt2) / 2;
    }

    /// Whether the sums are short, and the means good to rounding.
    bool converge() const {
        const double decay = -std::log(std::abs(bounce_));
        if (!(decay > kSlowestDecay)) return false;
        const auto orders = [&](double largest) {
            return std::max(1.0, std::log(largest / kSmallestTerm) / decay);
        };
        const double any_phase = kLargestPhase / std::abs(phase_spread_);
        const double turns = std::max(std::min(orders(1), any_phase), orders(cut_));
        if (!has_loss()) return turns < (is_cut() ? kMostCutTerms : kMostTerms);
        const double losses = std::min(orders(1), -std::log(kSmallestTerm) / loss_) / 2 + 1;
        if (is_cut()) return turns * losses < kMostCutTerms && centre(orders(1) + 2) > 0;
        return turns * losses < kMostTerms;
    }

    /// sum_{n > 0} bounce^(n-1) <E^n>. Along n the exponent is quadratic: a term follows from the
    /// one before by a ratio, a ratio by a constant.
    Complex singles() const {
        const Complex start = std::exp(exponent(1, 1));
        const Complex next_factor = has_loss() ? std::exp(exponent(2, 2) - 2.0 * exponent(1, 1))
                                               : Complex(std::exp(-phase_spread_ * phase_spread_));
        Term term{1, start};
        Complex next = bounce_ * start * next_factor, sum = 0;
        for (double n = 1; counts(term) && centre(n) > 0; ++n) {
            sum += inside(term, n, n);
            term.weight *= bounce_;
            term.whole *= next;
            next *= next_factor;
        }
        return sum;
    }

    /// sum_{n, m >= 0} bounce^n conj(bounce)^m <E^n conj(E)^m |E|^q> without loss, where E conj(E)
    /// is 1, from singles().
    double pairs_without_loss(Complex singles) const {
        return (1 + 2 * (bounce_ * singles).real()) / (1 - std::norm(bounce_));
    }

    /// The same with loss, by ratios along n with n - m fixed, and along n with m = 0.
    double pairs_with_loss(double q) const {
        const double square = std::norm(bounce_), growth = loss_spread_ * loss_spread_;
        const Complex start = exponent(0, q), turn{0, -2 * phase_spread_ * loss_spread_};
        const Complex next_factor = std::exp(growth - phase_spread_ * phase_spread_ + turn);
        const Complex pair_factor = std::exp(2 * growth + turn);
        const double pair_growth = std::exp(4 * growth);
        Term term{1, std::exp(start)};
        Complex next = bounce_ * std::exp(exponent(1, q + 1) - start);
        Complex pair = square * std::exp(exponent(0, q + 2) - start);
        double sum = 0;
        for (double k = 0; counts(term); ++k) {
            const double both = k == 0 ? 1 : 2;  // n > m, and m > n
            Term at = term;
            Complex step = pair;
            for (double loss = k + q; counts(at) && centre(loss) > 0; loss += 2) {
                sum += both * inside(at, k, loss).real();
                at.weight *= square;
                at.whole *= step;
                step *= pair_growth;
            }
            term.weight *= bounce_;
            term.whole *= next;
            next *= next_factor;
            pair *= pair_factor;
        }
        return sum;
    }

    bool has_loss() const { return loss_spread_ != 0; }

private:
    /// A product of bounces, and that times its mean over the whole Gaussian.
    struct Term {
        Complex weight, whole;
    };

    bool is_cut() const { return cut_ > 0; }

    bool counts(const Term& term) const {
        return size(term.whole) + cut_ * size(term.weight) > kSmallestTerm;
    }

    /// Of the Gaussian times exp(-q loss), in standard deviations. Below zero that leaves nothing
    /// above the cut.
    double centre(double q) const { return depth_ - q * loss_spread_; }

    /// Logarithm of the mean over the whole Gaussian.
    Complex exponent(double k, double q) const {
        const double a = k * phase_spread_, b = q * loss_spread_;
        return {-q * loss_ + (b - a) * (b + a) / 2, k * phase_ - a * b};
    }

    /// A term's mean over the thicknesses above zero.
    Complex inside(const Term& term, double k, double q) const {
        if (!is_cut()) return term.whole;
        const Complex z = Complex(-k * phase_spread_, centre(q)) / std::numbers::sqrt2;
        return (term.whole - cut_ * term.weight * faddeeva(z)) / inside_;
    }

    Complex bounce_;
    double phase_, loss_, phase_spread_, loss_spread_, depth_;
    double cut_ = 0, inside_ = 1;
};

}  // namespace

std::optional<MeanFringes> mean_fringes(const Fringes& fringes, double mean_nm, double sigma_nm,
                                        bool needs_T) {
    const Complex bounce = -fringes.bounce;
    const RoundTrips trips(bounce, fringes.turn_per_nm, mean_nm, sigma_nm);
    if (!trips.converge()) return {};
    const Complex singles = trips.singles();
    const auto pairs = [&](double q) {
        return trips.has_loss() ? trips.pairs_with_loss(q) : trips.pairs_without_loss(singles);
    };
    // r = near + trip sum_{n > 0} bounce^(n-1) E^n
    const Complex trip = fringes.far + fringes.near * bounce;
    const double R = std::norm(fringes.near) +
                     2 * (std::conj(fringes.near) * trip * singles).real() +
                     std::norm(trip) * pairs(2);
    return MeanFringes{R, needs_T && fringes.through != 0 ? fringes.through * pairs(1) : 0};
}

}  // namespace irido
