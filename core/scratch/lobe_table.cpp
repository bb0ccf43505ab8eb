#include "core/scratch/lobe_table.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/complex.hpp"
#include "core/math/constants.hpp"
#include "core/math/gauss.hpp"
#include "core/math/vector_math.hpp"

namespace irido {

namespace {

/// exp(-d^2/4) and exp(-t^2) beyond these are below 1e-15.
constexpr double kLongest = 12, kFarthest = 6.5;

/// The rule over d, on [0, 1], and what integrates from the end of a range up to its points a
/// function that is known at Chebyshev's points.
struct AlongRule {
    static constexpr std::size_t kPanels = 4, kPoints = kPanels * 24, kSamples = 40;

    std::array<double, kPoints> x{}, weight{};
    std::array<double, kSamples> sample{};
    std::array<std::array<double, kSamples>, kPoints> up_to{};

    AlongRule() {
        std::size_t i = 0;
        for (std::size_t panel = 0; panel < kPanels; ++panel)
            for (const GaussNode& node : gauss_legendre<24>()) {
                x[i] = (static_cast<double>(panel) + (1 + node.x) / 2) / kPanels;
                weight[i++] = node.weight / (2 * kPanels);
            }
        constexpr double n = kSamples;
        const auto angle = [](std::size_t j) { return kPi * (static_cast<double>(j) + 0.5) / n; };
        for (std::size_t j = 0; j < kSamples; ++j) sample[j] = (1 + std::cos(angle(j))) / 2;
        // int T_k = (T_(k+1)/(k + 1) - T_(k-1)/(k - 1))/2, from -1 on
        const auto integral = [](std::size_t k, double t) {
            const auto order = static_cast<double>(k);
            if (k == 0) return t + 1;
            if (k == 1) return (t * t - 1) / 2;
            const double turn = std::acos(t), sign = k % 2 == 0 ? -1 : 1;
            return (std::cos((order + 1) * turn) / (order + 1) -
                    std::cos((order - 1) * turn) / (order - 1)) /
                       2 -
                   sign * (1 / (order + 1) - 1 / (order - 1)) / 2;
        };
        for (std::size_t p = 0; p < kPoints; ++p) {
            const double t = 2 * x[p] - 1;
            for (std::size_t k = 0; k < kSamples; ++k) {
                const double part = (k == 0 ? 1 : 2) / n * integral(k, t) / 2;
                for (std::size_t j = 0; j < kSamples; ++j)
                    up_to[p][j] += part * std::cos(static_cast<double>(k) * angle(j));
            }
        }
    }

    static const AlongRule& get() {
        static const AlongRule rule;
        return rule;
    }
};

/// cos(k (j + 1/2) pi/n) of the transform to a panel's coefficients.
template <std::size_t n>
const std::array<std::array<double, n>, n>& panel_cosines() {
    static const auto table = [] {
        std::array<std::array<double, n>, n> cosines{};
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t j = 0; j < n; ++j)
                cosines[k][j] = std::cos(kPi * static_cast<double>(k) *
                                         (static_cast<double>(j) + 0.5) / static_cast<double>(n));
        return cosines;
    }();
    return table;
}

using Places = std::span<const VisibleScratch::Place>;

/// N at an end of all places.
double weight_up_to(Places places, double VisibleScratch::Place::*end) {
    double sum = 0;
    for (const auto& place : places)
        sum += place.weight * std::sqrt(kPi) / 2 * std::erf(place.*end);
    return sum;
}

/// B and its derivatives along the axis, at a point of it as each place sees it.
template <std::size_t size, class Of>
std::array<double, size> derivatives(Places places, const Of& seen_by) {
    std::array<double, size> sums{};
    for (const auto& place : places) {
        const double t = seen_by(place);
        if (!(std::abs(t) < kFarthest)) continue;
        double before = 0, value = place.weight * std::exp(-t * t);
        for (std::size_t k = 0; k < size; ++k) {
            sums[k] += value;
            const double next = -2 * (t * value + static_cast<double>(k) * before);
            before = value;
            value = next;
        }
    }
    return sums;
}

template <class Series>
Series product_of(const Series& a, const Series& b) {
    Series product{};
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; i + j < a.size(); ++j) product[i + j] += a[i] * b[j];
    return product;
}

