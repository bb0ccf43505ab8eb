// Closed form of many periods of two transparent layers embedded in the material of one of them,
// for as many points as a vector has lanes: mirror_power() of hosted_mirror.hpp, and its
// denominator. Included once per instruction set, so no #pragma once: see kernel.cpp.
#if defined(IRIDO_MIRROR_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IRIDO_MIRROR_INL
#undef IRIDO_MIRROR_INL
#else
#define IRIDO_MIRROR_INL
#endif

#include "core/vector/fields-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

/// Logarithm of about kLargeField.
inline constexpr double kLargestLog = 138;

/// Admittances of the two layers in one polarization: with q that of the other layer over the
/// host's, the other layer's beta and gamma are 1/q and q times its sine. All of them are real for
/// evanescent layers too, where 1/q and q stand for -i/q and -i q.
struct MirrorMedia {
    V inverse, ratio;  ///< 1/q and q
    V contrast;        ///< q - 1/q
    V size;            ///< |Y0 B + C| without a mirror: 2 Re(conj(B) C) of the incident wave
};

/// Half of both layers: cos and sin of a/2 and b/2; cosh and sinh where the other is evanescent.
struct MirrorHalves {
    SinCos host, other;
    V sign;  ///< of kz^2 of the other layer
};

struct MirrorEnds {
    V R, T;
    Cx sum;  ///< Y0 B + C, without exp(log_scale)
    V log_scale;
};

/// sin(K/2)^2 or cos(K/2)^2, the smaller one, and C, as in mirror_power() of hosted_mirror.hpp.
struct MirrorPhase {
    V small, C;
    Mask flip;  ///< it is cos(K/2)^2: K is pi minus the phase of `small`
};
HWY_INLINE MirrorPhase mirror_phase(const MirrorMedia& m, const MirrorHalves& h) {
    const V straight = Mul(h.host.sin, h.other.cos), crossed = Mul(h.host.cos, h.other.sin);
    const V both_cos = Mul(h.host.cos, h.other.cos), both_sin = Mul(h.host.sin, h.other.sin);
    const V sin2 = Mul(MulAdd(m.ratio, crossed, straight), MulAdd(m.inverse, crossed, straight));
    const V cos2 =
        Mul(NegMulAdd(m.ratio, both_sin, both_cos), NegMulAdd(m.inverse, both_sin, both_cos));
    const Mask flip = hn::Lt(cos2, sin2);  // by sign in gaps, where one of them is negative
    return {IfThenElse(flip, cos2, sin2), Mul(m.contrast, Mul(h.other.sin, h.other.cos)), flip};
}

/// Y0 B + C = size (cos NK - i U (sin a cos b + (q + 1/q)/2 cos a sin b)), all times
/// exp(-log_scale).
HWY_INLINE Cx mirror_sum(const MirrorMedia& m, const MirrorHalves& h, V cos_nk, V U) {
    const V two = constant(2), one = constant(1);
    const V sin_a = Mul(two, Mul(h.host.sin, h.host.cos));
    const V cos_a = NegMulAdd(Mul(two, h.host.sin), h.host.sin, one);
    const V cos_b = NegMulAdd(Mul(two, h.sign), Mul(h.other.sin, h.other.sin), one);
    const V mean = Mul(Add(m.ratio, m.inverse), Mul(h.other.sin, h.other.cos));
    const V turn = MulAdd(sin_a, cos_b, Mul(cos_a, mean));
    return {Mul(m.size, cos_nk), negative(Mul(m.size, Mul(U, turn)))};
}

/// Of cos NK and U where K is pi - K'.
struct MirrorSigns {
    V cos, U;
};
HWY_INLINE MirrorSigns mirror_signs(Mask flip, double repeat) {
    const bool odd = std::fmod(repeat, 2) == 1;
    const V one = constant(1), turned = IfThenElse(flip, constant(-1), one);
    return {odd ? turned : one, odd ? one : turned};
}

/// For each of `count` polarizations, step by step for all of them, so that no step waits for the
/// one before.
#define IRIDO_FOR_EACH _Pragma("GCC unroll 2") for (std::size_t i = 0; i < count; ++i)

