#include "core/scratch/light_integral.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/gauss.hpp"
#include "core/math/sine_integral.hpp"
#include "core/scratch/diffraction.hpp"

namespace irido {

namespace {

constexpr double kRelativeError = 1e-9;

/// The integral across a scratch, for one wavelength.
class AcrossIntegral {
public:
    AcrossIntegral(const VisibleScratch& scratch, const LightSlices& light, DepthPhase phase,
                   const UnitVector& view, double wavenumber_per_um,
                   const AngularReflectance& reflectance)
        : light_(light),
          phase_(phase),
          reflectance_(reflectance),
          width_(scratch.scratch().width_um),
          depth_(scratch.scratch().depth_um),
          nu_(wavenumber_per_um) {
        const auto [tx, ty] = scratch.tangent();
        view_ = {view[0] * tx + view[1] * ty, view[1] * tx - view[0] * ty, view[2]};
    }

    double view_along() const { return view_[0]; }

    /// (1/pi) int |d|^2 R dF over the light at xi_1.
    double operator()(double xi1) const {
        const double tau = xi1 - view_[0];
        if (!(std::abs(tau) < 1)) return 0;
        double sum = 0;
        for (const Arc& arc : light_.at(tau))
            sum += reflectance_ || (phase_ == DepthPhase::slanted && depth_ > 0)
                       ? by_points(tau, arc)
                       : closed(tau, arc, 2 * depth_);
        return sum;
    }

    /// The same on the band, with a slanted depth constant on equal parts of q.
    double on_band() const {
        constexpr int kParts = 16;
        const double tau = -view_[0], r = std::sqrt((1 - tau) * (1 + tau));
        if (!(r > 0)) return 0;
        if (reflectance_) return (*this)(0);
        double sum = 0;
        for (const Arc& arc : light_.at(tau)) {
            if (phase_ == DepthPhase::vertical) {
                sum += closed(tau, arc, 2 * depth_);
                continue;
            }
            const double from = r * std::sin(arc.from), to = r * std::sin(arc.to);
            for (int i = 0; i < kParts; ++i) {
                const double a = from + (to - from) * i / kParts,
                             b = from + (to - from) * (i + 1) / kParts, middle = (a + b) / 2;
                const double rise = std::sqrt(std::max(0.0, (r - middle) * (r + middle)));
                sum += groove_power(depth_ * (view_[2] + rise), nu_) *
                       slit_integral(turn_of(a), turn_of(b)) / kPi;
            }
        }
        return sum;
    }

private:
    /// 2 pi W q nu of w_b
    double turn_of(double across) const { return kTwoPi * width_ * nu_ * (view_[1] + across); }

    double closed(double tau, const Arc& arc, double path_um) const {
        const double r = std::sqrt((1 - tau) * (1 + tau));
        return groove_power(path_um, nu_) *
               slit_integral(turn_of(r * std::sin(arc.from)), turn_of(r * std::sin(arc.to))) / kPi;
    }

    /// W nu int |d|^2 R sinc^2(pi W q nu) dq over psi, q = w_o.b + r sin psi.
    double by_points(double tau, const Arc& arc) const {
        constexpr double kTurn = 12;  // that 16 points integrate
        const double r = std::sqrt((1 - tau) * (1 + tau)), length = arc.to - arc.from;
        const double turn = kTwoPi * nu_ * r * (width_ + depth_) * length;
        const int panels = 1 + static_cast<int>(turn / kTurn);
        const double half = length / (2 * panels);
        double sum = 0;
        for (int panel = 0; panel < panels; ++panel)
            for (const GaussNode& node : gauss_legendre<16>()) {
                const double psi = arc.from + half * (2 * panel + 1 + node.x);
                const double across = r * std::sin(psi), rise = r * std::cos(psi);
                const double path =
                    phase_ == DepthPhase::vertical ? 2 * depth_ : depth_ * (view_[2] + rise);
                double value =
                    groove_power(path, nu_) * slit_power(width_, view_[1] + across, nu_) * rise;
                if (reflectance_) {
                    const double both = tau * view_[0] + across * view_[1] + rise * view_[2];
                    value *= reflectance_(std::sqrt(std::clamp((1 + both) / 2, 0.0, 1.0)));
                }
                sum += node.weight * value;
            }
        return width_ * nu_ * half * sum;
    }

