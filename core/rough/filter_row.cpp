// Compiled once per instruction set: this file includes itself through foreach_target.h.
#include "core/rough/filter_row.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/rough/filter_row.cpp"
#include "core/math/vector_targets.hpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "core/math/vector_math-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {

/// J1 + J2, as in filter.cpp.
HWY_INLINE V both_integrals(V P, V M, V end, V slope, bool is_cut) {
    const V PM = hn::Mul(P, M), inverse = hn::Div(constant(1), PM), root = hn::Sqrt(PM);
    const V per_root = hn::Mul(root, inverse);  // 1 / sqrt(P M)
    V angle = constant(std::numbers::pi);
    if (is_cut)
        angle = hn::NegMulAdd(constant(2), atan(hn::Mul(hn::Mul(P, slope), per_root)), angle);
    const V J1 = hn::Mul(angle, per_root), p = hn::Mul(constant(0.5), hn::Add(P, M));
    return hn::MulAdd(hn::MulAdd(p, J1, end), inverse, J1);
}

/// F_alpha for one vector of theta_d.
HWY_INLINE V filter(const FilterRow& row, const FilterAxis& axis, std::size_t at) {
    const Lanes d;
    const auto load = [&](const double* from) HWY_ATTR { return hn::LoadU(d, from + at); };
    const V deg = load(axis.deg()), sin = load(axis.sin()), cos = load(axis.cos());
    const V sin_left = load(axis.sin_left()), cos_left = load(axis.cos_left());
    const V i_deg = constant(row.theta_i.deg), i_sin = constant(row.theta_i.sin),
            i_cos = constant(row.theta_i.cos), i_sin_left = constant(row.theta_i.sin_left),
            i_cos_left = constant(row.theta_i.cos_left);
    const V half_degree = constant(std::numbers::pi / 360), two = constant(2);
    const V rest = constant(row.rest), two_s = constant(2 * row.s);

    const V difference = sin_of_eighth(hn::Mul(hn::Sub(i_deg, deg), half_degree));
    const V sin_sum = hn::MulAdd(i_sin, cos, hn::Mul(i_cos, sin));
    const V cos_sum = hn::MulAdd(i_sin_left, cos_left, hn::Mul(i_cos_left, sin_left));
    const V P = hn::MulAdd(two_s, hn::Mul(difference, difference), rest);
    const V M_minus = hn::MulAdd(two_s, hn::Mul(sin_sum, sin_sum), rest);
    const V M_plus = hn::MulAdd(two_s, hn::Mul(cos_sum, cos_sum), rest);
    const V sin_cos_d = hn::Mul(sin, cos), left_d = hn::Mul(sin_left, cos_left);

    const V past = hn::Add(hn::Sub(hn::Max(i_deg, deg), constant(90)), hn::Min(i_deg, deg));
    const Mask cut = hn::Gt(past, hn::Zero(d));
    const bool is_cut = !hn::AllFalse(d, cut);
    V mean = hn::Zero(d), slope = mean;
    if (is_cut) {
        const V B = hn::Mul(
            hn::Mul(constant(std::numbers::sqrt2), sin_of_eighth(hn::Mul(past, half_degree))),
            hn::Add(sin_sum, cos_sum));
        const V A = hn::Mul(constant(4), hn::MulAdd(hn::Mul(i_sin_left, i_cos_left), left_d,
                                                    hn::Mul(hn::Mul(i_sin, i_cos), sin_cos_d)));
        mean = hn::Sqrt(hn::Mul(A, hn::Max(B, hn::Zero(d))));
        slope = hn::IfThenElseZero(cut, hn::Div(mean, A));
    }
    const V end = hn::Mul(constant(row.s), mean);
    const V sum = hn::Add(both_integrals(P, M_minus, end, slope, is_cut),
                          both_integrals(hn::Sub(two, P), M_plus, hn::Neg(end), slope, is_cut));
    return hn::Mul(hn::Mul(constant(4 * row.scale), hn::Mul(sin_cos_d, left_d)), sum);
}

void whole_row(const FilterRow& row, const FilterAxis& axis, double* out) {
    const Lanes d;
    const std::size_t step = hn::Lanes(d), count = axis.count();
    std::size_t i = 0;
    for (; i + step <= count; i += step) hn::StoreU(filter(row, axis, i), d, out + i);
    if (i == count) return;
    HWY_ALIGN std::array<double, kMostLanes> rest;
    hn::Store(filter(row, axis, i), d, rest.data());
    std::copy_n(rest.begin(), count - i, out + i);
}

}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace irido {

void filter_row(const FilterRow& row, const FilterAxis& theta_d, double* out, SimdLevel level) {
    IRIDO_DISPATCH(level, whole_row)(row, theta_d, out);
}

}  // namespace irido

#endif
