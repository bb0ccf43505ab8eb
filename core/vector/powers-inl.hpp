// From the fields at the top to R, T, A and amplitudes. The plain twin is
// core/coherent/slab_response.hpp. Included once for every instruction set, so no #pragma once: see
// kernel.cpp.
#if defined(IRIDO_POWERS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IRIDO_POWERS_INL
#undef IRIDO_POWERS_INL
#else
#define IRIDO_POWERS_INL
#endif

#include "core/vector/chain-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

/// Powers and amplitudes of the light leaving the stack.
struct PowersRun : ChainRun {
    using ChainRun::ChainRun;

    static HWY_INLINE std::uint32_t bits_of(Mask lanes) {
        if (HWY_LIKELY(hn::AllFalse(Lanes(), lanes))) return 0;
        HWY_ALIGN double flags[kMostLanes];
        Store(IfThenElse(lanes, constant(1), constant(0)), Lanes(), flags);
        std::uint32_t bits = 0;
        for (std::size_t lane = 0; lane < hn::Lanes(Lanes()); ++lane)
            if (flags[lane] != 0) bits |= 1U << lane;
        return bits;
    }

    HWY_INLINE void remember(std::uint32_t redo, std::size_t point, std::size_t lanes) {
        for (std::size_t lane = 0; HWY_UNLIKELY(redo != 0) && lane < lanes; ++lane)
            if (redo >> lane & 1) redo_.push_back(point + lane);
    }

    /// The incident wave, B : C, and factors for its power.
    struct Incident {
        Cx b, c;
        V unit;   ///< 4 |B|^2 |C|^2 / flux: power of a wave in units of the incident one
        V mixed;  ///< -2 Im(Y)/Re(Y): mixed_power() of slab_response.hpp
    };

    HWY_INLINE void incident_waves(std::size_t point, Incident& s, Incident& p, Mask& bad) const {
        const V zero = constant(0), one = constant(1), four = constant(4);
        if (HWY_LIKELY(!run_.above)) {
            const V n0 = at(run_.incident, point), n0_square = Mul(n0, n0);
            const V along = Mul(n0, at(run_.cos_theta, point));
            s = {{one, zero}, {along, zero}, Mul(four, along), zero};
            p = {{along, zero}, {n0_square, zero}, Mul(four, Mul(along, n0_square)), zero};
            return;
        }
        Cx eps, q2;
        permittivity(*run_.above, point, eps, q2);
        const Cx kz = outgoing_root(q2, true);
        // at grazing nothing arrives, and a wave that dies away carries nothing
        bad = Or(bad, Or(hn::Le(kz.re, zero), hn::Le(dot(kz, eps), zero)));
        s = {{one, zero}, kz, Div(Mul(four, norm(kz)), kz.re), zero};
        p = {kz, eps, Div(Mul(four, Mul(norm(kz), norm(eps))), dot(kz, eps)), zero};
        s.mixed = Div(Mul(constant(-2), kz.im), kz.re);
        // Y = eps/kz
        const Cx y = mul(eps, {kz.re, negative(kz.im)});
        p.mixed = Div(Mul(constant(-2), y.im), y.re);
    }

    /// exp(factor log_scale), which mostly is 1.
    static HWY_INLINE V exp_of_log_scale(V log_scale, double factor) {
        if (HWY_LIKELY(hn::AllTrue(Lanes(), hn::Eq(log_scale, constant(0))))) return constant(1);
        return exp(Mul(constant(factor), log_scale));
    }

    /// The light leaving the stack at its top.
    struct Ends {
        Cx sum, r, t;
        V R, T, A, log_scale;
        V unit, mixed;  ///< Incident's, for this sum
        Mask balances;  ///< R + T + A is 1 and none of them is negative
        Mask lossy;     ///< some layer absorbs or amplifies
    };

    /// Powers from the fields at the top; returns the lanes whose absorption needs the depth
    /// integrals.
    HWY_INLINE Mask finish(Ends& e, const Fields& f, const Incident& in, Cx out_b, V out_flux,
                           const RunOutput& out) const {
        const bool real = !run_.above;
        const Cx first = real ? scaled(f.b, in.c.re) : mul(in.c, f.b);
        const Cx second = real ? scaled(f.c, in.b.re) : mul(in.b, f.c);
        e.sum = {Add(first.re, second.re), Add(first.im, second.im)};
        const Cx difference{Sub(first.re, second.re), Sub(first.im, second.im)};
        e.log_scale = f.log_scale;
        powers(e, difference, in, out_b, out_flux, out);
        e.lossy = no_lanes();
        if (!out.A || !program_.absorbs) return e.lossy;
        e.lossy = hn::Gt(loss_, constant(0));
        e.A = IfThenElse(e.lossy, Sub(Sub(constant(1), e.R), e.T), e.mixed);
        const Mask lossless = hn::AndNot(e.lossy, e.balances);
        if (HWY_UNLIKELY(!hn::AllFalse(Lanes(), lossless))) {
            const V sum = Add(e.R, e.T);
            e.R = IfThenElse(lossless, Div(e.R, sum), e.R);
            e.T = IfThenElse(lossless, Div(e.T, sum), e.T);
        }
        return And(e.lossy, hn::Le(Abs(e.A), constant(kSubtractable)));
    }

