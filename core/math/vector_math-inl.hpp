// Included once for every instruction set, so no #pragma once: see core/math/vector_math.cpp.
#if defined(IRIDO_VECTOR_MATH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IRIDO_VECTOR_MATH_INL
#undef IRIDO_VECTOR_MATH_INL
#else
#define IRIDO_VECTOR_MATH_INL
#endif

#include <cmath>

#include "core/math/simd_level.hpp"
#include "hwy/contrib/math/math-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<double, kMostLanes>;
using V = hn::Vec<Lanes>;
using Mask = hn::Mask<Lanes>;

HWY_INLINE V constant(double value) {
    return hn::Set(Lanes(), value);
}

struct SinCos {
    V sin, cos;
};

#if HWY_TARGET == HWY_SCALAR

HWY_INLINE SinCos sin_cos(V x) {
    const double value = hn::GetLane(x);
    return {constant(std::sin(value)), constant(std::cos(value))};
}
template <std::size_t count>
HWY_INLINE void sin_cos(const V* x, SinCos* out) {
    for (std::size_t k = 0; k < count; ++k) out[k] = sin_cos(x[k]);
}
HWY_INLINE V exp(V x) {
    return constant(std::exp(hn::GetLane(x)));
}
HWY_INLINE V expm1(V x) {
    return constant(std::expm1(hn::GetLane(x)));
}
HWY_INLINE V asin(V x) {
    return constant(std::asin(hn::GetLane(x)));
}
HWY_INLINE V asinh(V x) {
    return constant(std::asinh(hn::GetLane(x)));
}
HWY_INLINE V atan(V x) {
    return constant(std::atan(hn::GetLane(x)));
}
HWY_INLINE V sin_of_eighth(V x) {
    return constant(std::sin(hn::GetLane(x)));
}

#else

/// Coefficients of x^3, x^5 ... of the sine and of x^4, x^6 ... of the cosine on [-pi/4, pi/4],
/// highest power first; errors below 2^-58.
/// Source: k_sin.c and k_cos.c of FreeBSD's libm (K. C. Ng).
constexpr double kSine[] = {1.58969099521155010221e-10, -2.50507602534068634195e-08,
                            2.75573137070700676789e-06, -1.98412698298579493134e-04,
                            8.33333333332248946124e-03, -1.66666666666666324348e-01};
constexpr double kCosine[] = {-1.13596475577881948265e-11, 2.08757232129817482790e-09,
                              -2.75573143513906633035e-07, 2.48015872894767294178e-05,
                              -1.38888888888741095749e-03, 4.16666666666666019037e-02};

