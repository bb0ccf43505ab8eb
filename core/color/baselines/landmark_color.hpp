#pragma once

#include <memory>

#include "core/color/color_request.hpp"
#include "core/color/color_tables.hpp"

namespace irido {

/// FPB24's piecewise constant reflectance of a mirror of very many periods (eq. 15): boxes between
/// consecutive landmarks (ends of gaps, Airy points, zeros of the envelope), as high as the box
///     in a gap:  1
///     else:      w~(theta) R^e(middle), R^e = |C|^2 / (|C|^2 + sin^2 KL),
///                w~ = w0 + (1 - w0)(1 - cos theta)^5, w0 = 0.735 R12 + 0.532
/// with |C| = |q - 1/q|/2 |sin b|, R12 the reflectance of an interface of both layers at normal
/// incidence and theta the angle in the first one: each adds what CumulativeSensitivity has between
/// its ends. Boxes next to the gap of order m, between it and an Airy point, are split into
/// max(1, s - m) equal ones, s = method.count; there is one of order 0 below the first Airy point.
/// N and the media around the periods do not matter. T = 1 - R; s and p are averaged.
/// `error` is infinite. Throws DomainError if the stack is not one_mirror(); its operator throws as
/// bragg_period() does, and where more than kMostOrders gaps are in the visible range.
/// Source: FPB24 (CGF 43(2), 2024), section 3.2 and appendix B.
std::unique_ptr<ColorAlgorithm> landmark_color(const ColorTables& tables, const Stack& stack,
                                               const ColorMethod& method,
                                               const ColorRequest& request);

}  // namespace irido