/// Of exp(-d^2/4).
template <class Series>
Series bell_series() {
    Series series{};
    double term = 1;
    for (std::size_t k = 0; 2 * k < series.size(); ++k) {
        series[2 * k] = term;
        term *= -0.25 / static_cast<double>(k + 1);
    }
    return series;
}

/// Coefficients to derivatives, over pi.
template <class Series>
void make_derivatives(Series& series) {
    double factorial = 1 / kPi;
    for (std::size_t k = 0; k < series.size(); ++k) {
        series[k] *= factorial;
        factorial *= static_cast<double>(k + 1);
    }
}

}  // namespace

LobeTable::LobeTable(const VisibleScratch& scratch, double first, double last, double farthest_end)
    : scratch_(scratch),
      has_ends_(scratch.has_ends() && scratch.ends_within(farthest_end)),
      first_(first),
      last_(first < last ? last : -1) {
    if (!has_ends_ || !(first < last)) return;
    const VisibleScratch::Place& place = scratch.places().front();
    length_ = std::min(kInfiniteLength, place.end - place.start);
    if (last > kFar) add_series();
    if (first < kFar) add_panels();
}

void LobeTable::add_series() {
    const Places places = scratch_.places();
    using End = double VisibleScratch::Place::*;
    for (const auto& signed_end : {std::pair<End, double>(&VisibleScratch::Place::end, 1),
                                   std::pair<End, double>(&VisibleScratch::Place::start, -1)}) {
        const End end = signed_end.first;
        const double sign = signed_end.second;
        const auto slopes = derivatives<kTerms>(places, [&](const auto& one) { return one.*end; });
        at_zero_[0] += sign * weight_up_to(places, end);
        double scale = sign;
        for (std::size_t k = 1; k <= kTerms; ++k) {
            scale *= -0.5 * sign / static_cast<double>(k);
            at_zero_[k] += scale * slopes[k - 1];
        }
    }
    at_zero_ = product_of(at_zero_, bell_series<Taylor>());
    make_derivatives(at_zero_);
    if (!(length_ < kLongest)) return;
    // at d = L - t: exp(-L^2/4) exp(L t/2 - t^2/4) [N(m + t/2) - N(m - t/2)]
    const auto slopes = derivatives<kTerms>(
        places, [](const auto& one) { return one.start + (one.end - one.start) / 2; });
    double scale = 2, tilt = std::exp(-length_ * length_ / 4);
    Taylor rise{};
    for (std::size_t k = 1; k <= kTerms; ++k) {
        scale *= 0.5 / static_cast<double>(k);
        if (k % 2 == 1) at_length_[k] = scale * slopes[k - 1];
    }
    for (std::size_t k = 0; k <= kTerms; ++k) {
        rise[k] = tilt;
        tilt *= length_ / 2 / static_cast<double>(k + 1);
    }
    at_length_ = product_of(product_of(at_length_, rise), bell_series<Taylor>());
    make_derivatives(at_length_);
}

