#include "core/colorimetry/sensitivity.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/keep_once.hpp"
#include "core/material/linear_value.hpp"
#include "core/math/gauss.hpp"
#include "core/math/transform.hpp"

namespace irido {

namespace {

constexpr double kObserverLast_nm = kFirstRow_nm + static_cast<double>(kObserverRows - 1);

double linear(std::span<const double> value, double position) {
    const auto last = static_cast<double>(value.size() - 1);
    const double row = std::clamp(std::floor(position), 0.0, last - 1);
    const auto i = static_cast<std::size_t>(row);
    return value[i] + (position - row) * (value[i + 1] - value[i]);
}

/// Integral over the cells, by a rule that is exact for piecewise cubics.
Triple integrate_cells(const Sensitivity& sensitivity, const std::vector<double>& cells) {
    Triple sum{};
    for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
        const double half = (cells[i + 1] - cells[i]) / 2, middle = (cells[i + 1] + cells[i]) / 2;
        for (const GaussNode& node : gauss_legendre<2>()) {
            const Triple s = sensitivity.at(middle + half * node.x);
            for (std::size_t c = 0; c < 3; ++c) sum[c] += half * node.weight * s[c];
        }
    }
    return sum;
}

}  // namespace

Sensitivity::Sensitivity(const Observer& observer, const Table& illuminant)
    : observer_(observer), illuminant_(illuminant) {
    const auto& rows = illuminant_.wavelength_nm;
    support_ = {std::max(kFirstRow_nm, rows.front()), std::min(kObserverLast_nm, rows.back())};
    if (!(support_.first_nm < support_.last_nm))
        throw DomainError("the illuminant must overlap 360 to 830 nm (got " +
                          to_text(rows.front()) + " to " + to_text(rows.back()) + " nm)");
    for (std::size_t i = 0; i < kObserverRows; ++i)
        rows_.push_back(kFirstRow_nm + static_cast<double>(i));
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    keep_once(rows_);
    const double luminance = integral(support_)[1];
    if (!(luminance > 0))
        throw DomainError("the illuminant must have power where the observer sees it");
    normalization_ = 1 / luminance;
    white_ = integral(support_);
    white_[1] = 1;
}

Triple Sensitivity::at(double wavelength_nm) const {
    const double s = normalization_ * linear_value(illuminant_, wavelength_nm);
    const double row = wavelength_nm - kFirstRow_nm;
    return {s * linear(observer_.x, row), s * linear(observer_.y, row),
            s * linear(observer_.z, row)};
}

std::vector<double> Sensitivity::cells(WavelengthRange part) const {
    std::vector<double> result{part.first_nm};
    const auto from = std::ranges::upper_bound(rows_, part.first_nm);
    const auto to = std::ranges::lower_bound(rows_, part.last_nm);
    if (from < to) result.insert(result.end(), from, to);
    result.push_back(part.last_nm);
    return result;
}

Triple Sensitivity::integral(WavelengthRange part) const {
    return integrate_cells(*this, cells(part));
}

namespace {

/// Maps the panel to x in [-1, 1], linear in 1/lambda: x = 1 at its short end, -1 at its long end.
struct PanelMap {
    WavelengthRange panel;
    double middle, half;

