// Included once per instruction set, so no #pragma once: see core/math/vector_math-inl.hpp.
#if defined(IRIDO_REPRODUCIBLE_MATH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IRIDO_REPRODUCIBLE_MATH_INL
#undef IRIDO_REPRODUCIBLE_MATH_INL
#else
#define IRIDO_REPRODUCIBLE_MATH_INL
#endif

#include "core/math/vector_math-inl.hpp"

/// Arithmetic with identical bits at every SIMD level: no fused operations, and only steps that
/// IEEE 754 rounds correctly. A search amplifies the smallest difference, so otherwise two machines
/// would find different stacks.
HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

HWY_INLINE V add_product(V sum, V a, V b) {
    return hn::Add(sum, hn::Mul(a, b));
}
HWY_INLINE V less_product(V sum, V a, V b) {
    return hn::Sub(sum, hn::Mul(a, b));
}

/// Sine and cosine, each within 2 ulp of 1 for |x| <= 1e6: the nearest multiple of pi/2 is
/// subtracted in three 33-bit parts, so that the products are exact.
/// Source: coefficients and parts of FreeBSD's libm (K. C. Ng), as in vector_math-inl.hpp.
HWY_INLINE SinCos reproducible_sin_cos(V x) {
    constexpr double kSin[] = {1.58969099521155010221e-10, -2.50507602534068634195e-08,
                               2.75573137070700676789e-06, -1.98412698298579493134e-04,
                               8.33333333332248946124e-03, -1.66666666666666324348e-01};
    constexpr double kCos[] = {-1.13596475577881948265e-11, 2.08757232129817482790e-09,
                               -2.75573143513906633035e-07, 2.48015872894767294178e-05,
                               -1.38888888888741095749e-03, 4.16666666666666019037e-02};
    const Lanes d;
    const hn::RebindToUnsigned<Lanes> bits;
    const V magic = constant(0x1.8p52);
    const V shifted = add_product(magic, x, constant(0x1.45f306dc9c883p-1));
    const V turns = hn::Sub(shifted, magic);
    V r = less_product(x, turns, constant(1.57079632673412561417e+00));
    r = less_product(r, turns, constant(6.07710050630396597660e-11));
    r = less_product(r, turns, constant(2.02226624879595063154e-21));
    const V z = hn::Mul(r, r);
    V s = constant(kSin[0]), c = constant(kCos[0]);
    for (std::size_t i = 1; i < 6; ++i) {
        s = add_product(constant(kSin[i]), z, s);
        c = add_product(constant(kCos[i]), z, c);
    }
    s = add_product(r, hn::Mul(r, z), s);
    c = hn::Add(less_product(constant(1), z, constant(0.5)), hn::Mul(hn::Mul(z, z), c));
    const auto quadrant = hn::BitCast(bits, shifted);
    const auto one = hn::Set(bits, 1), two = hn::Set(bits, 2);
    const auto zero = hn::Zero(bits);
    const Mask odd = hn::MaskFromVec(
        hn::BitCast(d, hn::VecFromMask(bits, hn::Ne(hn::And(quadrant, one), zero))));
    const auto sine_sign = hn::ShiftLeft<62>(hn::And(quadrant, two));
    const auto cosine_sign = hn::ShiftLeft<62>(hn::And(hn::Add(quadrant, one), two));
    return {hn::Xor(hn::IfThenElse(odd, c, s), hn::BitCast(d, sine_sign)),
            hn::Xor(hn::IfThenElse(odd, s, c), hn::BitCast(d, cosine_sign))};
}

/// exp(-x) to a few ulp for x in [0, 700], clamped to that range.
HWY_INLINE V reproducible_decay(V x) {
    const Lanes d;
    const hn::RebindToUnsigned<Lanes> bits;
    const V magic = constant(0x1.8p52);
    const V y = hn::Neg(hn::Min(hn::Max(x, constant(0)), constant(700)));
    const V shifted = add_product(magic, y, constant(0x1.71547652b82fep0));
    const V power = hn::Sub(shifted, magic);
    V r = less_product(y, power, constant(6.93147180369123816490e-01));
    r = less_product(r, power, constant(1.90821492927058770002e-10));
    V sum = constant(1);
    for (int n = 14; n > 0; --n) sum = add_product(constant(1), hn::Mul(r, constant(1.0 / n)), sum);
    const auto exponent =
        hn::ShiftLeft<52>(hn::Add(hn::BitCast(bits, shifted), hn::Set(bits, 1023)));
    return hn::Mul(sum, hn::BitCast(d, exponent));
}

/// One complex number per lane.
struct CV {
    V re, im;
};
HWY_INLINE CV operator+(CV a, CV b) {
    return {hn::Add(a.re, b.re), hn::Add(a.im, b.im)};
}
HWY_INLINE CV operator-(CV a, CV b) {
    return {hn::Sub(a.re, b.re), hn::Sub(a.im, b.im)};
}
HWY_INLINE CV operator*(CV a, CV b) {
    return {hn::Sub(hn::Mul(a.re, b.re), hn::Mul(a.im, b.im)),
            hn::Add(hn::Mul(a.re, b.im), hn::Mul(a.im, b.re))};
}
HWY_INLINE CV operator*(V f, CV a) {
    return {hn::Mul(f, a.re), hn::Mul(f, a.im)};
}
/// -i a
HWY_INLINE CV turned(CV a) {
    return {a.im, hn::Neg(a.re)};
}
HWY_INLINE CV conjugate(CV a) {
    return {a.re, hn::Neg(a.im)};
}
HWY_INLINE V norm(CV a) {
    return hn::Add(hn::Mul(a.re, a.re), hn::Mul(a.im, a.im));
}
HWY_INLINE CV inverse(CV a) {
    const V n = norm(a);
    return {hn::Div(a.re, n), hn::Neg(hn::Div(a.im, n))};
}

}  // namespace
}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
