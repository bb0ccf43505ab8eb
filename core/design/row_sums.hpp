#pragma once

#include <span>
#include <vector>

#include "core/design/design_model.hpp"

namespace irido {

/// The sum of a[i] b[i], always in the same order.
double sum_of_products(const double* a, const double* b, std::size_t count);

/// Derivatives of an objective from the rows of a problem; memory is used again.
class RowSums {
public:
    /// gradient  [free]
    /// hessian   [free][free] of Gauss and Newton, or nullptr; for mean_abs, |e| being e^2/|e|, of
    ///           the squares
    void find(const DesignProblem& problem, const DesignRows& rows, std::span<double> gradient,
              double* hessian);

private:
    std::vector<double> factor_, scaled_, weighted_;
};

}  // namespace irido
