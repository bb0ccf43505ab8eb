// The fields through single layers. The plain twin is core/coherent/layer.hpp.
// Included once for every instruction set, so no #pragma once: see kernel.cpp.
#if defined(IRIDO_LAYERS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IRIDO_LAYERS_INL
#undef IRIDO_LAYERS_INL
#else
#define IRIDO_LAYERS_INL
#endif

#include "core/vector/media-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

/// Steps of single layers.
struct LayersRun : MediaRun {
    using MediaRun::MediaRun;

    /// cos and sin of a transparent layer of k0 d, half of it for groups.
    HWY_INLINE Turn transparent_turn(std::uint32_t layer, V k0_d) const {
        const double* medium = record(layer);
        const V phase = Mul(k0_d, slot(medium, kPhase));
        if (HWY_UNLIKELY(evanescent_[program_.layers[layer].medium]))
            return evanescent_turn(phase, slot(medium, kSign));
        return turn_of(phase);
    }

    struct AbsorbingTurn {
        Cx phase;
        SinCos turn;
        V less;  ///< (1 - exp(-2b))/2
        Cx cos, sin;
    };
    /// `count` layers that absorb, their sines and exponentials side by side.
    template <std::size_t count>
    HWY_INLINE void absorbing_turns(const std::uint32_t* order, const V* k0_d,
                                    AbsorbingTurn* t) const {
        V phase[count];
        SinCos turn[count];
        _Pragma("GCC unroll 4") for (std::size_t k = 0; k < count; ++k) {
            t[k].phase = scaled(slots(record(order[k]), kPhaseRe), k0_d[k]);
            phase[k] = t[k].phase.re;
        }
        sin_cos<count>(phase, turn);
        _Pragma("GCC unroll 4") for (std::size_t k = 0; k < count; ++k) t[k].less =
            Mul(constant(-0.5), expm1(Mul(constant(-2), t[k].phase.im)));
        _Pragma("GCC unroll 4") for (std::size_t k = 0; k < count; ++k) {
            const V less = t[k].less, more = Sub(constant(1), less);
            t[k].turn = turn[k];
            t[k].cos = {Mul(turn[k].cos, more), negative(Mul(turn[k].sin, less))};
            t[k].sin = {Mul(turn[k].sin, more), Mul(turn[k].cos, less)};
        }
    }
    HWY_INLINE AbsorbingTurn absorbing_turn(std::uint32_t layer, V k0_d) const {
        AbsorbingTurn t;
        absorbing_turns<1>(&layer, &k0_d, &t);
        return t;
    }

    HWY_INLINE V vacuum_phase(std::uint32_t layer, V k0) const {
        return Mul(k0, constant(program_.layers[layer].thickness_nm));
    }

    /// The matrices of all layers at one vector of points.
    void share_layers(V k0) {
        for (std::uint32_t layer = 0; layer < program_.layers.size(); ++layer) {
            double* shared = shared_ + layer * kShared;
            const double* medium = record(layer);
            const V k0_d = vacuum_phase(layer, k0);
            if (!program_.media[program_.layers[layer].medium].absorbs) {
                const Turn t = transparent_turn(layer, k0_d);
                put(shared, kCos, t.cos);
                put(shared, kBetaS, Mul(slot(medium, kSw), t.sin));
                put(shared, kGammaS, Mul(slot(medium, kSv), t.sin));
                put(shared, kBetaP, Mul(slot(medium, kPw), t.sin));
                put(shared, kGammaP, Mul(slot(medium, kPv), t.sin));
                put(shared, kExponent, t.exponent);
                continue;
            }
            const AbsorbingTurn t = absorbing_turn(layer, k0_d);
            put(shared, kCRe, t.cos);
            put(shared, kPsRe, mul(slots(medium, kSwRe), t.sin));
            put(shared, kQsRe, mul(slots(medium, kSvRe), t.sin));
            put(shared, kPpRe, mul(slots(medium, kPwRe), t.sin));
            put(shared, kQpRe, mul(slots(medium, kPvRe), t.sin));
            put(shared, kDecay, t.phase.im);
            put(shared, kTurn, t.phase.re);
        }
    }

