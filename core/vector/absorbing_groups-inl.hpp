// The fields through repeated groups some of whose layers absorb. The plain twin is power() of
// core/coherent/period.hpp. Included once for every instruction set, so no #pragma once: see
// kernel.cpp.
#if defined(IRIDO_ABSORBING_GROUPS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IRIDO_ABSORBING_GROUPS_INL
#undef IRIDO_ABSORBING_GROUPS_INL
#else
#define IRIDO_ABSORBING_GROUPS_INL
#endif

#include "core/vector/groups-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

HWY_INLINE Cx plus(Cx a, Cx b) {
    return {Add(a.re, b.re), Add(a.im, b.im)};
}
HWY_INLINE Cx minus(Cx a, Cx b) {
    return {Sub(a.re, b.re), Sub(a.im, b.im)};
}
HWY_INLINE Cx negative(Cx a) {
    return {negative(a.re), negative(a.im)};
}
HWY_INLINE Cx one_minus(Cx a) {
    return {Sub(constant(1), a.re), negative(a.im)};
}
HWY_INLINE Cx choose(Mask which, Cx yes, Cx no) {
    return {IfThenElse(which, yes.re, no.re), IfThenElse(which, yes.im, no.im)};
}
/// a/b, 0 where b is
HWY_INLINE Cx quotient(Cx a, Cx b) {
    const V size = Max(Abs(b.re), Abs(b.im));
    const V down = IfThenElseZero(hn::Gt(size, constant(0)), Div(constant(1), size));
    const Cx unit = scaled(b, down);
    const V square = Max(norm(unit), constant(0.5));
    const Cx over = scaled(mul(a, {unit.re, negative(unit.im)}), down);
    return {Div(over.re, square), Div(over.im, square)};
}
/// The root with a real part of 0 or more.
HWY_INLINE Cx root_of(Cx a) {
    const V modulus = hn::Sqrt(norm(a)), half = constant(0.5);
    const V u = hn::Sqrt(Mul(half, Add(modulus, Abs(a.re))));
    const V v = IfThenElseZero(hn::Gt(u, constant(0)), Div(Mul(half, Abs(a.im)), u));
    const Mask right = hn::Ge(a.re, constant(0));
    return {IfThenElse(right, u, v), hn::CopySign(IfThenElse(right, v, u), a.im)};
}

/// A layer or a period [[1 + a, b], [c, 1 + d]].
struct LossyPeriod {
    Cx a, b, c, d;
};
HWY_INLINE LossyPeriod product(const LossyPeriod& u, const LossyPeriod& l) {
    return {mul_add(u.b, l.c, mul_add(u.a, l.a, plus(u.a, l.a))),
            mul_add(u.b, l.d, mul_add(u.a, l.b, plus(u.b, l.b))),
            mul_add(u.c, l.a, mul_add(u.d, l.c, plus(u.c, l.c))),
            mul_add(u.c, l.b, mul_add(u.d, l.d, plus(u.d, l.d)))};
}

/// Half of a layer: [[cos, b], [c, cos]].
struct LossyHalf {
    Cx cos, b, c;
};
HWY_INLINE LossyPeriod whole_of(const LossyHalf& half) {
    const V two = constant(2);
    const Cx less = scaled(mul(half.b, half.c), two);
    return {less, scaled(mul(half.cos, half.b), two), scaled(mul(half.cos, half.c), two), less};
}

/// sin(K/2)^2 and cos(K/2)^2 of the Bloch phase K.
struct LossyPhase {
    Cx sin2, cos2;
};
/// As bloch_phase_of_pair() of period.cpp.
HWY_INLINE LossyPhase phase_of_pair(const LossyHalf& u, const LossyHalf& l) {
    const Cx b = mul_add(u.cos, l.b, mul(u.b, l.cos)), c = mul_add(u.cos, l.c, mul(u.c, l.cos));
    const Cx cosines = mul(u.cos, l.cos);
    return {negative(mul(b, c)), mul(mul_add(u.b, l.c, cosines), mul_add(u.c, l.b, cosines))};
}
/// As bloch_phase_of_matrix() of period.cpp.
HWY_INLINE LossyPhase phase_of_period(const LossyPeriod& m) {
    LossyPhase phase;
    phase.sin2 = scaled(plus(m.a, m.d), constant(-0.25));
    phase.cos2 = one_minus(phase.sin2);
    const Cx traceless = scaled(minus(m.a, m.d), constant(0.5));
    const auto size = [](Cx z) HWY_ATTR { return hn::Sqrt(norm(z)); };
    const Mask nearly =
        hn::Lt(Add(size(traceless), Add(size(m.b), size(m.c))), constant(kNearlyIdentity));
    if (HWY_LIKELY(hn::AllFalse(Lanes(), nearly))) return phase;
    const Cx all = scaled(mul_add(traceless, traceless, mul(m.b, m.c)), constant(-0.25));
    const Mask flip = hn::Lt(norm(phase.cos2), norm(phase.sin2));
    const Cx small = quotient(all, choose(flip, phase.sin2, phase.cos2));
    phase.sin2 = choose(hn::AndNot(flip, nearly), small, phase.sin2);
    phase.cos2 = choose(And(nearly, flip), small, phase.cos2);
    return phase;
}

