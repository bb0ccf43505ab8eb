#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace irido {

/// Evaluates all components of a function at many points, [point][component].
using ManyValues = std::function<void(std::span<const double> points, std::span<double> values)>;

/// Largest number of panels that integrals() uses.
inline constexpr std::size_t kMostPanels = 1U << 16U;

/// Integrals of every component of a function from the first to the last of `ends`, by a 16-point
/// Gauss rule per panel. A panel is halved until both halves together differ from the whole, in
/// every component, by no more than its share of the tolerance; the halves, whose error is far
/// smaller, make up the result. Returns nothing if that takes more than kMostPanels panels.
///   ends        panel boundaries to start with, ascending, at least two
///   components  number of components of the function
///   tolerance   absolute, for each component's integral, > 0
///   values_at   evaluates the function
std::optional<std::vector<double>> integrals(std::span<const double> ends, std::size_t components,
                                             double tolerance, const ManyValues& values_at);

}  // namespace irido
