#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/colorimetry/sensitivity_transform.hpp"
#include "core/math/simd_level.hpp"

namespace irido {

/// The fringes of one film at one angle, whose sum over the orders is
///     2 sum_m sum_k weight[k] Re( bounce[k]^m H(m D) ),   m = 1, 2, ...
/// k counts polarizations, which share H.
struct FilmOrders {
    double opd_nm = 0;                ///< D
    std::array<double, 2> weight{};   ///< share of the light times T of FilmSeries
    std::array<Complex, 2> bounce{};  ///< of FilmSeries, |bounce| < 1 where there is a weight
};

struct OrderSum {
    Triple xyz{};
    double error = 0;  ///< bound of what is left out, of interpolation and of rounding
};

/// Where a series ends: where all that follows is below the tolerance, by the orders' geometric
/// decay and the bound of H from there on, and not after the last order. Nothing past the end is
/// computed.
struct OrderLimits {
    double tolerance = 1e-7;
    std::size_t last = 0;  ///< 0: no last one
};

/// The sums of many angles, one after the other, the six numbers of H side by side.
void sum_orders(const SensitivityTransform& transform, std::span<const FilmOrders> orders,
                const OrderLimits& limits, std::span<OrderSum> sums, SimdLevel level);

}  // namespace irido
