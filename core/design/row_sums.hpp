#pragma once

#include <span>
#include <vector>

#include "core/design/design_model.hpp"

namespace irido {

/// Sum of a[i] b[i] in a fixed order.
double sum_of_products(const double* a, const double* b, std::size_t count);

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