/// The entries without cos(K) I, as traceless_of() of period.cpp: [[t, b], [c, -t]].
struct LossyTraceless {
    Cx t, b, c;
};
HWY_INLINE LossyTraceless traceless_of(const LossyPeriod& m, Cx sine2) {
    LossyTraceless of{scaled(minus(m.a, m.d), constant(0.5)), m.b, m.c};
    const Cx square = mul(of.t, of.t), product = mul(of.b, of.c);
    const Mask by_trace = hn::Gt(norm(square), norm(product));
    const Mask upper = hn::Gt(norm(of.c), norm(of.b));
    const Cx root = root_of(negative(plus(sine2, product)));
    const Mask turned = hn::Lt(dot(root, of.t), constant(0));
    const Cx smaller = quotient(negative(plus(sine2, square)), choose(upper, of.c, of.b));
    of.t = choose(by_trace, choose(turned, negative(root), root), of.t);
    of.b = choose(hn::AndNot(by_trace, upper), smaller, of.b);
    of.c = choose(Or(by_trace, upper), of.c, smaller);
    return of;
}

/// The fields above `repeat` periods, as power() of period.cpp has it.
HWY_NOINLINE inline void through_lossy_periods(Fields& f, const LossyPeriod& m,
                                               const LossyPhase& phase, double repeat) {
    const V n = constant(repeat), one = constant(1), two = constant(2), zero = constant(0);
    const Mask flip = hn::Lt(norm(phase.cos2), norm(phase.sin2));
    const Cx small = choose(flip, phase.cos2, phase.sin2), larger = one_minus(small);
    const Cx root = root_of(small), other = root_of(larger);
    // K/2 = asin(root): sin a cosh b = Re(root), cos a sinh b = Im(root), cos a cosh b = Re(other)
    const V tangent = Div(root.re, Max(other.re, constant(1e-300)));
    const V b = asinh(Mul(root.im, hn::Sqrt(MulAdd(tangent, tangent, one))));
    const Mask back = hn::Lt(b, zero);
    const V a = atan(tangent), sign_of_k = IfThenElse(back, constant(-1), one);
    const Cx sine = scaled(mul(root, other), Mul(two, sign_of_k));
    const LossyTraceless of = traceless_of(m, scaled(mul(small, larger), constant(4)));
    // cos(N K) and sin(N K), times exp(-N Im K)
    const V twice_n = Mul(two, n), turn = Mul(twice_n, Mul(a, sign_of_k));
    const V exponent = Mul(twice_n, Abs(b));
    const SinCos t = sin_cos(turn);
    const V less = Mul(constant(-0.5), expm1(Mul(constant(-2), exponent)));
    const V more = Sub(one, less);
    const Cx sine_n{Mul(t.sin, more), Mul(t.cos, less)};
    const Mask still = hn::Lt(MulAdd(turn, turn, Mul(exponent, exponent)), constant(1e-18));
    const Cx ratio = choose(still, {n, zero}, quotient(sine_n, sine));
    const bool odd = std::fmod(repeat, 2) == 1;
    const V sign = IfThenElse(flip, constant(odd ? -1 : 1), one);
    const Cx factor = scaled(ratio, IfThenElse(flip, negative(sign), sign));
    const Cx diagonal = scaled({Mul(t.cos, more), negative(Mul(t.sin, less))}, sign);
    const Cx part = mul(factor, of.t);
    Cx alpha = plus(diagonal, part), delta = minus(diagonal, part);
    const Mask deep = hn::Gt(exponent, one);
    if (!hn::AllFalse(Lanes(), deep)) {
        // the smaller entry is exp(i N K) + ratio (-i sin K - |t|), of which neither cancels
        const Cx sigma = minus_i(sine);
        const Mask below = hn::Gt(dot(of.t, sigma), zero);
        const Cx rest = quotient(mul(of.b, of.c), plus(sigma, choose(below, of.t, negative(of.t))));
        const V decay = Mul(sign, exp(Mul(constant(-2), exponent)));
        const Cx entry = mul_add(scaled(ratio, sign), rest, {Mul(t.cos, decay), Mul(t.sin, decay)});
        const Mask lower = hn::Xor(below, flip);
        delta = choose(And(deep, lower), entry, delta);
        alpha = choose(hn::AndNot(lower, deep), entry, alpha);
    }
    const Cx before = f.b, c = f.c;
    f.b = mul_add(mul(factor, of.b), c, mul(alpha, before));
    f.c = mul_add(mul(factor, of.c), before, mul(delta, c));
    grow(f, exponent);
    check_size(f);
}