/// N K and sin(K) of K' or of i K: imaginary where it is no band.
template <std::size_t count>
struct MirrorBloch {
    V nk[count], sine[count];
    Mask band[count];
    bool gaps;  ///< in some lane
};
template <std::size_t count>
HWY_INLINE void mirror_bloch(const MirrorPhase* phase, V n, MirrorBloch<count>& bloch) {
    const V zero = constant(0), one = constant(1), two = constant(2);
    V root[count], half_k[count];
    Mask all_bands = hn::Not(no_lanes()), any_band = no_lanes();
    IRIDO_FOR_EACH {
        bloch.band[i] = hn::Ge(phase[i].small, zero);
        all_bands = And(all_bands, bloch.band[i]);
        any_band = Or(any_band, bloch.band[i]);
        root[i] = hn::Sqrt(Abs(phase[i].small));
        half_k[i] = zero;
    }
    bloch.gaps = !hn::AllTrue(Lanes(), all_bands);
    if (!hn::AllFalse(Lanes(), any_band)) {
        IRIDO_FOR_EACH half_k[i] = asin(hn::Min(IfThenElseZero(bloch.band[i], root[i]), one));
    }
    if (bloch.gaps) {
        IRIDO_FOR_EACH half_k[i] = IfThenElse(bloch.band[i], half_k[i], asinh(root[i]));
    }
    IRIDO_FOR_EACH {
        bloch.sine[i] = Mul(two, Mul(root[i], hn::Sqrt(Sub(one, phase[i].small))));
        bloch.nk[i] = Mul(n, Mul(two, half_k[i]));
    }
}

/// sinh and cosh times exp(-nk), and exp(-2 nk), in gaps.
struct MirrorDecay {
    SinCos turn;
    V square;
};
HWY_INLINE MirrorDecay mirror_decay(V nk, Mask band) {
    const V half = constant(0.5), minus_2nk = Mul(constant(-2), nk), square = exp(minus_2nk);
    V less = Sub(constant(1), square);
    const Mask cancels = hn::Gt(square, half);
    if (!hn::AllFalse(Lanes(), hn::AndNot(band, cancels)))
        less = IfThenElse(cancels, negative(expm1(minus_2nk)), less);
    return {{Mul(half, less), MulAdd(half, square, half)}, square};
}

/// mirror_power() as R = Z/(e + Z) and T = e/(e + Z), Z = e C^2 U^2: in bands e = 1, in gaps, where
/// K is imaginary, e = exp(-2 N Im K); and the denominator.
template <std::size_t count>
HWY_INLINE void mirror_ends(const MirrorMedia* m, const MirrorHalves& halves, double repeat,
                            bool with_sum, MirrorEnds* out) {
    const V zero = constant(0), one = constant(1), n = constant(repeat);
    MirrorPhase phase[count];
    MirrorBloch<count> bloch;
    V wave[count], e[count], U[count];
    SinCos turn[count];
    IRIDO_FOR_EACH phase[i] = mirror_phase(m[i], halves);
    mirror_bloch<count>(phase, n, bloch);
    IRIDO_FOR_EACH {
        wave[i] = IfThenElseZero(bloch.band[i], bloch.nk[i]);
        e[i] = one;
    }
    sin_cos<count>(wave, turn);
    if (bloch.gaps) {
        IRIDO_FOR_EACH {
            const MirrorDecay gap = mirror_decay(bloch.nk[i], bloch.band[i]);
            turn[i] = {IfThenElse(bloch.band[i], turn[i].sin, gap.turn.sin),
                       IfThenElse(bloch.band[i], turn[i].cos, gap.turn.cos)};
            e[i] = IfThenElse(bloch.band[i], one, gap.square);
        }
    }
    IRIDO_FOR_EACH {
        const Mask still = hn::Lt(bloch.nk[i], constant(1e-9));
        U[i] = IfThenElse(still, n, Div(turn[i].sin, bloch.sine[i]));
        const V cu = Mul(phase[i].C, U[i]), Z = Mul(cu, cu), inverse = Div(one, Add(e[i], Z));
        out[i] = {Mul(Z, inverse), Mul(e[i], inverse), {zero, zero}, zero};
    }
    if (!with_sum) return;
    IRIDO_FOR_EACH {
        const MirrorSigns sign = mirror_signs(phase[i].flip, repeat);
        out[i].sum = mirror_sum(m[i], halves, Mul(sign.cos, turn[i].cos), Mul(sign.U, U[i]));
        out[i].log_scale = IfThenElse(bloch.band[i], zero, bloch.nk[i]);
    }
}

#undef IRIDO_FOR_EACH

/// Takes the logarithm of a denominator into it as far as fields are not made smaller layer by
/// layer either, and where no layer is evanescent.
HWY_INLINE void without_logarithm(MirrorEnds& end, V sign) {
    const Mask plain = And(hn::Gt(sign, constant(0)), hn::Lt(end.log_scale, constant(kLargestLog)));
    const V growth = exp(IfThenElseZero(plain, end.log_scale));
    end.sum = scaled(end.sum, growth);
    end.log_scale = IfThenElse(plain, constant(0), end.log_scale);
}

}  // namespace
}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
