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
    HWY_INLINE AbsorbingTurn absorbing_turn(std::uint32_t layer, V k0_d) const {
        const double* medium = record(layer);
        AbsorbingTurn t;
        t.phase = scaled(slots(medium, kPhaseRe), k0_d);
        t.turn = sin_cos(t.phase.re);
        t.less = Mul(constant(-0.5), expm1(Mul(constant(-2), t.phase.im)));
        const V more = Sub(constant(1), t.less);
        t.cos = {Mul(t.turn.cos, more), negative(Mul(t.turn.sin, t.less))};
        t.sin = {Mul(t.turn.sin, more), Mul(t.turn.cos, t.less)};
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

    /// Layers that all travel, in registers.
    template <bool kS, bool kP>
    HWY_NOINLINE void travelling_step(const Program::Step& step, V k0, Fields& s_out,
                                      Fields& p_out) const {
        Fields s = s_out, p = p_out;
        const std::uint32_t* order = program_.order.data() + step.first;
        for (std::uint32_t left = step.count; left > 0;) {
            std::uint32_t some = std::min(left, kLayersBetweenChecks);
            left -= some;
            for (; some >= kSideBySide; some -= kSideBySide, order += kSideBySide)
                travelling_layers<kS, kP, kSideBySide>(order, k0, s, p);
            for (; some > 0; --some, ++order) travelling_layers<kS, kP, 1>(order, k0, s, p);
            if (kS) check_size(s);
            if (kP) check_size(p);
        }
        s_out = s;
        p_out = p;
    }

    /// One layer after the other, in registers; `through(layer, s, p)` takes the fields through
    /// one.
    template <bool kS, bool kP, class Through>
    HWY_INLINE void layer_by_layer(const Program::Step& step, Fields& s_out, Fields& p_out,
                                   const Through& through) const {
        Fields s = s_out, p = p_out;
        const std::uint32_t* order = program_.order.data() + step.first;
        for (std::uint32_t left = step.count; left > 0;) {
            const std::uint32_t some = std::min(left, kLayersBetweenChecks);
            for (std::uint32_t i = 0; i < some; ++i) through(order[i], s, p);
            order += some;
            left -= some;
            if (kS) check_size(s);
            if (kP) check_size(p);
        }
        s_out = s;
        p_out = p;
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

    template <bool kS, bool kP, bool kFlux>
    HWY_NOINLINE void absorbing_step(const Program::Step& step, V k0, Fields& s_out, Fields& p_out,
                                     V& dying_out) const {
        V dying = dying_out;
        const auto through = [&, k0](std::uint32_t layer, Fields& s, Fields& p) HWY_ATTR {
            const double* medium = record(layer);
            const V k0_d = vacuum_phase(layer, k0);
            const AbsorbingTurn t = absorbing_turn(layer, k0_d);
            if constexpr (kFlux) {
                const V e = exp(Mul(constant(-2), t.phase.im));
                const DepthIntegrals integrals =
                    depth_integrals(medium, t.phase, t.turn, t.less, e, k0_d);
                if (kS)
                    s.absorbed =
                        MulAdd(s.absorbed, e, absorbed_in_layer<false>(s, medium, integrals));
                if (kP)
                    p.absorbed =
                        MulAdd(p.absorbed, e, absorbed_in_layer<true>(p, medium, integrals));
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
        };
        layer_by_layer<kS, kP>(step, s_out, p_out, through);
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