void LobeTable::add_panels() {
    const AlongRule& rule = AlongRule::get();
    const Places places = scratch_.places();
    const double reach = std::min(length_, kLongest);
    const auto weights = [&](double VisibleScratch::Place::*end, double direction) {
        std::array<double, AlongRule::kSamples> along{};
        for (const auto& place : places)
            for (std::size_t j = 0; j < along.size(); ++j) {
                const double t = place.*end + direction * reach / 2 * rule.sample[j];
                if (std::abs(t) < kFarthest) along[j] += place.weight * std::exp(-t * t);
            }
        const double whole = weight_up_to(places, end);
        std::array<double, AlongRule::kPoints> result{};
        for (std::size_t i = 0; i < result.size(); ++i) {
            double sum = 0;
            for (std::size_t j = 0; j < along.size(); ++j) sum += rule.up_to[i][j] * along[j];
            result[i] = whole + direction * reach / 2 * sum;
        }
        return result;
    };
    const auto at_end = weights(&VisibleScratch::Place::end, -1),
               at_start = weights(&VisibleScratch::Place::start, 1);
    std::array<double, AlongRule::kPoints> integrand{};
    for (std::size_t i = 0; i < integrand.size(); ++i) {
        const double d = reach * rule.x[i];
        integrand[i] =
            rule.weight[i] * reach * std::exp(-d * d / 4) * (at_end[i] - at_start[i]) / kPi;
    }
    constexpr double kPanel = 2;
    const double last = std::min(last_, kFar);
    const double count = std::max(1.0, std::ceil((last - first_) / kPanel));
    panel_ = (last - first_) / count;
    const auto& cosines = panel_cosines<kNodes>();
    std::array<double, AlongRule::kPoints> angle{}, sine{}, cosine{};
    for (double panel = 0; panel < count; ++panel) {
        std::array<double, kNodes> values{};
        for (std::size_t j = 0; j < kNodes; ++j) {
            const double y = first_ + panel_ * (panel + (1 + cosines[1][j]) / 2);
            for (std::size_t i = 0; i < angle.size(); ++i) angle[i] = y * reach * rule.x[i];
            sin_cos(angle, sine, cosine, best_simd_level());
            for (std::size_t i = 0; i < angle.size(); ++i) values[j] += integrand[i] * cosine[i];
        }
        std::array<double, kNodes>& coefficients = panels_.emplace_back();
        for (std::size_t k = 0; k < kNodes; ++k) {
            for (std::size_t j = 0; j < kNodes; ++j) coefficients[k] += values[j] * cosines[k][j];
            coefficients[k] *= (k == 0 ? 1 : 2) / static_cast<double>(kNodes);
        }
    }
}

double LobeTable::near(double size) const {
    const double place = (size - first_) / panel_;
    const double panel =
        std::clamp(std::floor(place), 0.0, static_cast<double>(panels_.size() - 1));
    const std::array<double, kNodes>& coefficients = panels_[static_cast<std::size_t>(panel)];
    const double x = std::clamp(2 * (place - panel) - 1, -1.0, 1.0);
    double one = 0, two = 0;
    for (std::size_t k = kNodes - 1; k > 0; --k) {
        const double value = 2 * x * one - two + coefficients[k];
        two = one;
        one = value;
    }
    return x * one - two + coefficients[0];
}

/// By parts: -g'(0)/y^2 + g'''(0)/y^4 - ..., and Re[exp(i y L) sum of h^(k)(0)/(i y)^(k+1)] with
/// h(t) = g(L - t).
double LobeTable::far(double size) const {
    const double z = -1 / (size * size);
    double sum = 0;
    for (std::size_t k = kTerms; k > 0; k -= 2) sum = (sum + at_zero_[k - 1]) * z;
    if (!(length_ < kLongest)) return sum;
    double even = 0, odd = 0;  // of 1/(i y)^(k+1) with k odd: real, with k even: -i/y z^(k/2)
    for (std::size_t k = kTerms; k > 0; k -= 2) {
        odd = (odd + at_length_[k - 1]) * z;
        even = even * z + at_length_[k - 2];
    }
    return sum + odd * std::cos(size * length_) + even / size * std::sin(size * length_);
}

double LobeTable::operator()(double y) const {
    const double size = std::abs(y);
    if (!has_ends_) return scratch_.weight() * std::exp(-y * y);
    if (!(size >= first_ && size <= last_)) return scratch_.power(y);
    return size < kFar ? near(size) : far(size);
}

}  // namespace irido
