#include "core/design/row_sums.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace irido {

namespace {

/// Divides the weights by 2 |e|, entry by entry.
void divide_by_lengths(const DesignProblem& problem, const DesignRows& rows,
                       std::vector<double>& factor) {
    constexpr double kLeast = 1e-12;
    for_each_entry(problem, rows, [&](std::size_t first, std::size_t size, double square) {
        for (std::size_t i = first; i < first + size; ++i)
            factor[i] /= 2 * std::max(std::sqrt(square), kLeast);
    });
}

}  // namespace

double sum_of_products(const double* a, const double* b, std::size_t count) {
    constexpr std::size_t kSums = 8;
    std::array<double, kSums> sums{};
    std::size_t i = 0;
    for (; i + kSums <= count; i += kSums)
        for (std::size_t k = 0; k < kSums; ++k) sums[k] += a[i + k] * b[i + k];
    for (std::size_t k = 0; i < count; ++i, ++k) sums[k] += a[i] * b[i];
    return ((sums[0] + sums[4]) + (sums[1] + sums[5])) +
           ((sums[2] + sums[6]) + (sums[3] + sums[7]));
}

void RowSums::find(const DesignProblem& problem, const DesignRows& rows, std::span<double> gradient,
                   double* hessian) {
    const std::size_t count = rows.residual.size(), size = problem.free.size();
    factor_ = rows.weight;
    if (problem.merit == MeritKind::mean_abs) divide_by_lengths(problem, rows, factor_);
    scaled_.resize(count);
    for (std::size_t i = 0; i < count; ++i) scaled_[i] = 2 * factor_[i] * rows.residual[i];
    weighted_.resize(hessian ? size * count : 0);
    for (std::size_t p = 0; p < size; ++p) {
        const double* const column = rows.jacobian.data() + p * count;
        gradient[p] = sum_of_products(scaled_.data(), column, count);
        if (!hessian) continue;
        for (std::size_t i = 0; i < count; ++i) weighted_[p * count + i] = factor_[i] * column[i];
        for (std::size_t q = 0; q <= p; ++q)
            hessian[p * size + q] = hessian[q * size + p] =
                2 * sum_of_products(weighted_.data() + q * count, column, count);
    }
}

}  // namespace irido
