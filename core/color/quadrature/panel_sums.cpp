// Compiled once for every instruction set: this file includes itself through foreach_target.h.
#include "core/color/quadrature/panel_sums.hpp"

#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/color/quadrature/panel_sums.cpp"
#include "core/math/vector_targets.hpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "core/math/vector_math-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

// Sums are named by constants, not by loop variables: so they stay in registers.

template <std::size_t... kRow>
void some_row_sums(std::index_sequence<kRow...>, const double* rows, std::size_t stride,
                   const double* values, V reference, double* sums) {
    V sum[] = {(static_cast<void>(kRow), constant(0))...};
    for (std::size_t j = 0; j < stride; j += hn::Lanes(Lanes())) {
        const V value = hn::Sub(hn::LoadU(Lanes(), values + j), reference);
        ((sum[kRow] = hn::MulAdd(hn::LoadU(Lanes(), rows + kRow * stride + j), value, sum[kRow])),
         ...);
    }
    ((sums[kRow] = hn::GetLane(hn::SumOfLanes(Lanes(), sum[kRow]))), ...);
}

/// What follows from denominators at one vector of points: T, or its mean over two.
void store_power(V sum, const Powers& powers, std::size_t j) {
    const V T = hn::Min(constant(1), hn::Mul(constant(powers.scale), sum));
    if (powers.T) hn::StoreU(T, Lanes(), powers.T + j);
    if (powers.R) hn::StoreU(hn::Sub(constant(1), T), Lanes(), powers.R + j);
}

/// Of one or two vectors of points from `j` on: parts of the denominators, real and imaginary ones
/// in turn, and powers.
template <bool kTwo, std::size_t... kPart>
void some_resampled(std::index_sequence<kPart...>, const double* columns, std::size_t inputs,
                    std::size_t stride, const double* const* from, double* const* to,
                    const double* flux, const Powers& powers, std::size_t j) {
    const std::size_t lanes = hn::Lanes(Lanes());
    V first[] = {(static_cast<void>(kPart), constant(0))...};
    V second[] = {(static_cast<void>(kPart), constant(0))...};
    const double* column = columns + j;
    for (std::size_t i = 0; i < inputs; ++i, column += stride) {
        const V here = hn::LoadU(Lanes(), column);
        ((first[kPart] = hn::MulAdd(here, constant(from[kPart][i]), first[kPart])), ...);
        if constexpr (kTwo) {
            const V there = hn::LoadU(Lanes(), column + lanes);
            ((second[kPart] = hn::MulAdd(there, constant(from[kPart][i]), second[kPart])), ...);
        }
    }
    const auto finish = [&](const V* part, std::size_t at) {
        (hn::StoreU(part[kPart], Lanes(), to[kPart] + at), ...);
        if (!powers.T && !powers.R) return;
        const auto of_one = [&](std::size_t d) {
            // past the points both are 0
            const V size =
                hn::MulAdd(part[2 * d], part[2 * d], hn::Mul(part[2 * d + 1], part[2 * d + 1]));
            return hn::Div(constant(flux[d]), hn::Max(size, constant(1e-300)));
        };
        V sum = of_one(0);
        if constexpr (sizeof...(kPart) == 4) sum = hn::Add(sum, of_one(1));
        store_power(sum, powers, at);
    };
    finish(first, j);
    if constexpr (kTwo) finish(second, j + lanes);
}

template <std::size_t kCount>
void resampled(const double* columns, std::size_t inputs, std::size_t stride,
               const double* const* from, double* const* to, const double* flux,
               const Powers& powers) {
    constexpr std::make_index_sequence<2 * kCount> parts;
    const std::size_t lanes = hn::Lanes(Lanes());
    std::size_t j = 0;
    for (; j + 2 * lanes <= stride; j += 2 * lanes)
        some_resampled<true>(parts, columns, inputs, stride, from, to, flux, powers, j);
    for (; j < stride; j += lanes)
        some_resampled<false>(parts, columns, inputs, stride, from, to, flux, powers, j);
}

}  // namespace

void all_resampled(const double* columns, std::size_t inputs, std::size_t stride,
                   std::size_t denominators, const double* const* from, double* const* to,
                   const double* flux, const Powers& powers) {
    if (denominators == 2) {
        resampled<2>(columns, inputs, stride, from, to, flux, powers);
    } else {
        resampled<1>(columns, inputs, stride, from, to, flux, powers);
    }
}

void all_row_sums(const double* rows, std::size_t count, std::size_t stride, const double* values,
                  double reference, double* sums) {
    const V reference_v = constant(reference);
    std::size_t r = 0;
    const auto some = [&](auto which) {
        some_row_sums(which, rows + r * stride, stride, values, reference_v, sums + r);
        r += which.size();
    };
    while (r + 6 <= count) some(std::make_index_sequence<6>());
    while (r + 2 <= count) some(std::make_index_sequence<2>());
    while (r < count) some(std::make_index_sequence<1>());
}

double steepest(const double* re, const double* im, const double* log_scale,
                const double* inverse_spacing, std::size_t stride) {
    V largest = constant(0);
    const V tiny = constant(1e-300);
    for (std::size_t j = 0; j < stride; j += hn::Lanes(Lanes())) {
        const V x = hn::LoadU(Lanes(), re + j), next_x = hn::LoadU(Lanes(), re + j + 1);
        const V y = hn::LoadU(Lanes(), im + j), next_y = hn::LoadU(Lanes(), im + j + 1);
        const V inverse = hn::LoadU(Lanes(), inverse_spacing + j);
        const V change =
            hn::Sub(hn::LoadU(Lanes(), log_scale + j + 1), hn::LoadU(Lanes(), log_scale + j));
        const V scaled = hn::Mul(hn::Abs(change), inverse);
        const V dx = hn::Mul(hn::Sub(next_x, x), inverse);
        const V dy = hn::Mul(hn::Sub(next_y, y), inverse);
        const V slope = hn::MulAdd(dx, dx, hn::Mul(dy, dy));
        const V size = hn::Min(hn::MulAdd(x, x, hn::Mul(y, y)),
                               hn::MulAdd(next_x, next_x, hn::Mul(next_y, next_y)));
        largest = hn::Max(largest, hn::Add(hn::Sqrt(hn::Div(slope, hn::Max(size, tiny))), scaled));
    }
    return hn::GetLane(hn::MaxOfLanes(Lanes(), largest));
}

}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace irido {

void row_sums(const double* rows, std::size_t count, std::size_t stride, const double* values,
              double reference, double* sums, SimdLevel level) {
    IRIDO_DISPATCH(level, all_row_sums)(rows, count, stride, values, reference, sums);
}

void resampled_denominators(const double* columns, std::size_t inputs, std::size_t stride,
                            std::size_t denominators, const double* const* from, double* const* to,
                            const double* flux, const Powers& powers, SimdLevel level) {
    IRIDO_DISPATCH(level, all_resampled)
    (columns, inputs, stride, denominators, from, to, flux, powers);
}

double steepness(const double* re, const double* im, const double* log_scale,
                 const double* inverse_spacing, std::size_t stride, SimdLevel level) {
    return IRIDO_DISPATCH(level, steepest)(re, im, log_scale, inverse_spacing, stride);
}

}  // namespace irido

#endif
