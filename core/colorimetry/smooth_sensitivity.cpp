#include "core/colorimetry/smooth_sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/colorimetry/sensitivity_transform.hpp"
#include "core/error.hpp"
#include "core/math/transform.hpp"

namespace irido {

namespace {

/// Rows per period of the fastest wave kept.
constexpr double kOversampling = 6;

/// Width treated as one period of nu, relative to the support.
constexpr double kPeriod = 1.2;

/// Relative tolerance for rounding of nu computed from reach().
constexpr double kSmoothRounding = 1e-14;

/// Extra rows at either end of the period, for cubic interpolation.
constexpr std::size_t kMoreRows = 4;

struct Wavenumbers {
    double low, high, middle, period;
};

Wavenumbers wavenumbers(const Sensitivity& sensitivity) {
    const double low = 1 / sensitivity.support().last_nm;
    const double high = 1 / sensitivity.support().first_nm;
    return {low, high, (low + high) / 2, kPeriod * (high - low)};
}

/// H_j(k / period), k = 0 .. count - 1, with the phase referred to the middle of the support.
std::vector<std::vector<Complex>> harmonics(const Sensitivity& sensitivity, const Wavenumbers& nu,
                                            std::size_t count) {
    const double longest = static_cast<double>(count) / nu.period;
    const SensitivityPoints points = sensitivity_points(sensitivity, longest);
    std::vector<double> turns;
    turns.reserve(points.wavenumber.size());
    for (const double at : points.wavenumber) turns.push_back((at - nu.middle) / nu.period);
    return transform_of_points(turns, points.weight, count);
}

/// Low-pass response: 1 up to kFlat of the cut-off, 0 beyond the cut-off.
double pass(double share) {
    if (share <= SmoothSensitivity::kFlat) return 1;
    if (share >= 1) return 0;
    const double x = (share - SmoothSensitivity::kFlat) / (1 - SmoothSensitivity::kFlat);
    return std::erfc(6 * (x - 0.5)) / 2;
}

}  // namespace

SmoothSensitivity::SmoothSensitivity(const Sensitivity& sensitivity, double opd_nm) : opd_(opd_nm) {
    require_in_range("opd_nm", opd_nm, 1e3, 1e7);
    const Wavenumbers nu = wavenumbers(sensitivity);
    const double tail = kTail * (nu.high - nu.low);
    reach_ = {nu.low - tail, nu.high + tail};
    const auto count = static_cast<std::size_t>(std::ceil(opd_nm * nu.period)) + 1;
    const std::vector<std::vector<Complex>> H = harmonics(sensitivity, nu, count);
    // one period of rows: the sum over k at every row is the same transform of points k / rows
    const auto rows = static_cast<std::size_t>(std::ceil(kOversampling * opd_nm * nu.period));
    std::vector<double> turns(count);
    std::vector<std::vector<double>> parts(6, std::vector<double>(count));
    for (std::size_t k = 0; k < count; ++k) {
        const auto order = static_cast<double>(k);
        turns[k] = order / static_cast<double>(rows);
        const double factor = (k == 0 ? 1 : 2) * pass(order / nu.period / opd_nm) / nu.period;
        for (std::size_t c = 0; c < 3; ++c) {
            parts[2 * c][k] = factor * H[c][k].real();
            parts[2 * c + 1][k] = factor * H[c][k].imag();
        }
    }
    const std::vector<std::vector<Complex>> sums = transform_of_points(turns, parts, rows);
    per_nu_ = static_cast<double>(rows) / nu.period;
    const std::size_t before = rows / 2 + kMoreRows;  // rows below the middle
    first_ = nu.middle - static_cast<double>(before) / per_nu_;
    rows_.resize(rows + 2 * kMoreRows);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const std::size_t place = (i + 2 * rows - before) % rows;
        for (std::size_t c = 0; c < 3; ++c)
            rows_[i].value[c] = sums[2 * c][place].real() + sums[2 * c + 1][place].imag();
    }
}

Triple SmoothSensitivity::at(double nu) const {
    require_in_range("nu", nu, reach_.low * (1 - kSmoothRounding),
                     reach_.high * (1 + kSmoothRounding));
    const double place = (nu - first_) * per_nu_;
    const auto i = static_cast<std::size_t>(place);
    const double t = place - static_cast<double>(i);
    const std::array weight{-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2,
                            -(t + 1) * t * (t - 2) / 2, (t + 1) * t * (t - 1) / 6};
    Triple result{};
    for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t c = 0; c < 3; ++c) result[c] += weight[k] * rows_[i + k - 1].value[c];
    return result;
}

SensitivityDecay::SensitivityDecay(const Sensitivity& sensitivity) {
    const Wavenumbers nu = wavenumbers(sensitivity);
    step_nm_ = 1 / nu.period;
    const auto count = static_cast<std::size_t>(kLongest_nm * nu.period) + 1;
    const std::vector<std::vector<Complex>> H = harmonics(sensitivity, nu, count);
    largest_.resize(count);
    double largest = 0;
    for (std::size_t k = count; k-- > 0;) {
        for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(H[c][k]));
        largest_[k] = largest;
    }
}

double SensitivityDecay::operator()(double opd_nm) const {
    const double last = step_nm_ * static_cast<double>(largest_.size() - 1);
    if (opd_nm > last) return largest_[largest_.size() / 2] * last / (2 * opd_nm);
    return largest_[static_cast<std::size_t>(opd_nm / step_nm_)];
}

}  // namespace irido
