#pragma once

#include <memory>

#include "core/color/color_method.hpp"

namespace irido {

/// Whether a layer's thickness is spread.
bool has_spread(const Stack& stack);

/// Colours of stacks with thickness_sigma_nm as means of colours of stacks without: X, Y and Z are
/// linear in R and T, and as functions of a thickness they are much smoother than these, because
/// the observer has already averaged over the wavelengths. Several layers take products of rules.
///   few fringes  9 points, exact for polynomials of degree 15
///   more         16 to 128 equal steps
///   cut at 0     Clenshaw and Curtis's rules of 16 to 128 intervals
/// The error of a rule is that of the fastest waves, or the steepest polynomials, that its points
/// resolve: their amplitudes in the colours. Two rules that are compared may agree by chance where
/// a narrow resonance passes a kink of the observer. An error is infinite where the spread holds
/// too many fringes for these.
/// Source: A. Genz and B. D. Keister, J. Comput. Appl. Math. 71 (1996) 299.
///   stack    one of those to come, as of color_algorithm()
///   request  of them
///   method   of the stacks without spread
/// nullptr if the tolerance is below 5e-8, a material amplifies, or the spread layers are none,
/// more than two or incoherent.
std::unique_ptr<ColorAlgorithm> spread_color(const ColorTables& tables, const Stack& stack,
                                             const ColorMethod& method,
                                             const ColorRequest& request);

}  // namespace irido
