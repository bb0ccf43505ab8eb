// The fields through repeated groups. The plain twin is core/coherent/period.hpp.
// Included once for every instruction set, so no #pragma once: see kernel.cpp.
#if defined(IRIDO_GROUPS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IRIDO_GROUPS_INL
#undef IRIDO_GROUPS_INL
#else
#define IRIDO_GROUPS_INL
#endif

#include "core/vector/layers-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

/// Steps of repeated groups.
struct GroupsRun : LayersRun {
    using LayersRun::LayersRun;

    /// A transparent layer of half its thickness, without the identity: cosh and sinh plain.
    HWY_INLINE Turn half_turn(std::uint32_t layer, V k0, Mask& bad, V& exponent) const {
        const V half = Mul(constant(0.5), vacuum_phase(layer, k0));
        Turn t = transparent_turn(layer, half);
        if (HWY_UNLIKELY(evanescent_[program_.layers[layer].medium])) {
            exponent = Add(exponent, t.exponent);
            bad = Or(bad, hn::Gt(exponent, constant(kLargestHalfExponent)));
            const V growth = exp(hn::Min(t.exponent, constant(kLargestHalfExponent)));
            t.cos = Mul(t.cos, growth);
            t.sin = Mul(t.sin, growth);
        }
        return t;
    }

    template <bool kIsP>
    HWY_INLINE Period whole_layer(const double* medium, const Turn& half) const {
        const V twice = Mul(constant(2), half.cos);
        const V less = Mul(Mul(constant(-2), slot(medium, kSign)), Mul(half.sin, half.sin));
        const V sine = Mul(twice, half.sin);
        return {less, Mul(slot(medium, kIsP ? kPw : kSw), sine),
                Mul(slot(medium, kIsP ? kPv : kSv), sine), less};
    }

    /// sin(K/2)^2 and cos(K/2)^2 of a pair from the product of its layers' halves.
    template <bool kIsP>
    HWY_INLINE void pair_phase(const double* upper_medium, const Turn& upper,
                               const double* lower_medium, const Turn& lower, V& sin2,
                               V& cos2) const {
        const int w = kIsP ? kPw : kSw, v = kIsP ? kPv : kSv;
        const V ub = Mul(slot(upper_medium, w), upper.sin);
        const V ug = Mul(slot(upper_medium, v), upper.sin);
        const V lb = Mul(slot(lower_medium, w), lower.sin);
        const V lg = Mul(slot(lower_medium, v), lower.sin);
        const V beta = MulAdd(upper.cos, lb, Mul(ub, lower.cos));
        const V gamma = MulAdd(upper.cos, lg, Mul(ug, lower.cos));
        const V diagonal = Mul(upper.cos, lower.cos);
        sin2 = Mul(beta, gamma);
        cos2 = Mul(NegMulAdd(ub, lg, diagonal), NegMulAdd(ug, lb, diagonal));
    }

    /// A period's matrix and Bloch phase, layer by layer from below.
    struct PeriodOf {
        Period period;
        V sin2, cos2;
    };
    template <bool kIsP>
    HWY_INLINE void add_layer(PeriodOf& of, const double* medium, const Turn& half) const {
        of.period = product(whole_layer<kIsP>(medium, half), of.period);
    }

    /// sin(K/2)^2 and cos(K/2)^2 from the matrix, as bloch_phase_of_matrix() in period.cpp.
    static HWY_INLINE void phase_of_matrix(PeriodOf& of) {
        const Period& m = of.period;
        const V one = constant(1), traceless = Mul(constant(0.5), Sub(m.a, m.d));
        of.sin2 = Mul(constant(-0.25), Add(m.a, m.d));
        of.cos2 = Sub(one, of.sin2);
        const Mask flip = hn::Lt(of.cos2, of.sin2);
        const V size = Add(Abs(traceless), Add(Abs(m.beta), Abs(m.gamma)));
        const Mask nearly = hn::Lt(size, constant(kNearlyIdentity));
        const V product =
            Mul(constant(0.25), NegMulAdd(traceless, traceless, Mul(m.beta, m.gamma)));
        const V small = Div(product, IfThenElse(flip, of.sin2, of.cos2));
        of.sin2 = IfThenElse(hn::AndNot(flip, nearly), small, of.sin2);
        of.cos2 = IfThenElse(And(nearly, flip), small, of.cos2);
    }

    template <bool kS, bool kP>
    HWY_NOINLINE void group_step(const Program::Step& step, V k0, Fields& s, Fields& p,
                                 Mask& bad) const {
        const V zero = constant(0);
        V exponent = zero;
        PeriodOf in_s{{zero, zero, zero, zero}, zero, zero}, in_p = in_s;
        Turn below{};
        const double* medium_below = nullptr;
        for (std::uint32_t i = step.first; i < step.first + step.count; ++i) {
            const std::uint32_t layer = program_.order[i];
            const double* medium = record(layer);
            const Turn half = half_turn(layer, k0, bad, exponent);
            if (kS) add_layer<false>(in_s, medium, half);
            if (kP) add_layer<true>(in_p, medium, half);
            if (step.count == 2 && medium_below) {
                if (kS) pair_phase<false>(medium, half, medium_below, below, in_s.sin2, in_s.cos2);
                if (kP) pair_phase<true>(medium, half, medium_below, below, in_p.sin2, in_p.cos2);
            }
            below = half;
            medium_below = medium;
        }
        if (step.count != 2) {
            if (kS) phase_of_matrix(in_s);
            if (kP) phase_of_matrix(in_p);
        }
        if (kS) {
            through_periods(s, in_s.period, in_s.sin2, in_s.cos2, step.repeat);
            check_size(s);
        }
        if (kP) {
            through_periods(p, in_p.period, in_p.sin2, in_p.cos2, step.repeat);
            check_size(p);
        }
    }
};

}  // namespace
}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
