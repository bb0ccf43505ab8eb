#include "core/scratch/light_integral.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/gauss.hpp"
#include "core/math/sine_integral.hpp"
#include "core/math/vector_math.hpp"
#include "core/scratch/diffraction.hpp"

namespace irido {

namespace {

/// Of a scratch's light, or of what it is part of, in each piece.
constexpr double kRelativeError = 1e-10;

/// The integral across a scratch, at all wavelengths.
class AcrossIntegral {
public:
    AcrossIntegral(const VisibleScratch& scratch, const LitView& lit, std::span<const double> nu,
                   const CosineSeries& reflectance)
        : light_(lit.light),
          phase_(lit.phase),
          reflectance_(reflectance),
          width_(scratch.scratch().width_um),
          depth_(scratch.scratch().depth_um),
          nu_(nu),
          angle_(nu.size()),
          sine_(nu.size()),
          cosine_(nu.size()),
          slit_(nu.size()),
          work_(2 * nu.size()) {
        const auto [tx, ty] = scratch.tangent();
        const UnitVector& view = lit.view;
        view_ = {view[0] * tx + view[1] * ty, view[1] * tx - view[0] * ty, view[2]};
        largest_nu_ = std::ranges::max(nu);
    }

    double view_along() const { return view_[0]; }
    std::size_t size() const { return nu_.size(); }

    /// (1/pi) int |d|^2 R dF over the light at xi_1; false where there is none.
    bool at(double xi1, std::span<double> sums) {
        std::ranges::fill(sums, 0.0);
        const double tau = xi1 - view_[0];
        if (!(std::abs(tau) < 1)) return false;
        const std::vector<Arc> arcs = light_.at(tau);
        const bool is_closed =
            reflectance_.is_empty() && (phase_ == DepthPhase::vertical || depth_ == 0);
        for (const Arc& arc : arcs)
            if (is_closed)
                add_closed(tau, arc, sums);
            else
                add_points(tau, arc, sums);
        return !arcs.empty();
    }

    /// The same at one of the wavelengths.
    double at(double xi1, std::size_t wavelength) const {
        const std::array one{nu_[wavelength]};
        AcrossIntegral narrow = *this;
        narrow.nu_ = one;
        narrow.offset_ = wavelength;
        std::array<double, 1> sum{};
        narrow.at(xi1, sum);
        return sum[0];
    }

    /// The same on the band, with a slanted depth constant on equal parts of q.
    double on_band(std::size_t wavelength) const {
        constexpr int kParts = 16;
        const double tau = -view_[0], r = std::sqrt((1 - tau) * (1 + tau)), nu = nu_[wavelength];
        if (!(r > 0)) return 0;
        if (!reflectance_.is_empty()) return at(0, wavelength);
        double sum = 0;
        for (const Arc& arc : light_.at(tau)) {
            if (phase_ == DepthPhase::vertical) {
                sum += closed(tau, arc, 2 * depth_, nu);
                continue;
            }
            const double from = r * std::sin(arc.from), to = r * std::sin(arc.to);
            for (int i = 0; i < kParts; ++i) {
                const double a = from + (to - from) * i / kParts,
                             b = from + (to - from) * (i + 1) / kParts, middle = (a + b) / 2;
                const double rise = std::sqrt(std::max(0.0, (r - middle) * (r + middle)));
                sum += groove_power(depth_ * (view_[2] + rise), nu) *
                       slit_integral(turn_of(a, nu), turn_of(b, nu)) / kPi;
            }
        }
        return sum;
    }

private:
    /// 2 pi W q nu of w_b
    double turn_of(double across, double nu) const {
        return kTwoPi * width_ * nu * (view_[1] + across);
    }

    double closed(double tau, const Arc& arc, double path_um, double nu) const {
        const double r = std::sqrt((1 - tau) * (1 + tau));
        return groove_power(path_um, nu) *
               slit_integral(turn_of(r * std::sin(arc.from), nu),
                             turn_of(r * std::sin(arc.to), nu)) /
               kPi;
    }

