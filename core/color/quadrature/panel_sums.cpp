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

}  // namespace

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

double steepness(const double* re, const double* im, const double* log_scale,
                 const double* inverse_spacing, std::size_t stride, SimdLevel level) {
    return IRIDO_DISPATCH(level, steepest)(re, im, log_scale, inverse_spacing, stride);
}

}  // namespace irido

#endif
