#pragma once

#include <memory>

#include "core/color/color_request.hpp"
#include "core/color/color_tables.hpp"

namespace irido {

/// Colours of some periods of two layers by their Bloch waves: T in every band is a series in its
/// fast phase 2 NKL (bloch_series()), T in every gap is exact, R = 1 - T. Each is integrated by the
/// trapezoid rule over a cosine map between its ends, times a SmoothSensitivity that keeps what the
/// points resolve; of the series the harmonics that they resolve. Points are doubled until neither
/// that nor the bound of the harmonics left out exceeds the tolerance, so that the more periods
/// there are, the fewer points are needed: in the end the average alone.
///
///   method.count  0: as many harmonics as the tolerance needs; `error` is an honest estimate, and
///                 exceeds it if more than request.evaluations points would be needed.
///                 m + 1: the harmonics up to m only, 0: the average; `error` is infinite.
///
/// Throws DomainError if the stack is not one_mirror(). Its operator throws at angles past the
/// critical one of a layer or of the substrate, and where more than kMostGaps gaps are in the
/// visible range.
std::unique_ptr<ColorAlgorithm> bloch_color(const ColorTables& tables, const Stack& stack,
                                            const ColorMethod& method, const ColorRequest& request);

inline constexpr double kMostGaps = 1000;

}  // namespace irido