/// Sine and cosine, each within 1 ulp for |x| <= 2^40, of `count` vectors interleaved step by step
/// to hide latency. The nearest multiple of pi/2 is subtracted in three parts, the first exactly
/// thanks to the fused multiply-add, and the rounding error of the remainder is carried along.
/// Source: W. J. Cody and W. Waite, Software Manual for the Elementary Functions (1980), ch. 8.
template <std::size_t count>
HWY_INLINE void sin_cos(const V* HWY_RESTRICT x, SinCos* HWY_RESTRICT out) {
#define IRIDO_FOR_EACH _Pragma("GCC unroll 8") for (std::size_t k = 0; k < count; ++k)
    const Lanes d;
    const hn::RebindToUnsigned<Lanes> bits;
    const hn::RebindToSigned<Lanes> integers;
    // x 2/pi rounded to an integer, which ends up in the low bits of `shifted`
    const V magic = constant(0x1.8p52);
    const V part2 = constant(0x1.1a62633145c07p-54), part3 = constant(-0x1.f1976b7ed8fbcp-110);
    V shifted[count], turns[count], first[count], product[count], r[count], low[count];
    IRIDO_FOR_EACH shifted[k] = hn::MulAdd(x[k], constant(0x1.45f306dc9c883p-1), magic);
    IRIDO_FOR_EACH turns[k] = hn::Sub(shifted[k], magic);
    IRIDO_FOR_EACH first[k] = hn::NegMulAdd(turns[k], constant(0x1.921fb54442d18p0), x[k]);
    IRIDO_FOR_EACH product[k] = hn::Mul(turns[k], part2);
    IRIDO_FOR_EACH r[k] = hn::Sub(first[k], product[k]);
    IRIDO_FOR_EACH {
        const V product_low = hn::MulSub(turns[k], part2, product[k]);
        const V lost_by_r = hn::Sub(hn::Sub(first[k], r[k]), product[k]);
        low[k] = hn::NegMulAdd(turns[k], part3, hn::Sub(lost_by_r, product_low));
    }
    V z[count], s[count], c[count];
    IRIDO_FOR_EACH z[k] = hn::Mul(r[k], r[k]);
    IRIDO_FOR_EACH s[k] = hn::MulAdd(z[k], constant(kSine[0]), constant(kSine[1]));
    IRIDO_FOR_EACH c[k] = hn::MulAdd(z[k], constant(kCosine[0]), constant(kCosine[1]));
    _Pragma("GCC unroll 4") for (std::size_t i = 2; i < 6; ++i) {
        IRIDO_FOR_EACH s[k] = hn::MulAdd(z[k], s[k], constant(kSine[i]));
        IRIDO_FOR_EACH c[k] = hn::MulAdd(z[k], c[k], constant(kCosine[i]));
    }
    IRIDO_FOR_EACH {
        const V half = hn::Mul(z[k], constant(0.5)), near_one = hn::Sub(constant(1), half);
        s[k] = hn::Add(r[k], hn::MulAdd(hn::Mul(r[k], z[k]), s[k], hn::Mul(low[k], near_one)));
        const V lost = hn::Sub(hn::Sub(constant(1), near_one), half);
        c[k] = hn::Add(near_one,
                       hn::MulAdd(hn::Mul(z[k], z[k]), c[k], hn::NegMulAdd(r[k], low[k], lost)));
    }
    IRIDO_FOR_EACH {
        const auto quadrant = hn::BitCast(bits, shifted[k]);
        const auto sign_bit = hn::Set(bits, std::uint64_t{1} << 63);
        const auto is_odd = hn::ShiftLeft<63>(quadrant);
        const Mask odd =
            hn::MaskFromVec(hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(integers, is_odd))));
        const auto sign_of_sine = hn::And(hn::ShiftLeft<62>(quadrant), sign_bit);
        const auto sign_of_cosine = hn::Xor(sign_of_sine, is_odd);
        out[k] = {hn::Xor(hn::IfThenElse(odd, c[k], s[k]), hn::BitCast(d, sign_of_sine)),
                  hn::Xor(hn::IfThenElse(odd, s[k], c[k]), hn::BitCast(d, sign_of_cosine))};
    }
#undef IRIDO_FOR_EACH
}

HWY_INLINE SinCos sin_cos(V x) {
    SinCos out;
    sin_cos<1>(&x, &out);
    return out;
}

HWY_INLINE V exp(V x) {
    return hn::Exp(Lanes(), x);
}
HWY_INLINE V expm1(V x) {
    return hn::Expm1(Lanes(), x);
}
HWY_INLINE V asin(V x) {
    return hn::Asin(Lanes(), x);
}
HWY_INLINE V asinh(V x) {
    return hn::Asinh(Lanes(), x);
}
HWY_INLINE V atan(V x) {
    return hn::Atan(Lanes(), x);
}
/// Sine within 1 ulp for |x| <= pi/4.
HWY_INLINE V sin_of_eighth(V x) {
    const V z = hn::Mul(x, x);
    V s = constant(kSine[0]);
    _Pragma("GCC unroll 5") for (std::size_t i = 1; i < 6; ++i) s =
        hn::MulAdd(z, s, constant(kSine[i]));
    return hn::MulAdd(hn::Mul(x, z), s, x);
}

#endif

}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
