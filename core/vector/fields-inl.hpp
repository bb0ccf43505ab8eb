// Propagation of the fields through layers and groups, for as many points as a vector has lanes.
// Included once per instruction set, so no #pragma once: see kernel.cpp.
#if defined(IRIDO_FIELDS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IRIDO_FIELDS_INL
#undef IRIDO_FIELDS_INL
#else
#define IRIDO_FIELDS_INL
#endif

#include <algorithm>
#include <cmath>

#include "core/coherent/period.hpp"
#include "core/coherent/slab_response.hpp"
#include "core/math/vector_math-inl.hpp"
#include "core/vector/kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

using hn::Abs;
using hn::Add;
using hn::And;
using hn::Div;
using hn::IfThenElse;
using hn::IfThenElseZero;
using hn::Load;
using hn::Max;
using hn::Mul;
using hn::MulAdd;
using hn::NegMulAdd;
using hn::Or;
using hn::Store;
using hn::Sub;

/// Stands in for an exact zero of kz, so that sin(k0 d kz)/kz becomes k0 d.
inline constexpr double kTinyIndex = 1e-140;

/// Fields above this are made smaller, a number of layers below what could overflow, and fields
/// below its inverse larger.
inline constexpr double kLargeField = 1e60, kLittleField = 1e-60, kShrink = 0x1p-200,
                        kShrinkLog = 200 * 0.693147180559945309417;
inline constexpr std::uint32_t kLayersBetweenChecks = 8;

/// Past this logarithm its square could underflow before the fields make up for it.
inline constexpr double kDeepLogScale = 200;

/// Layers whose sines are computed side by side: more would not fit the registers.
inline constexpr std::uint32_t kSideBySide = 4, kAbsorbingSideBySide = 2;

/// A half period with a larger exponent is left to the plain kernel.
inline constexpr double kLargestHalfExponent = 150;

/// A thin layer, |delta|^2, whose depth integrals are summed as series.
inline constexpr double kThinSquare = 0.25;

HWY_INLINE Mask no_lanes() {
    return hn::Lt(constant(0), constant(0));
}

struct Cx {
    V re, im;
};
HWY_INLINE Cx mul(Cx a, Cx b) {
    return {NegMulAdd(a.im, b.im, Mul(a.re, b.re)), MulAdd(a.im, b.re, Mul(a.re, b.im))};
}
/// a b + c
HWY_INLINE Cx mul_add(Cx a, Cx b, Cx c) {
    return {NegMulAdd(a.im, b.im, MulAdd(a.re, b.re, c.re)),
            MulAdd(a.im, b.re, MulAdd(a.re, b.im, c.im))};
}
HWY_INLINE V norm(Cx a) {
    return MulAdd(a.im, a.im, Mul(a.re, a.re));
}
/// Re(conj(a) b)
HWY_INLINE V dot(Cx a, Cx b) {
    return MulAdd(a.im, b.im, Mul(a.re, b.re));
}
HWY_INLINE Cx scaled(Cx a, V f) {
    return {Mul(a.re, f), Mul(a.im, f)};
}
HWY_INLINE V negative(V a) {
    return hn::Neg(a);
}
/// -i a
HWY_INLINE Cx minus_i(Cx a) {
    return {a.im, negative(a.re)};
}

/// Tangential fields (B, C) at a plane, up to exp(log_scale), and the power absorbed below it in
/// the units of the flux Re(conj(B) C), up to exp(2 log_scale).
struct Fields {
    Cx b, c;
    V log_scale, absorbed;
};

/// kz / k0 with a positive imaginary part, and away from exact zeros.
HWY_INLINE Cx upward_root(V x, V y) {
    const V modulus = hn::Sqrt(MulAdd(x, x, Mul(y, y)));
    const V u = Max(hn::Sqrt(Mul(constant(0.5), Add(modulus, Abs(x)))), constant(kTinyIndex));
    const V v = Max(Div(Mul(constant(0.5), Abs(y)), u), constant(kTinyIndex));
    const Mask travels = hn::Ge(x, constant(0));
    return {hn::CopySign(IfThenElse(travels, u, v), Add(y, constant(0))),
            IfThenElse(travels, v, u)};
}

