#include "core/color/quadrature/resampling.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>

#include "core/color/quadrature/quadrature_rule.hpp"
#include "core/math/lazy.hpp"

namespace irido {

namespace {

/// Points this close to one of the panel's are that one.
constexpr double kSamePoint = 1e-14;

double chebyshev_point(std::size_t j, std::size_t degree) {
    return std::cos(std::numbers::pi * static_cast<double>(j) / static_cast<double>(degree));
}

/// Lagrange's polynomials at `x`, by the barycentric formula.
/// Source: J.-P. Berrut and L. N. Trefethen, SIAM Review 46, 501 (2004), eq. 4.2 and 5.4.
void fill_row(Resampling& matrix, std::size_t row, double x) {
    const std::size_t degree = matrix.inputs - 1;
    double sum = 0;
    for (std::size_t k = 0; k <= degree; ++k) {
        const double apart = x - chebyshev_point(k, degree);
        if (std::abs(apart) < kSamePoint) {
            for (std::size_t i = 0; i <= degree; ++i)
                matrix.columns[i * matrix.stride + row] = i == k ? 1 : 0;
            return;
        }
        const double end = k == 0 || k == degree ? 0.5 : 1;
        const double weight = (k % 2 == 0 ? end : -end) / apart;
        matrix.columns[k * matrix.stride + row] = weight;
        sum += weight;
    }
    for (std::size_t k = 0; k <= degree; ++k) matrix.columns[k * matrix.stride + row] /= sum;
}

Resampling empty_resampling(std::size_t from, std::size_t points) {
    const std::size_t inputs = kDegrees.at(from) + 1, stride = whole_vectors(points);
    return {inputs, stride, std::vector<double>(inputs * stride)};
}

using Known = Lazy<const Resampling>;

}  // namespace

const Resampling& resampling(std::size_t from, std::size_t to) {
    static std::array<std::array<Known, kDegrees.size()>, kDegrees.size()> known;
    static std::mutex lock;
    return known.at(from).at(to).get(lock, [&] {
        auto matrix = std::make_unique<Resampling>(empty_resampling(from, kDegrees.at(to) + 1));
        for (std::size_t j = 0; j <= kDegrees[to]; ++j)
            fill_row(*matrix, j, chebyshev_point(j, kDegrees[to]));
        return matrix;
    });
}

const Resampling& resampling_of_half(std::size_t degree, std::size_t half) {
    static std::array<std::array<Known, 2>, kDegrees.size()> known;
    static std::mutex lock;
    return known.at(degree).at(half).get(lock, [&] {
        auto matrix =
            std::make_unique<Resampling>(empty_resampling(degree, kDegrees.at(degree) + 1));
        for (std::size_t j = 0; j <= kDegrees[degree]; ++j)
            fill_row(*matrix, j, (chebyshev_point(j, kDegrees[degree]) + (half == 0 ? 1 : -1)) / 2);
        return matrix;
    });
}

}  // namespace irido
