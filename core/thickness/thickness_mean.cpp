#include "core/thickness/thickness_mean.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/error.hpp"
#include "core/math/gauss.hpp"

namespace irido {

namespace {

/// Standard deviations on either side that count; the rest is 1e-15 of a Gaussian.
constexpr double kReach = 8;

/// A Gaussian phase of this standard deviation, radians, is any phase: exp(-9^2/2) = 3e-18.
constexpr double kForgottenPhase = 9;

/// Absorbers of a thickness, in radians, that is gone before its phase is: with any other phase
/// they would gain light. Their part of what forgets the phase is below rounding.
constexpr double kOwnPhase = 1;

/// From this standard deviation on a wrapped Gaussian takes fewer points than a long one.
constexpr double kWrappedPhase = 0.8;

/// Equally spaced points are doubled until they agree, and are so dense that a pole's part of the
/// error shrinks as well: between neighbours at -+ its distance tan(turn/2) the guide turns by
/// `turn`, and the sum over points so far apart has the error exp(-pi / tan(turn/2)) of that part,
/// its root before the doubling.
struct Agreement {
    double difference, turn;
};
constexpr Agreement kCloseAgreement{1e-12, 1.5}, kDenseAgreement{1e-9, 0.4};
constexpr int kDoublings = 4;

/// Turn of the guide between neighbours on a panel that may pass for smooth.
constexpr double kResolvedTurn = 1.5;

/// Error of one panel, and what an interval may weigh that hides a line.
constexpr double kPanelError = 2e-14;
constexpr double kHiddenWeight = 1e-15;

/// Rounding of a value, as part of it, for every factor by which the guide is below its largest;
/// and of a thickness.
constexpr double kRounding = 1e-14, kThicknessRounding = 2e-16;

/// What a panel of hardly any weight cannot hold unless the integral is infinite.
constexpr double kNoWeight = 1e-10, kPole = 0.01;

constexpr int kMostEvaluations = 1'000'000;

double density(double z) {
    return std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
}

/// Part of a Gaussian below z.
double part_below(double z) {
    return std::erfc(-z / std::numbers::sqrt2) / 2;
}

[[noreturn]] void throw_no_mean() {
    throw DomainError(
        "the mean over thickness_sigma_nm does not converge: the stack amplifies without bound at "
        "one of the thicknesses");
}

double turn_between(Complex a, Complex b) {
    return std::abs(std::arg(b * std::conj(a)));
}

/// Integrals over an interval of weight(x) f(x), and of the weight alone.
class WeightedIntegral {
public:
    using Weight = std::function<double(double)>;
    using Function = std::function<Complex(double, std::span<double>)>;

    /// `rounding` of a value, as part of it, at a thickness far from all poles.
    WeightedIntegral(const Function& f, const Weight& weight, std::size_t values,
                     double rounding = kRounding)
        : f_(f),
          weight_(weight),
          rounding_(rounding),
          sum_(values + 1),
          sample_(values),
          kronrod_(values + 1),
          gauss_(values + 1) {}

    /// With equally spaced points, for weights that vanish at both ends or periodic integrands;
    /// false if they do not converge.
    bool equally_spaced(double from, double to, int intervals) {
        guides_.assign(static_cast<std::size_t>(intervals) + 1, {});
        std::ranges::fill(sum_, 0);
        const double width = to - from;
        for (int i = 0; i <= intervals; ++i) {
            const double end = i == 0 || i == intervals ? 0.5 : 1;
            guides_[static_cast<std::size_t>(i)] =
                add_point(from + width * i / intervals, end, sum_);
        }
        for (int doubling = 0; doubling < kDoublings; ++doubling, intervals *= 2) {
            before_ = sum_;
            std::vector<Complex> guides(2 * guides_.size() - 1);
            for (std::size_t i = 0; i < guides_.size(); ++i) guides[2 * i] = guides_[i];
            for (int i = 0; i < intervals; ++i)
                guides[2 * static_cast<std::size_t>(i) + 1] =
                    add_point(from + width * (i + 0.5) / intervals, 1, sum_);
            guides_ = std::move(guides);
            if (doubled_agree()) {
                for (double& value : sum_) value *= width / (2 * intervals);
                return true;
            }
        }
        return false;
    }

