#include "core/color/quadrature/quadrature_rule.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>

#include "core/color/quadrature/panel_sums.hpp"
#include "core/math/lazy.hpp"

namespace irido {

namespace {

std::size_t place_of(std::size_t degree) {
    return static_cast<std::size_t>(std::ranges::find(kDegrees, degree) - kDegrees.begin());
}

/// What the moments past the last one are taken to be.
double high_moments(const std::vector<double>& moment) {
    const std::size_t degree = moment.size() - 1;
    double high = 0;
    for (std::size_t k = 3 * degree / 4; k <= degree; ++k)
        high = std::max(high, std::abs(moment[k]));
    return high;
}

/// Square roots are not alone in their panels.
constexpr double kSafetyOfRoot = 2;

/// Size of a coefficient of a square root, k of the last one's place, in units of that one.
double root_fall(double k) {
    return 1 / (k * std::sqrt(k));
}

/// Error of an integral per unit of the last coefficient. The coefficient c_(n+j) that is left out
/// misses its own moment and comes back on the points as T_(n-j).
double error_per_coefficient(const std::vector<double>& moment, double high, double fall) {
    const std::size_t degree = moment.size() - 1;
    double sum = 0, size = 1;
    for (std::size_t j = 1; j <= degree; ++j) {
        size *= fall;
        sum += size * (std::abs(moment[degree - j]) + high);
    }
    return 2 * sum;  // c_(3n - j) and later ones come back there too
}

/// What coefficients of a square root past the last one add to each of a degree, in units of that
/// one, as T_k and T_(2 p degree +- k) are alike on the points.
std::vector<double> roots_of_aliases(std::size_t degree) {
    constexpr int kAliases = 64;
    const auto n = static_cast<double>(degree);
    std::vector<double> sums(degree + 1);
    for (std::size_t k = 0; k <= degree; ++k) {
        const double part = static_cast<double>(k) / n;
        for (int p = 1; p <= kAliases; ++p) {
            if (k < degree || p > 1) sums[k] += root_fall(2 * p - part);
            if (k > 0) sums[k] += root_fall(2 * p + part);
        }
    }
    return sums;
}

/// Error of an integral per unit of the last coefficient of a square root.
double error_per_root(const std::vector<double>& moment, double high) {
    static std::array<Lazy<const std::vector<double>>, kDegrees.size()> shared;
    static std::mutex lock;
    const std::size_t degree = moment.size() - 1;
    const std::vector<double>& alias = shared.at(place_of(degree)).get(lock, [&] {
        return std::make_unique<const std::vector<double>>(roots_of_aliases(degree));
    });
    // moments past the last one fall as k^-2
    double sum = high * static_cast<double>(degree) / 2.5;
    for (std::size_t k = 0; k <= degree; ++k) sum += alias[k] * std::abs(moment[k]);
    return sum;
}

}  // namespace

double steepest_of(double rate, double degree) {
    return 1 / (2 * std::sinh(rate / degree));
}

namespace {

std::size_t middle_of(std::size_t degree) {
    return degree < 16 ? 0 : std::max<std::size_t>(3, degree / 16);
}
std::size_t tail_of(std::size_t degree) {
    return std::max<std::size_t>(3, degree / 8);
}

/// What makes the middle and the last coefficients of a degree from values at its points.
std::vector<double> coefficient_rows(std::size_t degree) {
    const std::size_t middle = middle_of(degree), tail = tail_of(degree);
    const std::size_t stride = whole_vectors(degree + 1);
    const auto n = static_cast<double>(degree);
    std::vector<double> rows((middle + tail) * stride);
    for (std::size_t t = 0; t < middle + tail; ++t) {
        const std::size_t k =
            t < middle ? degree / 2 + 1 - middle + t : degree + 1 - tail + (t - middle);
        double* row = rows.data() + t * stride;
        for (std::size_t j = 0; j <= degree; ++j) {
            const double ends = (j == 0 || j == degree ? 0.5 : 1) * (k == degree ? 0.5 : 1);
            row[j] = 2 / n * ends *
                     std::cos(std::numbers::pi * static_cast<double>(j * k % (2 * degree)) / n);
        }
    }
    return rows;
}

/// The same of one of kDegrees, which all rules share.
std::span<const double> shared_coefficient_rows(std::size_t degree) {
    static std::array<Lazy<const std::vector<double>>, kDegrees.size()> shared;
    static std::mutex lock;
    return shared.at(place_of(degree)).get(lock, [&] {
        return std::make_unique<const std::vector<double>>(coefficient_rows(degree));
    });
}

}  // namespace

QuadratureRule::QuadratureRule(const Sensitivity& sensitivity, WavelengthRange range,
                               std::size_t degree)
    : points(degree + 1),
      stride(whole_vectors(points)),
      middle(middle_of(degree)),
      tail(tail_of(degree)),
      weights(3 * stride),
      coefficients(shared_coefficient_rows(degree)),
      inverse_spacing(stride) {
    PanelRule panel = panel_rule(sensitivity, range, degree);
    for (std::size_t c = 0; c < 3; ++c)
        std::ranges::copy(panel.weight[c],
                          weights.begin() + static_cast<std::ptrdiff_t>(c * stride));
    x = std::move(panel.x);
    wavelength_nm = std::move(panel.wavelength_nm);
    const auto n = static_cast<double>(degree);
    for (std::size_t j = 0; j < degree; ++j) inverse_spacing[j] = 1 / (x[j] - x[j + 1]);
    for (std::size_t rate = 0; rate < kFallRates.size(); ++rate) {
        step[rate] = std::exp(-kFallRates[rate] / n);
        steepest[rate] = steepest_of(kFallRates[rate], n);
    }
    for (std::size_t c = 0; c < 3; ++c) light[c] = panel.moment[c][0] / sensitivity.white()[c];
    for (std::size_t c = 0; c < 3; ++c) {
        const double high = high_moments(panel.moment[c]);
        for (std::size_t rate = 0; rate < kFallRates.size(); ++rate)
            per_coefficient[rate][c] = error_per_coefficient(panel.moment[c], high, step[rate]);
        per_coefficient_with_root[c] = error_per_root(panel.moment[c], high);
    }
}

namespace {

/// Falls that tell each of kFallRates.
const std::array<double, kFallRates.size()>& needed_falls() {
    static const auto falls = [] {
        std::array<double, kFallRates.size()> result{};
        for (std::size_t rate = 0; rate < kFallRates.size(); ++rate)
            result[rate] = std::exp(kFallRates[rate] + 1);
        return result;
    }();
    return falls;
}

double largest_of(std::span<const double> values) {
    double largest = 0;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    return largest;
}

}  // namespace

void QuadratureRule::sum(const double* values, double reference, double* sums,
                         SimdLevel simd) const {
    row_sums(weights.data(), 3, stride, values, reference, sums, simd);
    row_sums(coefficients.data(), middle + tail, stride, values, reference, sums + 3, simd);
}

double QuadratureRule::fall_seen(std::span<const double> sums) const {
    const double last = largest_of(sums.subspan(3 + middle, tail));
    return largest_of(sums.subspan(3, middle)) / std::max(last, 1e-300);
}

Triple QuadratureRule::error(std::span<const double> sums, std::size_t rate,
                             std::size_t most) const {
    const std::span<const double> last = sums.subspan(3 + middle, tail);
    if (middle > 0) {
        // over half of the way, with a factor e to spare: twice as fast as the rate claims
        const double fall = fall_seen(sums);
        while (rate < most && fall >= needed_falls()[rate + 1]) ++rate;
    }
    double size = 0, factor = 1;
    for (std::size_t k = tail; k-- > 0;) {
        size = std::max(size, factor * std::abs(last[k]));
        factor *= step[rate];
    }
    Triple result = per_coefficient[rate];
    for (double& value : result) value *= size;
    return result;
}

Triple QuadratureRule::error_with_root(std::span<const double> sums) const {
    // the middle ones stand in where the cosine is small for all of the last
    const double size = std::max(largest_of(sums.subspan(3 + middle, tail)),
                                 root_fall(2) * largest_of(sums.subspan(3, middle)));
    Triple result = per_coefficient_with_root;
    for (double& value : result) value *= kSafetyOfRoot * size;
    return result;
}

}  // namespace irido
