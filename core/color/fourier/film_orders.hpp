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
    double error = 0;  ///< bound on truncation, interpolation and rounding
};

/// Where a series is truncated: at the latest after the last order, and otherwise once the
/// remainder, bounded by the geometric decay of the orders and the bound of H, is below the
/// tolerance. Nothing beyond that is computed.
struct OrderLimits {
    double tolerance = 1e-7;
    std::size_t last = 0;  ///< 0: no limit
};

/// Sums for many angles, one after the other, with the six numbers of H processed side by side.
///   transform  H
///   orders     the fringes, one entry per angle
///   limits     where to truncate
///   sums       results, one per entry of `orders`
///   level      instruction set
void sum_orders(const SensitivityTransform& transform, std::span<const FilmOrders> orders,
                const OrderLimits& limits, std::span<OrderSum> sums, SimdLevel level);

}  // namespace irido