/// Steps of groups with absorbing layers.
struct AbsorbingGroupsRun : GroupsRun {
    using GroupsRun::GroupsRun;

    /// Half of a layer, whose decay is in it and is added to the exponent.
    struct HalfTurn {
        Cx cos, sin;
    };
    HWY_INLINE HalfTurn lossy_half_turn(std::uint32_t layer, V k0, Mask& bad, V& exponent,
                                        V& dying) const {
        const V zero = constant(0);
        if (!program_.media[program_.layers[layer].medium].absorbs) {
            const Turn t = half_turn(layer, k0, bad, exponent);
            return {{t.cos, zero}, {t.sin, zero}};
        }
        const V half = Mul(constant(0.5), vacuum_phase(layer, k0)),
                most = constant(kLargestHalfExponent);
        const AbsorbingTurn t = absorbing_turn(layer, half);
        exponent = Add(exponent, t.phase.im);
        bad = Or(bad, hn::Gt(exponent, most));
        if (wants_denominators_)
            dying = dying_turn(Add(t.phase.re, t.phase.re), Add(t.phase.im, t.phase.im), dying);
        const V growth = exp(hn::Min(t.phase.im, most));
        return {scaled(t.cos, growth), scaled(t.sin, growth)};
    }

    template <bool kIsP>
    HWY_INLINE LossyHalf coupled(std::uint32_t layer, const HalfTurn& t) const {
        const double* medium = record(layer);
        if (program_.media[program_.layers[layer].medium].absorbs)
            return {t.cos, mul(slots(medium, kIsP ? kPwRe : kSwRe), t.sin),
                    mul(slots(medium, kIsP ? kPvRe : kSvRe), t.sin)};
        const Cx turned = minus_i(t.sin);
        return {t.cos, scaled(turned, slot(medium, kIsP ? kPw : kSw)),
                scaled(turned, slot(medium, kIsP ? kPv : kSv))};
    }

    struct LossyStep {
        LossyPeriod period;
        LossyHalf below;
        LossyPhase phase;
    };
    template <bool kIsP>
    HWY_INLINE void add_lossy_layer(LossyStep& of, std::uint32_t layer, const HalfTurn& turn,
                                    bool is_upper_of_pair) const {
        const LossyHalf half = coupled<kIsP>(layer, turn);
        of.period = product(whole_of(half), of.period);
        if (is_upper_of_pair) of.phase = phase_of_pair(half, of.below);
        of.below = half;
    }

    template <bool kS, bool kP>
    HWY_NOINLINE void absorbing_group_step(const Program::Step& step, V k0, Fields& s, Fields& p,
                                           V& dying, Mask& bad) const {
        const V zero = constant(0);
        const Cx none{zero, zero};
        LossyStep in_s{{none, none, none, none}, {none, none, none}, {none, none}};
        LossyStep in_p = in_s;
        V exponent = zero, turn = zero;
        for (std::uint32_t i = 0; i < step.count; ++i) {
            const std::uint32_t layer = program_.order[step.first + i];
            const HalfTurn half = lossy_half_turn(layer, k0, bad, exponent, turn);
            const bool is_upper_of_pair = i == 1 && step.count == 2;
            if (kS) add_lossy_layer<false>(in_s, layer, half, is_upper_of_pair);
            if (kP) add_lossy_layer<true>(in_p, layer, half, is_upper_of_pair);
        }
        if (step.count != 2) {
            if (kS) in_s.phase = phase_of_period(in_s.period);
            if (kP) in_p.phase = phase_of_period(in_p.period);
        }
        if (kS) through_lossy_periods(s, in_s.period, in_s.phase, step.repeat);
        if (kP) through_lossy_periods(p, in_p.period, in_p.phase, step.repeat);
        dying = MulAdd(constant(step.repeat), turn, dying);
    }
};

}  // namespace
}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
