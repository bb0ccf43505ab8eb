#pragma once

#include <memory>

#include "core/color/color_method.hpp"

namespace irido {

/// Colours of two-layer periods by Bloch waves: T in each band is a series in its fast phase 2 NKL
/// (bloch_series()), T in each gap is exact, R = 1 - T. Each range is integrated by the trapezoidal
/// rule over a cosine map between its ends, times a SmoothSensitivity limited to the frequencies
/// that the points resolve, and with the harmonics that they resolve. The number of points is
/// doubled until the last changes and the bound on the remaining harmonics are below the tolerance.
/// More periods therefore need fewer points, in the limit only those for the average.
///   tables   observer and illuminant; must outlive the result
///   stack    the mirror
///   method   count 0: as many harmonics as the tolerance needs; `error` is a reliable estimate,
///            above the tolerance if more than request.evaluations points would be needed. m + 1:
///            the harmonics up to m only, 0 being the average; `error` is infinite
///   request  options
/// Its operator throws DomainError if the stack is not one_mirror(), beyond the critical angle of a
/// layer or of the substrate, and if the visible range has more than kMostGaps gaps.
std::unique_ptr<ColorAlgorithm> bloch_color(const ColorTables& tables, const Stack& stack,
                                            const ColorMethod& method, const ColorRequest& request);

inline constexpr double kMostGaps = 1000;

}  // namespace irido
