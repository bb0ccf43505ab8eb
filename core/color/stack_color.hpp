#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/color/color_request.hpp"
#include "core/color/color_tables.hpp"

namespace irido {

/// Makes a method ready for stacks of the materials and structure of `stack`, whose materials hold
/// their end values outside their range. `tables` must outlive the result.
///
/// automatic: the series where the stack is one film of constant indices, if there are enough
/// colours for its table to pay (or the film's thickness is spread, which takes quadrature very
/// long); Bloch waves where it is one_mirror() of many fringes; quadrature for all others, and
/// where these cannot promise the tolerance.
///
/// Throws DomainError if the method does not take the stack or the request, if a held range is not
/// usable, and as StackPower and IndexTable do.
std::unique_ptr<ColorAlgorithm> color_algorithm(const ColorTables& tables, const Stack& stack,
                                                const ColorMethod& method,
                                                const ColorRequest& request);

/// Colours [angle][side] of one stack by an algorithm made ready for it.
std::vector<StackColor> stack_color(const ColorAlgorithm& algorithm, const Stack& stack,
                                    std::size_t sides, std::span<const double> angles_deg,
                                    unsigned threads = 1);

/// Colours [angle][side] of one stack; angles in [0, 90] degrees. Throws as color_algorithm() does.
std::vector<StackColor> stack_color(const ColorTables& tables, const Stack& stack,
                                    const ColorMethod& method, const ColorRequest& request,
                                    std::span<const double> angles_deg, unsigned threads = 1);

/// Gives colours of stack_color() with an infinite error their distance from the colour by auto,
/// and the error of that; returns whether there were any.
bool measure_errors(const ColorTables& tables, const Stack& stack, const ColorRequest& request,
                    std::span<const double> angles_deg, unsigned threads,
                    std::span<StackColor> colors);

}  // namespace irido