    /// R and T from the fields of the reflected and of the incident wave, and A where no layer
    /// absorbs. Nothing is lost then, so that the three add to 1 by construction.
    HWY_INLINE void powers(Ends& e, Cx difference, const Incident& in, Cx out_b, V out_flux,
                           const RunOutput& out) const {
        const V reflected = norm(difference), zero = constant(0), one = constant(1);
        const V transmitted = Mul(Mul(in.unit, out_flux), exp_of_log_scale(e.log_scale, -2));
        const V incident = norm(e.sum);
        e.balances = And(hn::Ge(out_flux, zero), hn::Eq(in.mixed, zero));
        e.mixed = e.unit = zero;
        e.r = e.t = {zero, zero};
        V inverse = zero;
        if (program_.absorbs || run_.above || out.r) inverse = Div(one, incident);
        if (program_.absorbs) e.unit = Mul(in.unit, inverse);
        if (run_.above || out.r) {
            const Cx over{Mul(e.sum.re, inverse), negative(Mul(e.sum.im, inverse))};
            e.r = mul(difference, over);
            if (run_.above) e.mixed = Mul(in.mixed, e.r.im);
            if (out.t) {
                const V amplitude = Mul(constant(2), exp_of_log_scale(e.log_scale, -1));
                e.t = scaled(mul(mul(out_b, in.c), over), amplitude);
            }
        }
        if (!program_.absorbs)
            inverse = Div(one, IfThenElse(e.balances, Add(reflected, transmitted), incident));
        e.R = Mul(reflected, inverse);
        e.T = Mul(transmitted, inverse);
        const Mask deep = hn::Gt(e.log_scale, constant(kDeepLogScale));
        if (HWY_UNLIKELY(!hn::AllFalse(Lanes(), deep))) {
            const V once = exp(negative(e.log_scale));
            const V T = Mul(Mul(Mul(in.unit, out_flux), Mul(inverse, once)), once);
            e.T = IfThenElse(deep, T, e.T);
        }
        e.A = e.mixed;
    }

    /// A from the absorbed flux, where 1 - R - T would lose precision; rounding errors of the
    /// common denominator show up in the sum of the three.
    static HWY_INLINE void from_flux(Ends& e, const Fields& f) {
        const Mask small = And(e.lossy, hn::Le(Abs(e.A), constant(kSubtractable)));
        e.A = IfThenElse(small, MulAdd(e.unit, f.absorbed, e.mixed), e.A);
        const Mask balances = And(And(small, e.balances), hn::Ge(e.A, constant(0)));
        const V sum = Add(Add(e.R, e.T), e.A);
        e.R = IfThenElse(balances, Div(e.R, sum), e.R);
        e.T = IfThenElse(balances, Div(e.T, sum), e.T);
        e.A = IfThenElse(balances, Div(e.A, sum), e.A);
    }

    HWY_INLINE void store(V value, double* to, std::size_t point, std::size_t lanes,
                          std::size_t stride) const {
        if (!to) return;
        // what is past these lanes is overwritten by the next part
        if (stride == 1 && point + hn::Lanes(Lanes()) <= run_.count) {
            hn::StoreU(value, Lanes(), to + point);
            return;
        }
        HWY_ALIGN double values[kMostLanes];
        Store(value, Lanes(), values);
        for (std::size_t lane = 0; lane < lanes; ++lane) to[(point + lane) * stride] = values[lane];
    }

    static HWY_INLINE void store(Cx value, Complex* to, std::size_t point, std::size_t lanes,
                                 std::size_t stride) {
        if (!to) return;
        HWY_ALIGN double re[kMostLanes];
        HWY_ALIGN double im[kMostLanes];
        Store(value.re, Lanes(), re);
        Store(value.im, Lanes(), im);
        for (std::size_t lane = 0; lane < lanes; ++lane)
            to[(point + lane) * stride] = {re[lane], im[lane]};
    }

    /// Returns the lanes that need the plain kernel as bits.
    HWY_INLINE std::uint32_t store(const Ends& e, std::size_t point, std::size_t lanes,
                                   const RunOutput& out, Mask bad) const {
        store(e.R, out.R, point, lanes, out.stride);
        store(e.T, out.T, point, lanes, out.stride);
        store(e.A, out.A, point, lanes, out.stride);
        store(e.r, out.r, point, lanes, out.stride);
        store(e.t, out.t, point, lanes, out.stride);
        store(e.sum.re, out.denominator_re, point, lanes, out.stride);
        store(e.sum.im, out.denominator_im, point, lanes, out.stride);
        store(e.log_scale, out.log_scale, point, lanes, out.stride);
        const V total = Add(Add(e.R, e.T), e.A);
        const Mask finite = hn::Le(Abs(total), constant(1e300));
        const Mask weak = hn::Le(Max(e.R, e.T), constant(kAmplified));
        return bits_of(Or(bad, hn::Not(And(finite, weak))));
    }
};

}  // namespace
}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
