#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/color/color_method.hpp"

namespace irido {

/// Prepares a method for stacks with the materials and structure of `stack`, clamped outside their
/// range.
///   tables   observer and illuminant; must outlive the result
///   stack    materials and structure
///   method   see ColorMethod
///   request  options
/// Throws DomainError if the method does not support the stack, the request or a base colour, if a
/// held range is not usable, and as StackPower and IndexTable do.
std::unique_ptr<ColorAlgorithm> color_algorithm(const ColorTables& tables, const Stack& stack,
                                                const ColorMethod& method,
                                                const ColorRequest& request);

/// Colours [angle][side] of one stack by a prepared algorithm.
///   algorithm   made by color_algorithm()
///   stack       of the same materials and structure
///   sides       number of sides in the request
///   angles_deg  [0, 90] degrees
///   threads     0: one per core
std::vector<StackColor> stack_color(const ColorAlgorithm& algorithm, const Stack& stack,
                                    std::size_t sides, std::span<const double> angles_deg,
                                    unsigned threads = 1);

/// Colours [angle][side] of one stack. Throws as color_algorithm() does.
///   tables      observer and illuminant
///   stack       materials, structure and thicknesses
///   method      see ColorMethod
///   request     options
///   angles_deg  [0, 90] degrees
///   threads     0: one per core
std::vector<StackColor> stack_color(const ColorTables& tables, const Stack& stack,
                                    const ColorMethod& method, const ColorRequest& request,
                                    std::span<const double> angles_deg, unsigned threads = 1);

/// Replaces infinite errors of baseline colours by their distance from the automatic method's
/// colour plus its error; returns whether there were any.
///   tables      observer and illuminant
///   stack       the colours' stack
///   request     options with which they were computed
///   angles_deg  [0, 90] degrees
///   threads     0: one per core
///   colors      [angle][side], updated
bool measure_errors(const ColorTables& tables, const Stack& stack, const ColorRequest& request,
                    std::span<const double> angles_deg, unsigned threads,
                    std::span<StackColor> colors);

}  // namespace irido
