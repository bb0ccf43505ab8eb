#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace irido {

/// Minimum of a function over the unit cube, and its location.
struct SimplexMinimum {
    std::vector<double> x;
    double value = 0;
};

/// Derivative-free descent by simplices clamped to the unit cube. Restarts from its best point with
/// a smaller simplex until `evaluations` are used up or a restart improves the value by less than
/// 1e-6 of it.
///   function     to be minimized
///   start        inside [0, 1]^n, n >= 1
///   size         of the first simplex, (0, 1]
///   evaluations  limit on calls of `function`
/// Source: J. A. Nelder and R. Mead, Computer Journal 7, 308 (1965), with the coefficients of
/// F. Gao and L. Han, Comput. Optim. Appl. 51, 259 (2012).
SimplexMinimum simplex_search(const std::function<double(std::span<const double>)>& function,
                              std::vector<double> start, double size, std::size_t evaluations);

}  // namespace irido