/// Slots of a medium's record, each a vector; complex numbers take two, named by the first.
/// Transparent: kz/k0, then w sd and v sd of the recursion over sin(delta), for s and for p, and
/// the sign of kz^2.
enum TransparentSlot { kPhase, kSw, kSv, kPw, kPv, kSign };
/// Absorbing: kz/k0, then -i w sd and -i v sd over sin(delta). The rest is for depth integrals: kz
/// again (of the substrate too, as eps), what divides by it, Im(eps), w of p and its Im.
enum AbsorbingSlot {
    kPhaseRe = 0,
    kSwRe = 2,
    kSvRe = 4,
    kPwRe = 6,
    kPvRe = 8,
    kKzRe = 10,
    kInvKzRe = 12,
    kInvKzIm,
    kInvNorm,
    kLoss,
    kWRe = 16,
    kEpsRe = 18,
    kLossW = 20,
    kAbsorbingSlots
};
inline constexpr std::size_t kRecord = kAbsorbingSlots * kMostLanes;
/// Slots of a shared layer: its matrix for s and for p, and what belongs to it.
enum SharedTransparent { kCos, kBetaS, kGammaS, kBetaP, kGammaP, kExponent };
enum SharedAbsorbing {
    kCRe = 0,
    kPsRe = 2,
    kQsRe = 4,
    kPpRe = 6,
    kQpRe = 8,
    kDecay = 10,
    kTurn,
    kSharedAbsorbing
};
inline constexpr std::size_t kShared = kSharedAbsorbing * kMostLanes;

HWY_INLINE V slot(const double* record, int index) {
    return Load(Lanes(), record + static_cast<std::size_t>(index) * kMostLanes);
}
HWY_INLINE void put(double* record, int index, V value) {
    Store(value, Lanes(), record + static_cast<std::size_t>(index) * kMostLanes);
}
HWY_INLINE Cx slots(const double* record, int index) {
    return {slot(record, index), slot(record, index + 1)};
}
HWY_INLINE void put(double* record, int index, Cx value) {
    put(record, index, value.re);
    put(record, index + 1, value.im);
}

HWY_INLINE V at(const Stream& stream, std::size_t point) {
    return stream.varies ? hn::LoadU(Lanes(), stream.values + point) : constant(*stream.values);
}

/// Room for `count` numbers that starts where a vector may start.
inline double* aligned_room(std::vector<double>& memory, std::size_t count) {
    memory.resize(count + kMostLanes);
    const auto past = reinterpret_cast<std::uintptr_t>(memory.data()) % (8 * kMostLanes);
    return memory.data() + (past == 0 ? 0 : kMostLanes - past / 8);
}

/// cos, and sin with its medium's factors, of a transparent layer, which may be evanescent.
struct Turn {
    V cos, sin, exponent;
};

HWY_INLINE Turn turn_of(V phase) {
    const SinCos t = sin_cos(phase);
    return {t.cos, t.sin, constant(0)};
}

/// Where sign < 0: cosh and sinh, both times exp(-exponent).
HWY_NOINLINE inline Turn evanescent_turn(V phase, V sign) {
    const Mask evanescent = hn::Lt(sign, constant(0));
    const SinCos t = sin_cos(IfThenElse(evanescent, constant(0), phase));
    const V x = IfThenElseZero(evanescent, phase);
    const V sinh = Mul(constant(-0.5), expm1(Mul(constant(-2), x)));
    return {IfThenElse(evanescent, Sub(constant(1), sinh), t.cos),
            IfThenElse(evanescent, sinh, t.sin), x};
}

HWY_INLINE void grow(Fields& f, V exponent) {
    f.log_scale = Add(f.log_scale, exponent);
}

/// B' = c B - i beta C, C' = c C - i gamma B
HWY_INLINE void through_transparent(Fields& f, V c, V beta, V gamma) {
    const Cx b = f.b, q = f.c;
    f.b = {MulAdd(beta, q.im, Mul(c, b.re)), NegMulAdd(beta, q.re, Mul(c, b.im))};
    f.c = {MulAdd(gamma, b.im, Mul(c, q.re)), NegMulAdd(gamma, b.re, Mul(c, q.im))};
}

