#pragma once

#include <vector>

#include "core/design/global_search.hpp"

namespace irido {

/// Best-fit values and their uncertainties.
struct FitResult {
    std::vector<double> x;
    std::vector<double> standard_error;  ///< infinite if the data do not determine the value
    std::vector<double> correlation;     ///< [value][value]; 0 where an error is infinite
    double chi2 = 0;
    std::size_t dof = 0;  ///< rows minus values
    std::size_t evaluations = 0;
    LocalEnd end = LocalEnd::flat;
    std::size_t starts = 0, starts_within = 0;  ///< number of starts, and of those that reached
                                                ///< within 1 % of the best
    /// The best distinct other minimum and its chi2; empty if there is none.
    std::vector<double> other;
    double other_chi2 = 0;
    bool is_stopped = false;
};

/// Random starts of a fit in addition to the given values, if all bounds are finite.
inline constexpr std::size_t kFitStarts = 100;

/// Least squares of sum (e/sigma)^2, started from the given values and from `starts` random points
/// inside the bounds. Standard errors are the square roots of the diagonal of inv(J^T J), with J
/// the derivatives of e/sigma: they assume the stated sigma and are not rescaled. Integers are held
/// and have none.
///   problem  with the merit chi2
FitResult fit(const DesignProblem& problem, const SearchSettings& settings, std::size_t starts);

}  // namespace irido