    /// With panels halved where they have to be. The first ones are as wide as `first` at `from`
    /// and grow twofold, if first > 0; else there are four.
    void by_panels(double from, double to, double first) {
        std::ranges::fill(sum_, 0);
        shortest_ = (to - from) * 1e-17;
        double begin = from;
        Complex at_begin = evaluate(from);
        for (double width = first > 0 ? first : (to - from) / 4; begin < to;) {
            double end = begin + width;
            if (end > to - width / 4) end = to;
            const Complex at_end = evaluate(end);
            add_panel({begin, end, at_begin, at_end});
            begin = end;
            at_begin = at_end;
            if (first > 0) width *= 2;
        }
    }

    std::span<const double> values() const { return std::span(sum_).first(sample_.size()); }
    double weight() const { return sum_.back(); }

private:
    Complex evaluate(double d) {
        if (++evaluations_ > kMostEvaluations)
            throw DomainError("the mean over thickness_sigma_nm needs more than " +
                              std::to_string(kMostEvaluations) +
                              " thicknesses: the stack has too many lines within the spread");
        const Complex guide = f_(d, sample_);
        largest_guide_ = std::max(largest_guide_, std::abs(guide));
        return guide;
    }

    Complex add_point(double d, double factor, std::vector<double>& to) {
        const Complex guide = evaluate(d);
        const double w = factor * weight_(d);
        for (std::size_t i = 0; i < sample_.size(); ++i) to[i] += w * sample_[i];
        to.back() += w;
        return guide;
    }

    bool doubled_agree() const {
        double difference = 0, turn = 0;
        for (std::size_t i = 0; i < sum_.size(); ++i)
            difference =
                std::max(difference, std::abs(sum_[i] / sum_.back() - before_[i] / before_.back()));
        for (std::size_t i = 1; i < guides_.size(); ++i)
            turn = std::max(turn, turn_between(guides_[i - 1], guides_[i]));
        return std::ranges::any_of(
            std::array{kCloseAgreement, kDenseAgreement}, [&](const Agreement& limit) {
                return difference <= std::max(limit.difference, rounding_) && turn <= limit.turn;
            });
    }

    struct Panel {
        double begin, end;
        Complex at_begin, at_end;
    };

    /// One panel, or its halves. Gauss's and Kronrod's sums differ by the error of the former; that
    /// of the latter is estimated as by R. Piessens et al., QUADPACK (1983), section 2.2.
    void add_panel(const Panel& panel) {
        const auto [hides, at_middle] = sum_panel(panel);
        if ((!hides && panel_error() <= kPanelError) || panel.end - panel.begin < shortest_)
            return accept();
        const double middle = (panel.begin + panel.end) / 2;
        add_panel({panel.begin, middle, panel.at_begin, at_middle});
        add_panel({middle, panel.end, at_middle, panel.at_end});
    }

    struct Seen {
        bool hides;  ///< a line between two points
        Complex at_middle;
    };

    Seen sum_panel(const Panel& panel) {
        std::ranges::fill(kronrod_, 0);
        std::ranges::fill(gauss_, 0);
        panel_rounding_ = 0;
        const double middle = (panel.begin + panel.end) / 2, half = (panel.end - panel.begin) / 2;
        Seen seen{false, 0};
        Complex before = panel.at_begin;
        double previous = -1, w = 0;
        const auto look = [&](double x, Complex here) {
            seen.hides = seen.hides || (turn_between(before, here) > kResolvedTurn &&
                                        w * (x - previous) > kHiddenWeight);
            before = here;
            previous = x;
        };
        for (const KronrodNode& node : kronrod()) {
            const Complex here = evaluate(middle + half * node.x);
            w = half * weight_(middle + half * node.x);
            add_sample(w * node.weight, kronrod_);
            panel_rounding_ += w * node.weight * rounding_ * largest_guide_ / std::abs(here);
            if (node.gauss > 0) add_sample(w * node.gauss, gauss_);
            look(node.x, here);
            if (node.x == 0) seen.at_middle = here;
        }
        look(1, panel.at_end);
        return seen;
    }

    void accept() {
        for (std::size_t i = 0; i < sum_.size(); ++i) {
            if (kronrod_.back() < kNoWeight && std::abs(kronrod_[i]) > kPole) throw_no_mean();
            sum_[i] += kronrod_[i];
        }
    }

    void add_sample(double w, std::vector<double>& to) const {
        for (std::size_t i = 0; i < sample_.size(); ++i) to[i] += w * sample_[i];
        to.back() += w;
    }

    double panel_error() const {
        double largest = 0;
        for (std::size_t i = 0; i < kronrod_.size(); ++i)
            largest = std::max(largest, std::abs(kronrod_[i] - gauss_[i]));
        const double weight = kronrod_.back();
        if (largest <= std::max(kPanelError, panel_rounding_) || weight == 0) return 0;
        return std::min(largest, weight * std::pow(200 * largest / weight, 1.5));
    }