    void add_closed(double tau, const Arc& arc, std::span<double> sums) const {
        for (std::size_t i = 0; i < nu_.size(); ++i)
            sums[i] += closed(tau, arc, 2 * depth_, nu_[i]);
    }

    /// W nu int |d|^2 R sinc^2(pi W q nu) dq over psi, q = w_o.b + r sin psi.
    void add_points(double tau, const Arc& arc, std::span<double> sums) {
        constexpr double kTurn = 20;  // that 16 points integrate to 1e-12
        const double r = std::sqrt((1 - tau) * (1 + tau)), length = arc.to - arc.from;
        const double turn = kTwoPi * largest_nu_ * r * (width_ + depth_) * length;
        const int panels = 1 + static_cast<int>(turn / kTurn);
        const double half = length / (2 * panels);
        for (int panel = 0; panel < panels; ++panel)
            for (const GaussNode& node : gauss_legendre<16>())
                add_point(tau, r, arc.from + half * (2 * panel + 1 + node.x), half * node.weight,
                          sums);
    }

    void add_point(double tau, double r, double psi, double weight, std::span<double> sums) {
        const std::size_t size = nu_.size();
        const std::span<double> angle(angle_.data(), size), sine(sine_.data(), size),
            cosine(cosine_.data(), size), slit(slit_.data(), size);
        const double across = r * std::sin(psi), rise = r * std::cos(psi), q = view_[1] + across;
        for (std::size_t i = 0; i < size; ++i) angle[i] = kPi * width_ * q * nu_[i];
        sin_cos(angle, sine, cosine, best_simd_level());
        for (std::size_t i = 0; i < size; ++i) slit[i] = sinc_of(angle[i], sine[i]);
        const double path =
            phase_ == DepthPhase::vertical ? 2 * depth_ : depth_ * (view_[2] + rise);
        for (std::size_t i = 0; i < size; ++i) angle[i] = kPi * path * nu_[i];
        sin_cos(angle, sine, cosine, best_simd_level());
        const double scale = 4 * width_ * rise * weight;
        for (std::size_t i = 0; i < size; ++i) {
            const double amplitude = slit[i] * sine[i];
            slit[i] = scale * nu_[i] * amplitude * amplitude;
        }
        if (!reflectance_.is_empty()) {
            const double both = tau * view_[0] + across * view_[1] + rise * view_[2];
            const double half = std::sqrt(std::clamp((1 + both) / 2, 0.0, 1.0));
            if (size == 1)
                angle[0] = reflectance_(half, offset_);
            else
                reflectance_.at(half, angle, work_);
            for (std::size_t i = 0; i < size; ++i) slit[i] *= angle[i];
        }
        for (std::size_t i = 0; i < size; ++i) sums[i] += slit[i];
    }

    const LightSlices& light_;
    DepthPhase phase_;
    const CosineSeries& reflectance_;
    double width_, depth_, largest_nu_ = 0;
    std::span<const double> nu_;
    std::size_t offset_ = 0;  ///< of a single wavelength among those of the reflectance
    UnitVector view_{};
    std::vector<double> angle_, sine_, cosine_, slit_, work_;
};

/// A smooth piece of the integral along the scratch: xi_1 = middle + half sin(phi), which takes
/// the square roots away with which a light begins and ends.
struct SmoothPiece {
    double middle, half, from, to;  ///< of phi
};

/// Pieces of 16 points, halved where the last two of their Legendre coefficients, squared over the
/// largest value as the error of Gauss's rule falls, do not say that the integral is known.
class AlongIntegral {
public:
    AlongIntegral(AcrossIntegral& across, const LobeTable& lobe, std::span<const double> per_xi1,
                  std::span<const double> whole)
        : across_(across),
          lobe_(lobe),
          per_xi1_(per_xi1),
          whole_(whole),
          values_(across.size()),
          last_(across.size()),
          before_last_(across.size()),
          largest_(across.size()),
          at_(across.size()),
          power_(across.size()) {}

