#include "core/scratch/rough_base.hpp"

#include "core/error.hpp"
#include "core/math/gauss.hpp"
#include "core/rough/ggx.hpp"
#include "core/scratch/vectors.hpp"

namespace irido {

namespace {

double cosine_of_half(double between) {
    return std::sqrt(std::clamp((1 + between) / 2, 0.0, 1.0));
}

/// [from, to] cut at a centre and at distances from it that grow fourfold from a scale on, by which
/// a function that is smooth on that scale about the centre, and further off on the scale of the
/// distance, is one for 16 points on every piece.
std::vector<double> graded_cuts(double from, double to, double center, double scale) {
    constexpr double kGrowth = 4;
    std::vector<double> cuts{from};
    const auto add = [&](double at) {
        if (at > cuts.back() && at < to) cuts.push_back(at);
    };
    const double reach = std::max(std::abs(from - center), std::abs(to - center));
    double far = scale;
    while (far < reach) far *= kGrowth;
    for (; far > 0.5 * scale; far /= kGrowth) add(center - far);
    add(center);
    for (far = scale; far < reach; far *= kGrowth) add(center + far);
    cuts.push_back(to);
    return cuts;
}

/// Moments of T_k(x) over the directions of a light, x the cosine's place in its range.
class FacetIntegral {
public:
    FacetIntegral(double alpha, const LightCone& light, const UnitVector& view,
                  const CosineRange& range)
        : alpha_(alpha), view_(view), range_(range), slices_(light, tangent_of(view)) {
        const auto [tx, ty] = tangent_of(view);
        across_ = view[1] * tx - view[0] * ty;
    }

    FacetWeights moments() const {
        FacetWeights sum{};
        const std::span<const double> breaks = slices_.breaks();
        std::vector<Piece> pieces;
        for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
            const double half = (breaks[i + 1] - breaks[i]) / 2, middle = breaks[i] + half;
            const auto cuts = graded_cuts(breaks[i], breaks[i + 1], 0, 2 * alpha_ * view_[2]);
            for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
                const auto phi_of = [&](double tau) {
                    return std::asin(std::clamp((tau - middle) / half, -1.0, 1.0));
                };
                pieces.push_back({middle, half, phi_of(cuts[k]), phi_of(cuts[k + 1]), {}});
                pieces.back().value = over(pieces.back());
            }
        }
        double estimate = 0;
        for (const Piece& piece : pieces) estimate += piece.value[0];
        for (const Piece& piece : pieces) add_refined(piece, estimate, 0, sum);
        return sum;
    }

private:
    /// tau = middle + half sin(phi), which takes away the square roots with which a light ends.
    struct Piece {
        double middle, half, from, to;
        FacetWeights value;
    };

    /// Across the plane of incidence.
    static std::array<double, 2> tangent_of(const UnitVector& view) {
        const double flat = std::hypot(view[0], view[1]);
        if (!(flat > 0)) return {1, 0};
        return {-view[1] / flat, view[0] / flat};
    }

    void add_refined(const Piece& whole, double estimate, int depth, FacetWeights& sum) const {
        constexpr double kRelative = 1e-9;
        constexpr int kDeepest = 10;
        Piece first = whole, second = whole;
        first.to = second.from = (whole.from + whole.to) / 2;
        first.value = over(first);
        second.value = over(second);
        const double off = std::abs(first.value[0] + second.value[0] - whole.value[0]);
        if (off > kRelative * estimate && depth < kDeepest) {
            add_refined(first, estimate, depth + 1, sum);
            add_refined(second, estimate, depth + 1, sum);
            return;
        }
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += first.value[k] + second.value[k];
    }

    FacetWeights over(const Piece& piece) const {
        const double half = (piece.to - piece.from) / 2, middle = piece.from + half;
        FacetWeights sum{};
        for (const GaussNode& node : gauss_legendre<16>()) {
            const double phi = middle + half * node.x;
            add_slice(piece.middle + piece.half * std::sin(phi),
                      node.weight * half * piece.half * std::cos(phi), sum);
        }
        return sum;
    }

    void add_slice(double tau, double weight, FacetWeights& sum) const {
        const double r = std::sqrt((1 - tau) * (1 + tau));
        if (!(r > 0)) return;
        const double peak = std::asin(std::clamp(-across_ / r, -1.0, 1.0));
        const double scale = 2 * std::hypot(alpha_, tau / (2 * view_[2]));
        for (const Arc& arc : slices_.at(tau)) {
            const auto cuts = graded_cuts(arc.from, arc.to, peak, scale);
            for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
                const double half = (cuts[k + 1] - cuts[k]) / 2, middle = cuts[k] + half;
                for (const GaussNode& node : gauss_legendre<16>())
                    add_point(r, middle + half * node.x, weight * half * node.weight, sum);
            }
        }
    }

    void add_point(double r, double psi, double weight, FacetWeights& sum) const {
        const double across = r * std::sin(psi), rise = r * std::cos(psi);
        if (!(rise > 0)) return;
        const double half = cosine_of_half(across * across_ + rise * view_[2]);
        if (!(half > 0)) return;
        const double facets =
            ggx_distribution(alpha_, std::min(1.0, (rise + view_[2]) / (2 * half))) *
            smith_masking(alpha_, rise) * smith_masking(alpha_, view_[2]) / (4 * view_[2]);
        const double value = weight * facets;
        const double x = std::clamp(
            (2 * half - range_.low - range_.high) / (range_.high - range_.low), -1.0, 1.0);
        double before = value, now = value * x;
        sum[0] += before;
        for (std::size_t k = 1; k < sum.size(); ++k) {
            sum[k] += now;
            const double next = 2 * x * now - before;
            before = now;
            now = next;
        }
    }

    double alpha_;
    UnitVector view_;
    CosineRange range_;
    LightSlices slices_;
    double across_ = 0;  ///< of the view; along tau it has none
};

}  // namespace

double facet_brdf(double alpha, const UnitVector& light, const UnitVector& view) {
    const double i = light[2], o = view[2];
    if (!(i > 0) || !(o > 0)) return 0;
    const double half = cosine_of_half(dot(light, view));
    if (!(half > 0)) return 0;
    return ggx_distribution(alpha, std::min(1.0, (i + o) / (2 * half))) * smith_masking(alpha, i) *
           smith_masking(alpha, o) / (4 * i * o);
}

CosineRange half_cosines(const LightCone& light, const UnitVector& view) {
    constexpr double kLeast = 1e-6;
    const double between = std::acos(std::clamp(dot(light.bound().normal, view), -1.0, 1.0)),
                 reach = std::acos(std::clamp(light.bound().least, -1.0, 1.0));
    const double low = std::cos(std::min(kPi, between + reach) / 2),
                 high = std::cos(std::max(0.0, between - reach) / 2);
    return {std::max(0.0, low - kLeast), std::min(1.0, high + kLeast)};
}

FacetWeights facet_weights(double alpha, const LightCone& light, const UnitVector& view,
                           const CosineRange& range) {
    require_in_range("alpha", alpha, kSmoothest, kRoughest);
    FacetWeights weights{};
    if (!(view[2] > 0)) return weights;
    const FacetWeights moments = FacetIntegral(alpha, light, view, range).moments();
    for (std::size_t j = 0; j < weights.size(); ++j)
        for (std::size_t k = 0; k < moments.size(); ++k)
            weights[j] +=
                (k == 0 ? 1.0 : 2.0) / CosineSeries::kCount * moments[k] * CosineSeries::wave(k, j);
    return weights;
}

}  // namespace irido