    const Function& f_;
    const Weight& weight_;
    double rounding_;
    std::vector<double> sum_, sample_, before_, kronrod_, gauss_;
    std::vector<Complex> guides_;
    double shortest_ = 0, largest_guide_ = 0, panel_rounding_ = 0;
    int evaluations_ = 0;
};

void store_mean(const WeightedIntegral& integral, std::span<double> mean) {
    for (std::size_t i = 0; i < mean.size(); ++i)
        mean[i] = integral.values()[i] / integral.weight();
}

/// Of a value, from that of a thickness.
double rounding_of(const ThicknessSpread& s) {
    return kRounding + kThicknessRounding * std::abs(s.turn_per_nm.real()) * s.mean_nm;
}

/// Mean over a Gaussian of few fringes, whole or cut.
void mean_of_few_fringes(const ThicknessSpread& s, const ThicknessFunction& f,
                         std::span<double> mean) {
    const WeightedIntegral::Weight weight = [&](double d) {
        return density((d - s.mean_nm) / s.sigma_nm) / s.sigma_nm;
    };
    const WeightedIntegral::Function function = [&](double d, std::span<double> values) {
        return f(std::max(d, 0.0), 0, values);
    };
    WeightedIntegral integral(function, weight, mean.size(), rounding_of(s));
    const double from = s.mean_nm - kReach * s.sigma_nm, to = s.mean_nm + kReach * s.sigma_nm;
    if (from < 0) {
        // absorbers end within a radian of the cut
        integral.by_panels(0, to, 1 / std::max(std::abs(s.turn_per_nm), 1 / s.sigma_nm));
    } else {
        // the sum's error comes from turns beyond 2 pi / spacing: 6.3 of the Gaussian's own, and
        // those of a wave that makes two round trips
        const double turns = 6.3 + 2 * std::abs(s.turn_per_nm.real()) * s.sigma_nm;
        const int intervals =
            2 * static_cast<int>(std::ceil(kReach * turns / std::numbers::pi / 2));
        if (!integral.equally_spaced(from, to, intervals)) integral.by_panels(from, to, 0);
    }
    store_mean(integral, mean);
}

/// Mean over a Gaussian of phases wrapped around a full turn; sigma in radians, and infinite for
/// any phase alike.
void mean_of_phases(double sigma, const WeightedIntegral::Function& at_phase,
                    std::span<double> mean, double rounding = kRounding) {
    const WeightedIntegral::Weight weight = [&](double phase) {
        double sum = 1;
        for (int m = 1; m * sigma < kForgottenPhase; ++m)
            sum += 2 * std::exp(-std::pow(m * sigma, 2) / 2) * std::cos(m * phase);
        return sum;
    };
    WeightedIntegral integral(at_phase, weight, mean.size(), rounding);
    constexpr int intervals = 16;
    if (!integral.equally_spaced(-std::numbers::pi, std::numbers::pi, intervals))
        integral.by_panels(-std::numbers::pi, std::numbers::pi, 0);
    store_mean(integral, mean);
}

/// The same in a layer without absorption, where a change of thickness is one of phase.
void mean_of_phases_without_loss(const ThicknessSpread& s, double sigma, const ThicknessFunction& f,
                                 std::span<double> mean) {
    const double turn = std::abs(s.turn_per_nm.real());
    const double centre = std::isinf(sigma) ? std::numbers::pi / turn : s.mean_nm;
    const WeightedIntegral::Function at_phase = [&](double phase, std::span<double> values) {
        return s.has_phase ? f(centre, phase, values) : f(centre + phase / turn, 0, values);
    };
    mean_of_phases(sigma, at_phase, mean, s.has_phase ? kRounding : rounding_of({centre, 0, turn}));
}

constexpr double kAnyPhase = std::numeric_limits<double>::infinity();

/// Mean over a Gaussian of more fringes than a phase can remember. With l the thickness of
/// kForgottenPhase radians, the Gaussian is one of variance sigma^2 - l^2 over the centres y of
/// Gaussians of variance l^2. Those with y > 8 l do not feel the cut, and have forgotten the phase;
/// what the others leave above zero is integrated directly.
class ManyFringes {
public:
    ManyFringes(const ThicknessSpread& s, const ThicknessFunction& f, std::size_t values)
        : s_(s),
          f_(f),
          turn_(std::abs(s.turn_per_nm.real())),
          narrow_(kForgottenPhase / turn_),
          wide_(std::max(std::sqrt(std::max(0.0, s.sigma_nm * s.sigma_nm - narrow_ * narrow_)),
                         1e-9 * narrow_)),
          cut_(s.mean_nm < kReach * s.sigma_nm),
          edge_(cut_ ? kReach * narrow_ : 0),
          sum_(values) {}

