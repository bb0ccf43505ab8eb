#pragma once

#include <vector>

#include "core/design/global_search.hpp"

namespace irido {

/// Values that fit measurements best, and how well they are known.
struct FitResult {
    std::vector<double> x;
    std::vector<double> standard_error;  ///< infinite where the data do not tell
    std::vector<double> correlation;     ///< [value][value]; 0 beside an infinite error
    double chi2 = 0;
    std::size_t dof = 0;  ///< rows less values
    std::size_t evaluations = 0;
    LocalEnd end = LocalEnd::flat;
    std::size_t starts = 0, starts_within = 0;  ///< that came to within 1 % of the best
    /// The best minimum elsewhere, and its chi2; empty if there is none.
    std::vector<double> other;
    double other_chi2 = 0;
    bool is_stopped = false;
};

/// Starts of a fit besides the given values, where all bounds are finite.
inline constexpr std::size_t kFitStarts = 100;

/// Least squares of sum (e/sigma)^2 from the given values and from `starts` points drawn inside the
/// bounds. Standard errors are the roots of the diagonal of inv(J^T J), J the derivatives of
/// e/sigma: those of the stated sigma, not scaled. Values that do not move (integers) have none.
///   problem  of the merit chi2
FitResult fit(const DesignProblem& problem, const SearchSettings& settings, std::size_t starts);

}  // namespace irido
