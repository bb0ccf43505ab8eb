#pragma once

#include <span>
#include <vector>

#include "core/color/stack_color.hpp"
#include "core/spectrum/cone.hpp"

namespace irido::cli {

/// The largest error of a cone's X, Y and Z, unless a smaller tolerance is requested.
inline constexpr double kColorConeError = 1e-8;

/// The requests whose colours a cone needs: the request itself for unpolarized light, otherwise s
/// and p; their tolerance is a tenth of the cone's.
std::vector<ColorRequest> cone_requests(const ColorRequest& request);

/// Colours over cones about the angles, [angle][side], as from stack_color(). An f-number applies
/// to the incident index at 550 nm. Throws ToleranceError, and DomainError like ConeLight.
///   algorithms  for cone_requests(), prepared for stacks like this one
///   stack       the stack
///   request     the colours, with the tolerance of the cone's
///   angles_deg  axes of the cones, degrees, [0, 90]
///   size        the cones
///   threads     number of threads
std::vector<StackColor> cone_colors(std::span<const ColorAlgorithm* const> algorithms,
                                    const Stack& stack, const ColorRequest& request,
                                    std::span<const double> angles_deg, const ConeSize& size,
                                    unsigned threads);

}  // namespace irido::cli
