#pragma once

#include <span>
#include <vector>

#include "core/design/design_model.hpp"

namespace irido {

/// Sum of a[i] b[i] in a fixed order.
double sum_of_products(const double* a, const double* b, std::size_t count);

/// Calls work(first, size, square) for every entry of every target: its first row, its number of
/// rows and the sum of their squared residuals.
template <class Work>
void for_each_entry(const DesignProblem& problem, const DesignRows& rows, const Work& work) {
    std::size_t row = 0;
    for (const DesignTarget& target : problem.targets) {
        const std::size_t size = target.quantity == DesignQuantity::lab ? 3 : 1;
        for (std::size_t e = 0; e < entry_count(target); ++e, row += size) {
            double square = 0;
            for (std::size_t i = row; i < row + size; ++i)
                square += rows.residual[i] * rows.residual[i];
            work(row, size, square);
        }
    }
}

/// Derivatives of an objective from the rows of a problem; memory is reused.
class RowSums {
public:
    /// Gradient and Gauss-Newton matrix at one point.
    ///   problem   defines the merit
    ///   rows      with the Jacobian
    ///   gradient  [free]
    ///   hessian   [free][free], or nullptr; for mean_abs, written as sum of e^2/|e|, that of the
    ///             squares
    void find(const DesignProblem& problem, const DesignRows& rows, std::span<double> gradient,
              double* hessian);

private:
    std::vector<double> factor_, scaled_, weighted_;
};

}  // namespace irido