    const LightSlices& light_;
    DepthPhase phase_;
    const AngularReflectance& reflectance_;
    double width_, depth_, nu_;
    UnitVector view_;
};

/// A smooth piece of the integral along the scratch: xi_1 = middle + half sin(phi), which takes
/// the square roots away with which a light begins and ends.
struct SmoothPiece {
    double middle, half, from, to;  ///< of phi
};

template <class Function>
double sixteen_points(const SmoothPiece& piece, const Function& at) {
    const double half = (piece.to - piece.from) / 2, middle = piece.from + half;
    double sum = 0;
    for (const GaussNode& node : gauss_legendre<16>()) {
        const double phi = middle + half * node.x;
        sum += node.weight * piece.half * std::cos(phi) *
               at(piece.middle + piece.half * std::sin(phi));
    }
    return half * sum;
}

/// Pieces halved until halves agree with the whole to kRelativeError of the integral.
template <class Function>
double adaptive(std::vector<SmoothPiece> pieces, const Function& at) {
    constexpr int kMostRounds = 12;
    std::vector<double> values;
    double estimate = 0, sum = 0;
    for (const SmoothPiece& piece : pieces) {
        values.push_back(sixteen_points(piece, at));
        estimate += values.back();
    }
    for (int round = 0; !pieces.empty(); ++round) {
        std::vector<SmoothPiece> next;
        std::vector<double> next_values;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            SmoothPiece first = pieces[i], second = first;
            first.to = second.from = first.from + (first.to - first.from) / 2;
            const double a = sixteen_points(first, at), b = sixteen_points(second, at);
            const double off = std::abs(a + b - values[i]);
            if (off <= kRelativeError * std::max(estimate, sum) || round == kMostRounds) {
                sum += a + b;
                continue;
            }
            next.insert(next.end(), {first, second});
            next_values.insert(next_values.end(), {a, b});
        }
        pieces.swap(next);
        values.swap(next_values);
    }
    return sum;
}

/// Between the light's breaks where the scratch's lobe counts; far from its middle, where ends
/// reflect, pieces grow.
std::vector<SmoothPiece> smooth_pieces(bool has_ends, const LightSlices& light, double view_along,
                                       double per_xi1) {
    constexpr double kReach = 6.5, kFirstLength = 3.25;  // of y = sigma k xi_1
    const std::span<const double> breaks = light.breaks();
    const double first = breaks.front() + view_along, last = breaks.back() + view_along;
    const double nearest = first > 0 ? first : last < 0 ? -last : 0;
    const double limit = has_ends ? 3 : std::hypot(nearest, kReach / per_xi1);
    std::vector<SmoothPiece> pieces;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const double a = breaks[i] + view_along, b = breaks[i + 1] + view_along;
        const double from = std::max(a, -limit), to = std::min(b, limit);
        const double half = (b - a) / 2, middle = a + half;
        if (!(from < to) || !(half > 0)) continue;
        const auto phi_of = [&](double xi1) {
            return std::asin(std::clamp((xi1 - middle) / half, -1.0, 1.0));
        };
        for (double at = from; at < to;) {
            const double y = at * per_xi1;
            // from outside inwards half of the way, from inside outwards as far again
            const double length = y < -kReach  ? std::max(kFirstLength, -y / 2)
                                  : y > kReach ? y
                                               : kFirstLength;
            double next = std::min(to, at + length / per_xi1);
            if (next + 0.1 * length / per_xi1 > to) next = to;
            pieces.push_back({middle, half, phi_of(at), phi_of(next)});
            at = next;
        }
    }
    return pieces;
}

}  // namespace