template <bool kIsP>
HWY_INLINE void through_transparent(Fields& f, const double* medium, V cos, V sin) {
    through_transparent(f, cos, Mul(slot(medium, kIsP ? kPw : kSw), sin),
                        Mul(slot(medium, kIsP ? kPv : kSv), sin));
}

/// B' = c B + P C, C' = c C + Q B
HWY_INLINE void through_absorbing(Fields& f, Cx c, Cx p, Cx q) {
    const Cx b = f.b, h = f.c;
    f.b = mul_add(p, h, mul(c, b));
    f.c = mul_add(q, b, mul(c, h));
}

/// Keeps fields away from overflow, and from where T would underflow though its logarithm does not.
HWY_INLINE void check_size(Fields& f) {
    const V size = Max(Max(Abs(f.b.re), Abs(f.b.im)), Max(Abs(f.c.re), Abs(f.c.im)));
    const Mask large = hn::Gt(size, constant(kLargeField));
    const Mask little = hn::Lt(size, constant(kLittleField));
    if (HWY_LIKELY(hn::AllFalse(Lanes(), Or(large, little)))) return;
    const V factor = IfThenElse(large, constant(kShrink),
                                IfThenElse(little, constant(1 / kShrink), constant(1)));
    f.b = scaled(f.b, factor);
    f.c = scaled(f.c, factor);
    f.absorbed = Mul(f.absorbed, Mul(factor, factor));
    grow(f, IfThenElse(large, constant(kShrinkLog), IfThenElseZero(little, constant(-kShrinkLog))));
}

/// Stored rows of one polarization, see FixedRun: the fields, or a matrix for them.
HWY_INLINE void through_fixed(Program::Kind kind, const double* first, Fields& f) {
    const auto row = [=](std::size_t r)
                         HWY_ATTR { return hn::LoadU(Lanes(), first + r * kMostLanes); };
    if (kind == Program::Kind::fixed_fields) {
        f.b = {row(0), row(1)};
        f.c = {row(2), row(3)};
        f.log_scale = row(4);
        return;
    }
    const Cx b = f.b, c = f.c;
    if (kind == Program::Kind::fixed_real) {
        const V gamma = row(1), beta = row(2);
        f.b = {MulAdd(beta, c.im, Mul(row(0), b.re)), NegMulAdd(beta, c.re, Mul(row(0), b.im))};
        f.c = {MulAdd(gamma, b.im, Mul(row(3), c.re)), NegMulAdd(gamma, b.re, Mul(row(3), c.im))};
        grow(f, row(4));
    } else {
        f.b = mul_add({row(4), row(5)}, c, mul({row(0), row(1)}, b));
        f.c = mul_add({row(2), row(3)}, b, mul({row(6), row(7)}, c));
        grow(f, row(8));
    }
    check_size(f);
}

/// A period [[1 + a, -i beta], [-i gamma, 1 + d]] of real a, beta, gamma, d.
struct Period {
    V a, beta, gamma, d;
};
HWY_INLINE Period product(const Period& u, const Period& l) {
    return {NegMulAdd(u.beta, l.gamma, MulAdd(u.a, l.a, Add(u.a, l.a))),
            MulAdd(u.beta, l.d, MulAdd(u.a, l.beta, Add(u.beta, l.beta))),
            MulAdd(u.gamma, l.a, MulAdd(u.d, l.gamma, Add(u.gamma, l.gamma))),
            NegMulAdd(u.gamma, l.beta, MulAdd(u.d, l.d, Add(u.d, l.d)))};
}