    /// `count` layers that travel, their sines side by side.
    template <bool kS, bool kP, std::size_t count>
    HWY_INLINE void travelling_layers(const std::uint32_t* order, V k0, Fields& s,
                                      Fields& p) const {
        V phase[count];
        SinCos t[count];
        _Pragma("GCC unroll 4") for (std::size_t k = 0; k < count; ++k) phase[k] =
            Mul(vacuum_phase(order[k], k0), slot(record(order[k]), kPhase));
        sin_cos<count>(phase, t);
        _Pragma("GCC unroll 4") for (std::size_t k = 0; k < count; ++k) {
            const double* medium = record(order[k]);
            if (kS) through_transparent<false>(s, medium, t[k].cos, t[k].sin);
            if (kP) through_transparent<true>(p, medium, t[k].cos, t[k].sin);
        }
    }

    /// Takes the fields through layers in registers; `through(count, order, s, p)` takes them
    /// through `count` layers, either kTogether or 1, as std::integral_constant.
    template <bool kS, bool kP, std::uint32_t kTogether, class Through>
    HWY_INLINE void in_batches(const Program::Step& step, Fields& s_out, Fields& p_out,
                               const Through& through) const {
        Fields s = s_out, p = p_out;
        const std::uint32_t* order = program_.order.data() + step.first;
        for (std::uint32_t left = step.count; left > 0;) {
            std::uint32_t some = std::min(left, kLayersBetweenChecks);
            left -= some;
            for (; some >= kTogether; some -= kTogether, order += kTogether)
                through(std::integral_constant<std::size_t, kTogether>(), order, s, p);
            for (; some > 0; --some, ++order)
                through(std::integral_constant<std::size_t, 1>(), order, s, p);
            if (kS) check_size(s);
            if (kP) check_size(p);
        }
        s_out = s;
        p_out = p;
    }

    /// `through(layer, s, p)` takes the fields through one layer.
    template <bool kS, bool kP, class Through>
    HWY_INLINE void layer_by_layer(const Program::Step& step, Fields& s, Fields& p,
                                   const Through& through) const {
        in_batches<kS, kP, 1>(step, s, p,
                              [&](auto, const std::uint32_t* order, Fields& to_s, Fields& to_p)
                                  HWY_ATTR { through(*order, to_s, to_p); });
    }

    /// Layers that all travel.
    template <bool kS, bool kP>
    HWY_NOINLINE void travelling_step(const Program::Step& step, V k0, Fields& s_out,
                                      Fields& p_out) const {
        in_batches<kS, kP, kSideBySide>(
            step, s_out, p_out,
            [this, k0](auto count, const std::uint32_t* order, Fields& s, Fields& p)
                HWY_ATTR { this->template travelling_layers<kS, kP, count()>(order, k0, s, p); });
    }

    /// Travelling layers with matrices from share_layers().
    template <bool kS, bool kP>
    HWY_NOINLINE void shared_travelling_step(const Program::Step& step, Fields& s_out,
                                             Fields& p_out) const {
        const double* all = shared_;
        layer_by_layer<kS, kP>(
            step, s_out, p_out, [all](std::uint32_t layer, Fields& s, Fields& p) HWY_ATTR {
                const double* shared = all + layer * kShared;
                const V c = slot(shared, kCos);
                if (kS) through_transparent(s, c, slot(shared, kBetaS), slot(shared, kGammaS));
                if (kP) through_transparent(p, c, slot(shared, kBetaP), slot(shared, kGammaP));
            });
    }

    /// Layers some of which are evanescent somewhere.
    template <bool kS, bool kP, bool kFlux>
    HWY_NOINLINE void evanescent_step(const Program::Step& step, V k0, Fields& s, Fields& p) const {
        for (std::uint32_t i = step.first; i < step.first + step.count; ++i) {
            const std::uint32_t layer = program_.order[i];
            const double* medium = record(layer);
            const Turn t = transparent_turn(layer, vacuum_phase(layer, k0));
            if (kS) {
                through_transparent<false>(s, medium, t.cos, t.sin);
                decay<kFlux>(s, t.exponent);
            }
            if (kP) {
                through_transparent<true>(p, medium, t.cos, t.sin);
                decay<kFlux>(p, t.exponent);
            }
            const std::uint32_t done = i + 1 - step.first;
            if (done % kLayersBetweenChecks == 0 || done == step.count) {
                if (kS) check_size(s);
                if (kP) check_size(p);
            }
        }
    }