    std::vector<double> over(std::vector<SmoothPiece> pieces) {
        constexpr int kMostRounds = 12;
        std::vector<double> sum(across_.size(), 0.0), estimate = sum;
        std::vector<SmoothPiece> next;
        for (int round = 0; !pieces.empty(); ++round, pieces.swap(next), next.clear()) {
            if (round == 0 && whole_.empty())  // nothing else to measure by
                for (const SmoothPiece& piece : pieces) {
                    evaluate(piece);
                    for (std::size_t i = 0; i < sum.size(); ++i) estimate[i] += values_[i];
                }
            for (const SmoothPiece& piece : pieces) {
                evaluate(piece);
                if (round == kMostRounds || is_good(estimate)) {
                    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += values_[i];
                    continue;
                }
                SmoothPiece one = piece, two = piece;
                one.to = two.from = piece.from + (piece.to - piece.from) / 2;
                next.insert(next.end(), {one, two});
            }
        }
        return sum;
    }

private:
    /// P_14 and P_15 at the points, times (2 n + 1)/2 and their weights.
    struct Legendre {
        std::array<double, 16> before_last{}, last{};
        Legendre() {
            for (std::size_t j = 0; j < last.size(); ++j) {
                const GaussNode& node = gauss_legendre<16>()[j];
                double p = 1, before = 0;
                for (int n = 0; n < 15; ++n) {
                    const double up = ((2 * n + 1) * node.x * p - n * before) / (n + 1);
                    before = p;
                    p = up;
                }
                before_last[j] = 14.5 * before * node.weight;
                last[j] = 15.5 * p * node.weight;
            }
        }
    };

    void evaluate(const SmoothPiece& piece) {
        static const Legendre legendre;
        for (auto* const row : {&values_, &last_, &before_last_, &largest_})
            std::ranges::fill(*row, 0.0);
        const double half = (piece.to - piece.from) / 2, middle = piece.from + half;
        for (std::size_t j = 0; j < legendre.last.size(); ++j) {
            const GaussNode& node = gauss_legendre<16>()[j];
            const double phi = middle + half * node.x;
            const double xi1 = piece.middle + piece.half * std::sin(phi);
            const double scale = half * piece.half * std::cos(phi);
            bool is_dark = true;
            for (std::size_t i = 0; i < power_.size(); ++i) {
                power_[i] = scale * lobe_(per_xi1_[i] * xi1);
                is_dark = is_dark && power_[i] == 0;
            }
            if (is_dark || !across_.at(xi1, at_)) continue;
            for (std::size_t i = 0; i < power_.size(); ++i) {
                const double value = power_[i] * at_[i];
                values_[i] += node.weight * value;
                last_[i] += legendre.last[j] * value;
                before_last_[i] += legendre.before_last[j] * value;
                largest_[i] = std::max(largest_[i], value);
            }
        }
    }

    bool is_good(const std::vector<double>& estimate) const {
        constexpr double kSafety = 10;
        for (std::size_t i = 0; i < values_.size(); ++i) {
            if (!(largest_[i] > 0)) continue;
            const double rest = std::abs(last_[i]) + std::abs(before_last_[i]);
            const double error = rest * std::min(1.0, kSafety * rest / largest_[i]);
            const double by = whole_.empty() ? estimate[i] : std::max(whole_[i], values_[i]);
            if (error > kRelativeError * by) return false;
        }
        return true;
    }

