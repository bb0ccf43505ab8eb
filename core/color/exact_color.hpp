#pragma once

#include "core/color/color_method.hpp"

namespace irido {

/// A special method, and quadrature of the same stacks where the special one throws DomainError or
/// misses the tolerance.
///   tables   observer and illuminant; must outlive the result
///   stack    materials and structure
///   request  options
///   special  prepared for such stacks
std::unique_ptr<ColorAlgorithm> or_quadrature(const ColorTables& tables, const Stack& stack,
                                              const ColorRequest& request,
                                              std::unique_ptr<ColorAlgorithm> special);

/// Quadrature of spectra; where a thickness is spread, the mean of colours without spread if that
/// suffices.
///   tables   observer and illuminant; must outlive the result
///   stack    materials and structure
///   method   of stacks without spread
///   request  options
std::unique_ptr<ColorAlgorithm> exact_color(const ColorTables& tables, const Stack& stack,
                                            const ColorMethod& method, const ColorRequest& request);

}  // namespace irido