    template <bool kS, bool kP, bool kFlux>
    HWY_INLINE void transparent_step(const Program::Step& step, V k0, Fields& s, Fields& p) const {
        if (HWY_UNLIKELY(any_evanescent_)) {
            evanescent_step<kS, kP, kFlux>(step, k0, s, p);
        } else if (program_.shares_layers) {
            shared_travelling_step<kS, kP>(step, s, p);
        } else {
            travelling_step<kS, kP>(step, k0, s, p);
        }
    }

    /// exp(exponent) was taken out of the matrix.
    template <bool kFlux>
    static HWY_INLINE void decay(Fields& f, V exponent) {
        grow(f, exponent);
        if (kFlux) f.absorbed = Mul(f.absorbed, exp(Mul(constant(-2), exponent)));
    }

    /// Phase of the damped waves of a layer, as in slab_response.cpp.
    static HWY_INLINE V dying_turn(V a, V b, V before) {
        const V b2 = Mul(b, b);
        return MulAdd(a, Div(b2, Add(constant(1), b2)), before);
    }

    /// `count` layers that absorb.
    template <bool kS, bool kP, bool kFlux, std::size_t count>
    HWY_INLINE void absorbing_layers(const std::uint32_t* order, V k0, Fields& s, Fields& p,
                                     V& dying) const {
        V all_k0_d[count];
        AbsorbingTurn turns[count];
        _Pragma("GCC unroll 4") for (std::size_t k = 0; k < count; ++k) all_k0_d[k] =
            vacuum_phase(order[k], k0);
        absorbing_turns<count>(order, all_k0_d, turns);
        _Pragma("GCC unroll 4") for (std::size_t k = 0; k < count; ++k) {
            const double* medium = record(order[k]);
            const V k0_d = all_k0_d[k];
            const AbsorbingTurn& t = turns[k];
            if constexpr (kFlux) {
                const V e = exp(Mul(constant(-2), t.phase.im));
                const DepthIntegrals integrals =
                    depth_integrals(medium, t.phase, t.turn, t.less, e, k0_d);
                if (kS)
                    s.absorbed = MulAdd(s.absorbed, e,
                                        absorbed_in(s, absorbed_form<false>(medium, integrals)));
                if (kP)
                    p.absorbed = MulAdd(p.absorbed, e,
                                        absorbed_in(p, absorbed_form<true>(medium, integrals)));
            }
            if (kS) {
                through_absorbing(s, t.cos, mul(slots(medium, kSwRe), t.sin),
                                  mul(slots(medium, kSvRe), t.sin));
                grow(s, t.phase.im);
            }
            if (kP) {
                through_absorbing(p, t.cos, mul(slots(medium, kPwRe), t.sin),
                                  mul(slots(medium, kPvRe), t.sin));
                grow(p, t.phase.im);
            }
            if (wants_denominators_) dying = dying_turn(t.phase.re, t.phase.im, dying);
        }
    }

    template <bool kS, bool kP, bool kFlux>
    HWY_NOINLINE void absorbing_step(const Program::Step& step, V k0, Fields& s_out, Fields& p_out,
                                     V& dying_out) const {
        V dying = dying_out;
        in_batches<kS, kP, kFlux ? 1 : kAbsorbingSideBySide>(
            step, s_out, p_out,
            [&, k0](auto count, const std::uint32_t* order, Fields& s, Fields& p)
                HWY_ATTR { absorbing_layers<kS, kP, kFlux, count()>(order, k0, s, p, dying); });
        dying_out = dying;
    }

    /// The same with matrices from share_layers().
    template <bool kS, bool kP>
    HWY_NOINLINE void shared_absorbing_step(const Program::Step& step, Fields& s_out, Fields& p_out,
                                            V& dying_out) const {
        V dying = dying_out;
        const auto through = [&](std::uint32_t layer, Fields& s, Fields& p) HWY_ATTR {
            const double* shared = shared_ + layer * kShared;
            const Cx c = slots(shared, kCRe);
            const V b = slot(shared, kDecay);
            if (kS) {
                through_absorbing(s, c, slots(shared, kPsRe), slots(shared, kQsRe));
                grow(s, b);
            }
            if (kP) {
                through_absorbing(p, c, slots(shared, kPpRe), slots(shared, kQpRe));
                grow(p, b);
            }
            if (wants_denominators_) dying = dying_turn(slot(shared, kTurn), b, dying);
        };
        layer_by_layer<kS, kP>(step, s_out, p_out, through);
        dying_out = dying;
    }
};

}  // namespace
}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