    AcrossIntegral& across_;
    const LobeTable& lobe_;
    std::span<const double> per_xi1_, whole_;
    std::vector<double> values_, last_, before_last_, largest_, at_, power_;
};

/// Between the light's breaks where the scratch's lobe counts; far from its middle, where ends
/// reflect, pieces grow.
std::vector<SmoothPiece> smooth_pieces(bool has_ends, const LightSlices& light, double view_along,
                                       double per_xi1, double least_per_xi1) {
    constexpr double kReach = 6.5, kFirstLength = 3.25;  // of y = sigma k xi_1
    constexpr double kGrowth = 3;                        // of a piece's end over its beginning
    const std::span<const double> breaks = light.breaks();
    const double first = breaks.front() + view_along, last = breaks.back() + view_along;
    const double nearest = first > 0 ? first : last < 0 ? -last : 0;
    const double limit = has_ends ? 3 : std::hypot(nearest, kReach / least_per_xi1);
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
            // from outside inwards most of the way, from inside outwards twice as far again
            const double length = y < -kReach  ? std::max(kFirstLength, -y * (1 - 1 / kGrowth))
                                  : y > kReach ? y * (kGrowth - 1)
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

std::vector<double> light_ratios(const VisibleScratch& scratch, const LitView& lit,
                                 std::span<const double> wavenumber_per_um,
                                 const LightIntegral& method, const CosineSeries& reflectance,
                                 const LobeTable& lobe, std::span<const double> whole) {
    constexpr double kLeast = 1e-4, kMost = 1e3;
    std::vector<double> ratios(wavenumber_per_um.size(), 0.0), per_xi1;
    if (ratios.empty() || lit.light.breaks().empty()) return ratios;
    for (const double nu : wavenumber_per_um) {
        require_in_range("wavenumber_per_um", nu, kLeast, kMost);
        per_xi1.push_back(kTwoPi * scratch.coherence_radius_um() * nu);
    }
    AcrossIntegral across(scratch, lit, wavenumber_per_um, reflectance);
    const double along = across.view_along();
    if (method.kind == LightIntegral::Kind::band) {
        for (std::size_t i = 0; i < ratios.size(); ++i)
            ratios[i] = scratch.share() * across.on_band(i);
        return ratios;
    }
    if (method.kind == LightIntegral::Kind::points) {
        const std::vector<RulePoint> rule = legendre_rule(method.points);
        for (std::size_t i = 0; i < ratios.size(); ++i) {
            const double first = std::erf(per_xi1[i] * (lit.light.breaks().front() + along)),
                         last = std::erf(per_xi1[i] * (lit.light.breaks().back() + along));
            if (first == last) continue;
            for (const RulePoint& point : rule) {
                const double e = (first + last) / 2 + (last - first) / 2 * point.x;
                if (std::abs(e) >= 1) continue;
                ratios[i] += point.weight * across.at(boost::math::erf_inv(e) / per_xi1[i], i);
            }
            ratios[i] *= scratch.share() * (last - first) / 4;
        }
        return ratios;
    }
    const auto [least, most] = std::ranges::minmax(per_xi1);
    const double width = scratch.scratch().width_um / (kPi * scratch.coherence_radius_um());
    std::vector<double> part(whole.begin(), whole.end());
    for (std::size_t i = 0; i < part.size(); ++i) part[i] /= width * per_xi1[i];
    ratios = AlongIntegral(across, lobe, per_xi1, part)
                 .over(smooth_pieces(lobe.has_ends(), lit.light, along, most, least));
    for (std::size_t i = 0; i < ratios.size(); ++i) ratios[i] *= width * per_xi1[i];
    return ratios;
}

double light_ratio(const VisibleScratch& scratch, const LightSlices& light, DepthPhase phase,
                   const UnitVector& view, double wavelength_um, const LightIntegral& method) {
    constexpr double kShortest_um = 1e-3, kLongest_um = 1e4;
    require_in_range("wavelength_um", wavelength_um, kShortest_um, kLongest_um);
    const std::array nu{1 / wavelength_um};
    const LobeTable lobe = lobe_under(scratch, light, view, wavelength_um);
    return light_ratios(scratch, {light, phase, view}, nu, method, {}, lobe)[0];
}

}  // namespace irido
