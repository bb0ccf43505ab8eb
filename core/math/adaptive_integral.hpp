#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace irido {

/// Components of a function at many points, [point][component].
using ManyValues = std::function<void(std::span<const double> points, std::span<double> values)>;

/// The largest number of panels of integrals().
inline constexpr std::size_t kMostPanels = 1U << 16U;

/// Integrals of all components of a function from the first of `ends` to the last: a Gauss rule of
/// 16 points on each panel between two ends, panels halved until both halves together differ from
/// the whole by at most their share of the tolerance, in every component. What is returned is the
/// sum of the halves, whose error is far smaller. Nothing if that takes more than kMostPanels.
///   ends        ascending, at least two
///   components  of the function
///   tolerance   absolute, of every component's integral
std::optional<std::vector<double>> integrals(std::span<const double> ends, std::size_t components,
                                             double tolerance, const ManyValues& values_at);

}  // namespace irido
