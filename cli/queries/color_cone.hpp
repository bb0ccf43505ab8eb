#pragma once

#include <span>
#include <vector>

#include "core/color/stack_color.hpp"
#include "core/spectrum/cone.hpp"

namespace irido::cli {

/// The largest error of a cone's X, Y and Z, if no smaller tolerance is asked for.
inline constexpr double kColorConeError = 1e-8;

/// The requests whose colours a cone takes: as it is if the light is unpolarized, else s and p;
/// their tolerance is a tenth of the cone's.
std::vector<ColorRequest> cone_requests(const ColorRequest& request);

/// Colours over cones about the angles, [angle][side], as stack_color(). An f-number is that for
/// the incident index at 550 nm. Throws DomainError as ConeLight does, ToleranceError.
///   algorithms  of cone_requests(), for stacks like this one
///   request     whose tolerance is that of the cone's colours
std::vector<StackColor> cone_colors(std::span<const ColorAlgorithm* const> algorithms,
                                    const Stack& stack, const ColorRequest& request,
                                    std::span<const double> angles_deg, const ConeSize& size,
                                    unsigned threads);

}  // namespace irido::cli