/// The fields above `repeat` periods:
///     M^N = cos(N K) I + sin(N K)/sin(K) (M - cos(K) I)
/// by the half angle's squares, as power() in period.hpp has it; K is real in bands and imaginary
/// (+ pi) in gaps.
HWY_NOINLINE inline void through_periods(Fields& f, const Period& m, V sin2, V cos2,
                                         double repeat) {
    const V n = constant(repeat), one = constant(1), two = constant(2);
    const Mask flip = hn::Lt(cos2, sin2);  // by sign in gaps, where one of them is negative
    const V small = IfThenElse(flip, cos2, sin2);
    const Mask band = hn::Ge(small, constant(0));
    const V root = hn::Sqrt(Abs(small));
    const bool bands = !hn::AllFalse(Lanes(), band), gaps = !hn::AllTrue(Lanes(), band);
    const V zero = constant(0);
    V half_k = zero;
    if (bands) half_k = asin(hn::Min(IfThenElseZero(band, root), one));
    if (gaps) half_k = IfThenElse(band, half_k, asinh(root));
    // sin K or sinh Im K, and the entries such that they belong together, as traceless_of() in
    // period.cpp
    const V other = hn::Sqrt(Sub(one, small)), sine = Mul(two, Mul(root, other));
    const V sine2 = Mul(Mul(constant(4), small), Sub(one, small));
    V traceless = Mul(constant(0.5), Sub(m.a, m.d)), beta = m.beta, gamma = m.gamma;
    const V square = Mul(traceless, traceless), product = Mul(beta, gamma);
    const V target = Add(sine2, square);
    const Mask by_trace = hn::Gt(square, Abs(product));
    const Mask by_beta = hn::Gt(Abs(gamma), Abs(beta));
    const V larger = IfThenElse(by_beta, gamma, beta);
    const V smaller = IfThenElse(hn::Eq(larger, constant(0)), constant(0), Div(target, larger));
    traceless = IfThenElse(by_trace,
                           hn::CopySign(hn::Sqrt(Max(Sub(product, sine2), constant(0))), traceless),
                           traceless);
    beta = IfThenElse(hn::AndNot(by_trace, by_beta), smaller, beta);
    gamma = IfThenElse(Or(by_trace, by_beta), gamma, smaller);
    // cos(N K) and sin(N K), or cosh and sinh times exp(-N Im K)
    const V nk = Mul(n, Mul(two, half_k)), exponent = IfThenElse(band, zero, nk);
    SinCos turn{zero, zero};
    V decay = one;
    if (bands) turn = sin_cos(IfThenElseZero(band, nk));
    if (gaps) {
        const V sinh = Mul(constant(-0.5), expm1(Mul(constant(-2), exponent)));
        turn = {IfThenElse(band, turn.sin, sinh), IfThenElse(band, turn.cos, Sub(one, sinh))};
        decay = exp(Mul(constant(-2), exponent));
        f.absorbed = Mul(f.absorbed, decay);
        grow(f, exponent);
    }
    const Mask still = hn::Lt(nk, constant(1e-9));
    const V ratio = IfThenElse(still, n, Div(turn.sin, sine));
    const bool odd = std::fmod(repeat, 2) == 1;
    const V sign = IfThenElse(flip, constant(odd ? -1 : 1), one);
    const V factor = Mul(IfThenElse(flip, negative(sign), sign), ratio);
    const V diagonal = Mul(sign, turn.cos), part = Mul(factor, traceless);
    V alpha = Add(diagonal, part), delta = Sub(diagonal, part);
    if (gaps) {
        // the smaller entry is exp(-N Im K) + ratio (sine - |traceless|), of which neither cancels
        const V less = Div(Mul(beta, gamma), Add(sine, Abs(traceless)));
        const V small_entry = Mul(sign, NegMulAdd(ratio, less, decay));
        const Mask deep = hn::Gt(exponent, one);
        const Mask opposed = hn::Lt(Mul(part, sign), zero);
        alpha = IfThenElse(And(deep, opposed), small_entry, alpha);
        delta = IfThenElse(hn::AndNot(opposed, deep), small_entry, delta);
    }
    beta = Mul(factor, beta);
    gamma = Mul(factor, gamma);
    const Cx b = f.b, c = f.c;
    f.b = {MulAdd(beta, c.im, Mul(alpha, b.re)), NegMulAdd(beta, c.re, Mul(alpha, b.im))};
    f.c = {MulAdd(gamma, b.im, Mul(delta, c.re)), NegMulAdd(gamma, b.re, Mul(delta, c.im))};
}

/// Integrals over the depth of an absorbing layer as in layer.cpp, times exp(-2 Im delta) k0.
struct DepthIntegrals {
    V cc, ss;
    Cx cs;
};