    explicit PanelMap(WavelengthRange p)
        : panel(p),
          middle((1 / p.first_nm + 1 / p.last_nm) / 2),
          half((1 / p.first_nm - 1 / p.last_nm) / 2) {}
    double x(double wavelength_nm) const {
        return std::clamp((1 / wavelength_nm - middle) / half, -1.0, 1.0);
    }
    double wavelength_nm(double x) const {
        return std::clamp(1 / (middle + half * x), panel.first_nm, panel.last_nm);
    }
};

/// Sample points of the moment integrals: x, and the integrand's weight there.
struct Samples {
    std::vector<double> x;
    std::array<std::vector<double>, 3> weight;
};

template <int count>
void add_samples(const Sensitivity& sensitivity, const PanelMap& map, double first, double last,
                 Samples& samples) {
    const double half = (last - first) / 2, middle = (last + first) / 2;
    for (const GaussNode& node : gauss_legendre<count>()) {
        const double wavelength = middle + half * node.x;
        const Triple s = sensitivity.at(wavelength);
        samples.x.push_back(map.x(wavelength));
        for (std::size_t c = 0; c < 3; ++c) samples.weight[c].push_back(half * node.weight * s[c]);
    }
}

/// Gauss points in each cell, as many as the fastest polynomial needs: T_n(cos phi) advances by n
/// dphi radians over a piece. Errors of the three rules at their limits: 1e-12, 2e-15, 1e-19.
Samples moment_samples(const Sensitivity& sensitivity, const PanelMap& map, std::size_t degree) {
    const std::vector<double> cells = sensitivity.cells(map.panel);
    Samples samples;
    const std::size_t about = 4 * cells.size() + 2 * degree;
    samples.x.reserve(about);
    for (std::vector<double>& weight : samples.weight) weight.reserve(about);
    double first = cells.front(), phi_first = 0;
    for (std::size_t i = 1; i < cells.size(); ++i) {
        const double phi_last =
            i + 1 == cells.size() ? std::numbers::pi : std::acos(map.x(cells[i]));
        const double turn = static_cast<double>(degree) * (phi_last - phi_first);
        if (turn <= 0.5) {
            add_samples<4>(sensitivity, map, first, cells[i], samples);
        } else if (turn <= 3) {
            add_samples<8>(sensitivity, map, first, cells[i], samples);
        } else {
            const int pieces = static_cast<int>(std::ceil(turn / 12));
            double from = first;
            for (int k = 1; k <= pieces; ++k) {
                const double phi = phi_first + (phi_last - phi_first) * k / pieces;
                const double to = k == pieces ? cells[i] : map.wavelength_nm(std::cos(phi));
                add_samples<16>(sensitivity, map, from, to, samples);
                from = to;
            }
        }
        first = cells[i];
        phi_first = phi_last;
    }
    return samples;
}

/// Sum over samples of weight T_k(x), k = 0 .. degree.
void integrate_moments(const Samples& samples, std::size_t degree, PanelRule& rule) {
    const auto count = static_cast<Eigen::Index>(samples.x.size());
    const auto vector = [count](const std::vector<double>& v) {
        return Eigen::Map<const Eigen::ArrayXd>(v.data(), count);
    };
    const Eigen::ArrayXd twice_x = 2 * vector(samples.x);
    Eigen::ArrayXd before = Eigen::ArrayXd::Ones(count), now = vector(samples.x), next;
    for (std::size_t k = 0; k <= degree; ++k) {
        for (std::size_t c = 0; c < 3; ++c)
            rule.moment[c][k] = (vector(samples.weight[c]) * before).sum();
        next = twice_x * now - before;
        before.swap(now);
        now.swap(next);
    }
}

}  // namespace

PanelRule panel_rule(const Sensitivity& sensitivity, WavelengthRange panel, std::size_t degree) {
    const PanelMap map(panel);
    PanelRule rule;
    rule.x.reserve(degree + 1);
    rule.wavelength_nm.reserve(degree + 1);
    for (std::size_t j = 0; j <= degree; ++j) {
        rule.x.push_back(
            std::cos(std::numbers::pi * static_cast<double>(j) / static_cast<double>(degree)));
        rule.wavelength_nm.push_back(map.wavelength_nm(rule.x.back()));
    }
    rule.wavelength_nm.front() = panel.first_nm;
    rule.wavelength_nm.back() = panel.last_nm;
    for (std::size_t c = 0; c < 3; ++c) {
        rule.moment[c].resize(degree + 1);
        rule.weight[c].resize(degree + 1);
    }
    integrate_moments(moment_samples(sensitivity, map, degree), degree, rule);
    for (std::size_t c = 0; c < 3; ++c) chebyshev_transform(degree)(rule.moment[c], rule.weight[c]);
    return rule;
}

SampleRule equal_rule(const Sensitivity& sensitivity, std::size_t count) {
    require_in_range("equal wavelengths", static_cast<double>(count), 2, 1e6);
    const auto [first, last] = sensitivity.support();
    SampleRule rule;
    for (std::size_t i = 0; i < count; ++i) {
        const double wavelength = i + 1 == count ? last
                                                 : first + (last - first) * static_cast<double>(i) /
                                                               static_cast<double>(count - 1);
        const bool is_end = i == 0 || i + 1 == count;
        const Triple s = sensitivity.at(wavelength);
        rule.wavelength_nm.push_back(wavelength);
        for (std::size_t c = 0; c < 3; ++c) rule.weight[c].push_back(is_end ? s[c] / 2 : s[c]);
    }
    for (const std::vector<double>& weight : rule.weight)
        if (!(*std::ranges::max_element(weight) > 0))
            throw DomainError("equal/N: N must be larger for this illuminant (got " +
                              std::to_string(count) + ")");
    return rule;
}

}  // namespace irido
