// Compiled once for every instruction set: this file includes itself through foreach_target.h.
#include "core/color/quadrature/panel_sums.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/color/quadrature/panel_sums.cpp"
#include "core/math/vector_targets.hpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "core/math/vector_math-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

template <std::size_t kRows>
void some_row_sums(const double* rows, std::size_t stride, const double* values, V reference,
                   double* sums) {
    V sum[kRows];
    for (std::size_t r = 0; r < kRows; ++r) sum[r] = constant(0);
    for (std::size_t j = 0; j < stride; j += hn::Lanes(Lanes())) {
        const V value = hn::Sub(hn::LoadU(Lanes(), values + j), reference);
        for (std::size_t r = 0; r < kRows; ++r)
            sum[r] = hn::MulAdd(hn::LoadU(Lanes(), rows + r * stride + j), value, sum[r]);
    }
    for (std::size_t r = 0; r < kRows; ++r) sums[r] = hn::GetLane(hn::SumOfLanes(Lanes(), sum[r]));
}

/// Of kVectors vectors of points: parts of kCount denominators, and their transmittances.
template <std::size_t kCount, std::size_t kVectors>
void some_resampled(const double* columns, std::size_t inputs, std::size_t stride,
                    const double* const* from, double* const* to, const double* flux,
                    double* transmitted) {
    const std::size_t lanes = hn::Lanes(Lanes());
    V part[2 * kCount][kVectors];
    for (auto& of_part : part)
        for (V& sum : of_part) sum = constant(0);
    for (std::size_t i = 0; i < inputs; ++i) {
        V column[kVectors];
        for (std::size_t v = 0; v < kVectors; ++v)
            column[v] = hn::LoadU(Lanes(), columns + i * stride + v * lanes);
        for (std::size_t r = 0; r < 2 * kCount; ++r) {
            const V value = constant(from[r][i]);
            for (std::size_t v = 0; v < kVectors; ++v)
                part[r][v] = hn::MulAdd(column[v], value, part[r][v]);
        }
    }
    for (std::size_t v = 0; v < kVectors; ++v) {
        V sum = constant(0);
        for (std::size_t d = 0; d < kCount; ++d) {
            const V re = part[2 * d][v], im = part[2 * d + 1][v];
            hn::StoreU(re, Lanes(), to[2 * d] + v * lanes);
            hn::StoreU(im, Lanes(), to[2 * d + 1] + v * lanes);
            // past the points both are 0
            const V size = hn::Max(hn::MulAdd(re, re, hn::Mul(im, im)), constant(1e-300));
            if (transmitted) sum = hn::Add(sum, hn::Div(constant(flux[d]), size));
        }
        if (transmitted) hn::StoreU(sum, Lanes(), transmitted + v * lanes);
    }
}

template <std::size_t kCount>
void resampled(const double* columns, std::size_t inputs, std::size_t stride,
               const double* const* from, double* const* to, const double* flux,
               double* transmitted) {
    const std::size_t lanes = hn::Lanes(Lanes());
    double* at[2 * kCount];
    std::size_t j = 0;
    const auto step = [&](auto run) {
        for (std::size_t r = 0; r < 2 * kCount; ++r) at[r] = to[r] + j;
        run(columns + j, inputs, stride, from, at, flux, transmitted ? transmitted + j : nullptr);
    };
    for (; j + 2 * lanes <= stride; j += 2 * lanes) step(some_resampled<kCount, 2>);
    for (; j < stride; j += lanes) step(some_resampled<kCount, 1>);
}

}  // namespace

void all_resampled(const double* columns, std::size_t inputs, std::size_t stride,
                   std::size_t denominators, const double* const* from, double* const* to,
                   const double* flux, double* transmitted) {
    if (denominators == 2) {
        resampled<2>(columns, inputs, stride, from, to, flux, transmitted);
    } else {
        resampled<1>(columns, inputs, stride, from, to, flux, transmitted);
    }
}

void all_row_sums(const double* rows, std::size_t count, std::size_t stride, const double* values,
                  double reference, double* sums) {
    const V reference_v = constant(reference);
    std::size_t r = 0;
    for (; r + 6 <= count; r += 6)
        some_row_sums<6>(rows + r * stride, stride, values, reference_v, sums + r);
    for (; r + 2 <= count; r += 2)
        some_row_sums<2>(rows + r * stride, stride, values, reference_v, sums + r);
    for (; r < count; ++r)
        some_row_sums<1>(rows + r * stride, stride, values, reference_v, sums + r);
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
                            const double* flux, double* transmitted, SimdLevel level) {
    IRIDO_DISPATCH(level, all_resampled)
    (columns, inputs, stride, denominators, from, to, flux, transmitted);
}

double steepness(const double* re, const double* im, const double* log_scale,
                 const double* inverse_spacing, std::size_t stride, SimdLevel level) {
    return IRIDO_DISPATCH(level, steepest)(re, im, log_scale, inverse_spacing, stride);
}

}  // namespace irido

#endif