/// 2 sum_{m>=1} h_{m-1}(u, v)/(2m+1)! as sine_square_series() of layer.cpp.
HWY_NOINLINE inline V sine_square_series(V a, V b) {
    const V u = Mul(constant(4), Mul(b, b)), v = Mul(constant(-4), Mul(a, a));
    V h = constant(1), v_power = constant(1), sum = constant(1.0 / 6);
    double factorial = 6;
    for (int m = 2; m <= 12; ++m) {
        v_power = Mul(v_power, v);
        h = MulAdd(u, h, v_power);
        factorial *= 2.0 * m * (2.0 * m + 1);
        sum = MulAdd(h, constant(1 / factorial), sum);
    }
    return Mul(constant(2), sum);
}

/// less = (1 - e)/2 and e = exp(-2 Im delta), each with its own digits.
HWY_INLINE DepthIntegrals depth_integrals(const double* medium, Cx phase, SinCos turn, V less, V e,
                                          V k0_d) {
    // hyperbolic = h+ h-/Im kz, circular = exp(-2b) sin a cos a/Re kz
    const V more = Sub(constant(1), less);
    const V hyperbolic = Mul(Mul(more, less), slot(medium, kInvKzIm));
    const V sine_over_kz = Mul(turn.sin, slot(medium, kInvKzRe));
    const V circular = Mul(e, Mul(sine_over_kz, turn.cos));
    const V half = constant(0.5), inverse = slot(medium, kInvNorm);
    DepthIntegrals result;
    result.cc = Mul(half, Add(hyperbolic, circular));
    result.ss = Mul(Mul(half, inverse), Sub(hyperbolic, circular));
    const V square = norm(phase);
    const Mask thin = hn::Lt(square, constant(kThinSquare));
    if (HWY_UNLIKELY(!hn::AllFalse(Lanes(), thin))) {
        const V series =
            sine_square_series(IfThenElseZero(thin, phase.re), IfThenElseZero(thin, phase.im));
        // the series is that of the unscaled integral
        const V cube = Mul(k0_d, Mul(k0_d, k0_d));
        result.ss = IfThenElse(thin, Mul(e, Mul(cube, series)), result.ss);
    }
    const V x = Mul(e, Mul(turn.sin, sine_over_kz));
    const V y = Mul(Mul(less, less), slot(medium, kInvKzIm));
    result.cs = scaled(mul({x, negative(y)}, slots(medium, kKzRe)), Mul(half, inverse));
    return result;
}

/// Power absorbed in a layer, times exp(-2 Im delta), as a form in the fields at its lower face:
/// bb |B|^2 + cc |C|^2 + 2 Re(conj(B) bc C).
struct AbsorbedForm {
    V bb, cc;
    Cx bc;
};
template <bool kIsP>
HWY_INLINE AbsorbedForm absorbed_form(const double* medium, const DepthIntegrals& i) {
    const V loss = slot(medium, kLoss);
    const Cx conj_cs{i.cs.re, negative(i.cs.im)};
    if constexpr (!kIsP) {  // w = 1
        return {Mul(loss, i.cc), Mul(loss, i.ss), scaled(minus_i(conj_cs), loss)};
    } else {
        const Cx w = slots(medium, kWRe), v = slots(medium, kEpsRe);
        const V loss_w = slot(medium, kLossW);
        const V bb = MulAdd(loss, i.cc, Mul(loss_w, Mul(norm(v), i.ss)));
        const V cc = MulAdd(loss, Mul(norm(w), i.ss), Mul(loss_w, i.cc));
        const Cx minus_iv = minus_i(v);
        const Cx first = scaled(mul(minus_i(w), conj_cs), loss);
        const Cx second = scaled(mul({minus_iv.re, negative(minus_iv.im)}, i.cs), loss_w);
        return {bb, cc, {Add(first.re, second.re), Add(first.im, second.im)}};
    }
}
HWY_INLINE V absorbed_in(const Fields& f, const AbsorbedForm& form) {
    const V both = Mul(constant(2), dot(f.b, mul(form.bc, f.c)));
    return MulAdd(form.bb, norm(f.b), MulAdd(form.cc, norm(f.c), both));
}

}  // namespace
}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