    void operator()(std::span<double> mean) {
        const double forgetful = s_.turn_per_nm.imag() == 0 ? add_any_phase()
                                 : s_.has_phase             ? add_phases_of_thicknesses()
                                                            : add_centres();
        const double edge = cut_ ? add_edge() : 0;
        for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = sum_[i] / (forgetful + edge);
    }

private:
    /// All centres see the same mean where nothing absorbs.
    double add_any_phase() {
        mean_of_phases_without_loss(s_, kAnyPhase, f_, sum_);
        const double weight = cut_ ? part_below((s_.mean_nm - edge_) / wide_) : 1;
        for (double& value : sum_) value *= weight;
        return weight;
    }

    double add_phases_of_thicknesses() {
        return add_means(
            cut_ ? 0 : s_.mean_nm - kReach * s_.sigma_nm, s_.mean_nm + kReach * s_.sigma_nm,
            [&](double d) { return density_nm(d) - (cut_ ? edge_density(d) : 0); },
            [&](double d, std::span<double> values) {
                if (d * turn_ < kOwnPhase) {
                    std::ranges::fill(values, 0);
                    return Complex(1);
                }
                mean_of_phases(
                    kAnyPhase,
                    [&](double phase, std::span<double> at) {
                        return f_(std::max(d, 0.0), phase, at);
                    },
                    values);
                return Complex(1);
            });
    }

    double add_centres() {
        return add_means(
            cut_ ? edge_ : s_.mean_nm - kReach * wide_, s_.mean_nm + kReach * wide_,
            [&](double y) { return density((y - s_.mean_nm) / wide_) / wide_; },
            [&](double y, std::span<double> values) {
                mean_of_few_fringes({std::max(y, kReach * narrow_), narrow_, s_.turn_per_nm}, f_,
                                    values);
                return Complex(1);
            });
    }

    double add_means(double from, double to, const WeightedIntegral::Weight& weight,
                     const WeightedIntegral::Function& mean_at) {
        WeightedIntegral integral(mean_at, weight, sum_.size());
        constexpr int intervals = 20;
        if (cut_ || !integral.equally_spaced(from, to, intervals))
            integral.by_panels(from, to, cut_ ? narrow_ : 0);
        std::ranges::copy(integral.values(), sum_.begin());
        return integral.weight();
    }

    double density_nm(double d) const {
        return density((d - s_.mean_nm) / s_.sigma_nm) / s_.sigma_nm;
    }

    /// Density of the thicknesses whose centre is below edge_: given d, the centre is Gaussian.
    double edge_density(double d) const {
        const double narrow_part = std::pow(narrow_ / s_.sigma_nm, 2);
        const double centre = d * (1 - narrow_part) + s_.mean_nm * narrow_part;
        return density_nm(d) * part_below((edge_ - centre) * s_.sigma_nm / (wide_ * narrow_));
    }

    double add_edge() {
        const WeightedIntegral::Weight weight = [&](double d) { return edge_density(d); };
        const WeightedIntegral::Function function = [&](double d, std::span<double> values) {
            return f_(d, 0, values);
        };
        WeightedIntegral integral(function, weight, sum_.size());
        integral.by_panels(0, std::min(2 * edge_, s_.mean_nm + kReach * s_.sigma_nm),
                           1 / std::abs(s_.turn_per_nm));
        for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += integral.values()[i];
        return integral.weight();
    }

    const ThicknessSpread& s_;
    const ThicknessFunction& f_;
    double turn_, narrow_, wide_;
    bool cut_;
    double edge_;
    std::vector<double> sum_;
};

}  // namespace

void thickness_mean(const ThicknessSpread& s, const ThicknessFunction& f, std::span<double> mean) {
    const double turn = std::abs(s.turn_per_nm.real()), sigma_phase = turn * s.sigma_nm;
    const bool cut = s.mean_nm < kReach * s.sigma_nm;
    if (sigma_phase > kForgottenPhase) return ManyFringes(s, f, mean.size())(mean);
    if (!cut && s.turn_per_nm.imag() == 0 && sigma_phase > kWrappedPhase)
        return mean_of_phases_without_loss(s, sigma_phase, f, mean);
    mean_of_few_fringes(s, f, mean);
}

}  // namespace irido
