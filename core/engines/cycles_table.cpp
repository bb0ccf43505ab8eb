#include "core/engines/cycles_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "core/colorimetry/observer.hpp"
#include "core/engines/series.hpp"

namespace irido {

namespace {

/// Cubic spline through values at unit spacing with not-a-knot ends: the third derivative is
/// continuous at the second and the last but one value. (Natural ends would distort the curve.)
class NotAKnotSpline {
public:
    NotAKnotSpline(double first, std::vector<double> values)
        : first_(first), value_(std::move(values)), bend_(value_.size()) {
        const std::size_t n = value_.size();
        const auto difference = [&](std::size_t i) {
            return 6 * (value_[i - 1] - 2 * value_[i] + value_[i + 1]);
        };
        // bend_0 = 2 bend_1 - bend_2 reduces the first equation of the tridiagonal system to 6
        // bend_1 = difference; likewise the last one
        bend_[1] = difference(1) / 6;
        bend_[n - 2] = difference(n - 2) / 6;
        std::vector<double> factor(n);
        double before = bend_[1];
        for (std::size_t i = 2; i + 2 < n; ++i) {
            const double pivot = 4 - factor[i - 1];
            factor[i] = 1 / pivot;
            before = (difference(i) - before) / pivot;
            bend_[i] = before;
        }
        for (std::size_t i = n - 3; i > 1; --i) bend_[i] -= factor[i] * bend_[i + 1];
        bend_[0] = 2 * bend_[1] - bend_[2];
        bend_[n - 1] = 2 * bend_[n - 2] - bend_[n - 3];
    }

    /// 0 outside.
    double operator()(double x) const {
        const double at = x - first_, last = static_cast<double>(value_.size() - 1);
        if (!(at >= 0 && at <= last)) return 0;
        const auto i = std::min(static_cast<std::size_t>(at), value_.size() - 2);
        const double b = at - static_cast<double>(i), a = 1 - b;
        return a * value_[i] + b * value_[i + 1] +
               ((a * a * a - a) * bend_[i] + (b * b * b - b) * bend_[i + 1]) / 6;
    }

private:
    double first_;
    std::vector<double> value_, bend_;  ///< bend_: second derivatives
};

constexpr std::size_t kCyclesEntries = 512, kCyclesPeriod = 2 * (kCyclesEntries - 1);
constexpr double kCyclesRange_nm = 60000;  ///< of 2 pi OPD

using CyclesTable = std::array<std::array<Complex, 3>, kCyclesEntries>;

/// A colour-matching function, padded with a zero at either end of its table.
NotAKnotSpline padded_spline(std::span<const double> rows) {
    std::vector<double> values{0};
    values.insert(values.end(), rows.begin(), rows.end());
    values.push_back(0);
    return {kFirstRow_nm - 1, std::move(values)};
}

CyclesTable cycles_table() {
    const Observer& eye = observer(2);
    const std::array splines{padded_spline(eye.x), padded_spline(eye.y), padded_spline(eye.z)};
    std::array<Complex, kCyclesPeriod> turn;
    for (std::size_t i = 0; i < kCyclesPeriod; ++i)
        turn[i] = std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(i) / kCyclesPeriod);
    CyclesTable xyz{};
    for (std::size_t j = 1; j < kCyclesPeriod; ++j) {
        const double f = static_cast<double>(j) * std::numbers::pi * 1000 / kCyclesRange_nm;
        const double nm = 1000 / f;
        const std::array s{splines[0](nm) / (f * f), splines[1](nm) / (f * f),
                           splines[2](nm) / (f * f)};
        if (s == std::array{0.0, 0.0, 0.0}) continue;
        for (std::size_t i = 0; i < kCyclesEntries; ++i)
            for (std::size_t c = 0; c < 3; ++c) xyz[i][c] += s[c] * turn[i * j % kCyclesPeriod];
    }
    CyclesTable rgb{};
    for (std::size_t i = 0; i < kCyclesEntries; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t k = 0; k < 3; ++k) rgb[i][c] += kShaderRgb[c][k] * xyz[i][k];
    const std::array white{rgb[0][0].real(), rgb[0][1].real(), rgb[0][2].real()};
    for (auto& entry : rgb)
        for (std::size_t c = 0; c < 3; ++c) entry[c] /= white[c];
    return rgb;
}

}  // namespace

std::array<Complex, 3> cycles_sensitivity(double opd_nm) {
    static const CyclesTable table = cycles_table();
    const double x = std::clamp(2 * std::numbers::pi * opd_nm / kCyclesRange_nm, 0.0, 1.0) *
                     (kCyclesEntries - 1);
    const auto i = std::min(static_cast<std::size_t>(x), kCyclesEntries - 2);
    const double part = x - static_cast<double>(i);
    std::array<Complex, 3> result{};
    for (std::size_t c = 0; c < 3; ++c)
        result[c] = table[i][c] * (1 - part) + table[i + 1][c] * part;
    return result;
}

}  // namespace irido