std::vector<RulePoint> legendre_rule(int count) {
    constexpr int kMost = 64;
    require_in_range("points", count, 1, kMost);
    std::vector<RulePoint> rule;
    for (int i = count; i-- > 0;) {
        double x = std::cos(kPi * (i + 0.75) / (count + 0.5)), slope = 1;
        for (int step = 0; step < 8; ++step) {
            double p = 1, before = 0;
            for (int n = 0; n < count; ++n) {
                const double next = ((2 * n + 1) * x * p - n * before) / (n + 1);
                before = p;
                p = next;
            }
            slope = count * (x * p - before) / (x * x - 1);
            x -= p / slope;
        }
        rule.push_back({x, 2 / ((1 - x * x) * slope * slope)});
    }
    return rule;
}

std::vector<Interval> band_intervals(const VisibleScratch& scratch, const LightSlices& light,
                                     const UnitVector& view) {
    const auto [tx, ty] = scratch.tangent();
    const double tau = -(view[0] * tx + view[1] * ty), across = view[1] * tx - view[0] * ty;
    std::vector<Interval> intervals;
    if (!(std::abs(tau) < 1)) return intervals;
    const double r = std::sqrt((1 - tau) * (1 + tau));
    for (const Arc& arc : light.at(tau))
        intervals.push_back({across + r * std::sin(arc.from), across + r * std::sin(arc.to)});
    return intervals;
}

LobeTable lobe_under(const VisibleScratch& scratch, const LightSlices& light,
                     const UnitVector& view, double shortest_um) {
    if (light.breaks().empty()) return {scratch, 0, 0};
    const auto [tx, ty] = scratch.tangent();
    const double along = view[0] * tx + view[1] * ty;
    const double per_xi1 = kTwoPi * scratch.coherence_radius_um() / shortest_um;
    const double first = light.breaks().front() + along, last = light.breaks().back() + along;
    return {scratch, 0, per_xi1 * std::max(std::abs(first), std::abs(last))};
}

double light_ratio(const VisibleScratch& scratch, const LightSlices& light, DepthPhase phase,
                   const UnitVector& view, double wavelength_um, const LightIntegral& method,
                   const AngularReflectance& reflectance, const LobeTable* lobe) {
    constexpr double kShortest_um = 1e-3, kLongest_um = 1e4;
    require_in_range("wavelength_um", wavelength_um, kShortest_um, kLongest_um);
    if (light.breaks().empty()) return 0;
    const double nu = 1 / wavelength_um, per_xi1 = kTwoPi * scratch.coherence_radius_um() * nu;
    const AcrossIntegral across(scratch, light, phase, view, nu, reflectance);
    if (method.kind == LightIntegral::Kind::band) return scratch.share() * across.on_band();
    if (method.kind == LightIntegral::Kind::points) {
        const double first = std::erf(per_xi1 * (light.breaks().front() + across.view_along())),
                     last = std::erf(per_xi1 * (light.breaks().back() + across.view_along()));
        double sum = 0;
        for (const RulePoint& point : legendre_rule(method.points)) {
            const double e = (first + last) / 2 + (last - first) / 2 * point.x;
            if (std::abs(e) >= 1) continue;
            sum += point.weight * across(boost::math::erf_inv(e) / per_xi1);
        }
        return scratch.share() * (last - first) / 4 * sum;
    }
    const LobeTable own =
        lobe ? LobeTable(scratch, 0, 0) : lobe_under(scratch, light, view, wavelength_um);
    const LobeTable& power_at = lobe ? *lobe : own;
    const auto at = [&](double xi1) {
        const double power = power_at(per_xi1 * xi1);
        return power == 0 ? 0 : power * across(xi1);
    };
    const double sum =
        adaptive(smooth_pieces(power_at.has_ends(), light, across.view_along(), per_xi1), at);
    return scratch.scratch().width_um / (kPi * scratch.coherence_radius_um()) * per_xi1 * sum;
}

}  // namespace irido
