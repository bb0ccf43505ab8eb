#include "core/color/quadrature/hidden_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/color/quadrature/panel_sums.hpp"
#include "core/complex.hpp"
#include "core/math/transform.hpp"

namespace irido {

namespace {

/// A denominator's zero within this many point spacings of a point is not resolved: poles further
/// off make coefficients that fall steadily, and the tail sees them.
constexpr double kFarFromZero = 1 / 1.5;

/// Part of what a line's foot is to first order, against its bound, before that is a coincidence.
constexpr double kCoincidence = 0.01;

/// |a| < factor |b|, by squares where these decide it: roots take long.
bool is_smaller(Complex a, Complex b, double factor) {
    const double a2 = std::norm(a), b2 = std::norm(b) * factor * factor;
    constexpr double kSmall = 1e-250, kLarge = 1e250, kClose = 1e-9;
    if (a2 > kSmall && a2 < kLarge && b2 > kSmall && b2 < kLarge && std::abs(a2 - b2) > kClose * b2)
        return a2 < b2;
    return std::abs(a) < factor * std::abs(b);
}

}  // namespace

const std::vector<double>& slope_rows(std::size_t degree) {
    static const auto all = [] {
        std::array<std::vector<double>, kDegrees.size()> rows;
        for (std::size_t d = 0; d < kDegrees.size(); ++d)
            rows[d] = chebyshev_slopes(kDegrees[d], whole_vectors(kDegrees[d] + 1));
        return rows;
    }();
    return all[degree];
}

void mark_hidden_zeros(const QuadratureRule& rule, std::array<const double*, 2> parts,
                       std::array<const double*, 2> slopes, std::vector<bool>& marked) {
    const std::vector<double>& x = rule.x;
    for (std::size_t j = 0; j < rule.points; ++j) {
        const double before = j > 0 ? x[j - 1] - x[j] : 0;
        const double spacing = std::max(before, j + 1 < rule.points ? x[j] - x[j + 1] : 0);
        marked[j] = marked[j] || is_smaller({parts[0][j], parts[1][j]},
                                            {slopes[0][j], slopes[1][j]}, kFarFromZero * spacing);
    }
}

void mark_hidden_zeros(const QuadratureRule& rule, std::span<const double> slope_rows,
                       const Denominator& d, SimdLevel simd, DenominatorSlopes& memory,
                       std::vector<bool>& marked) {
    const double first = d.log_scale.front(), last = d.log_scale.back();
    const bool has_scale = std::ranges::any_of(d.log_scale, [](double l) { return l != 0; });
    auto& [parts, slopes] = memory;
    for (std::size_t part = 0; part < 2; ++part) {
        parts[part].assign(rule.stride, 0);
        slopes[part].resize(rule.points);
    }
    for (std::size_t j = 0; j < rule.points; ++j) {
        const double trend = (first + last) / 2 + (first - last) / 2 * rule.x[j];
        const double scale =
            has_scale ? std::exp(std::clamp(d.log_scale[j] - trend, -300.0, 300.0)) : 1;
        parts[0][j] = d.re[j] * scale;
        parts[1][j] = d.im[j] * scale;
    }
    for (std::size_t part = 0; part < 2; ++part)
        row_sums(slope_rows.data(), rule.points, rule.stride, parts[part].data(), parts[part][0],
                 slopes[part].data(), simd);
    mark_hidden_zeros(rule, {parts[0].data(), parts[1].data()},
                      {slopes[0].data(), slopes[1].data()}, marked);
}

double hidden_share(double foot, double value) {
    const double first_order = kCoincidence * std::abs(value * (1 - value));
    const double width = foot < first_order * first_order ? foot / first_order : std::sqrt(foot);
    return std::min(1.0, std::numbers::pi * width);
}

}  // namespace irido
