// The recursion of coherent_response() for as many points at once as a vector has lanes. Compiled
// once for every instruction set: this file includes itself through foreach_target.h.
#include <algorithm>
#include <array>
#include <cstdint>

#include "core/vector/kernel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/vector/kernel.cpp"
#include "core/math/vector_targets.hpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "core/vector/fields-inl.hpp"
#include "core/vector/mirror-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

/// The kernel for one run of points.
class Runner {
public:
    Runner(const Program& program, const PointRun& run, const RunOutput* s, const RunOutput* p,
           std::vector<std::size_t>& redo, RunMemory& memory)
        : program_(program),
          run_(run),
          s_(s),
          p_(p),
          redo_(redo),
          records_(aligned_room(memory.records,
                                program.media.size() * kRecord +
                                    (program.shares_layers ? program.layers.size() * kShared : 0))),
          shared_(records_ + program.media.size() * kRecord),
          evanescent_(memory.evanescent),
          varying_(memory.varying) {
        evanescent_.assign(program.media.size() - 1, 0);
        varying_.clear();
    }

    void operator()() {
        if (is_mirror()) return run_mirror();
        prepare_constant();
        const bool film = !run_.above && program_.is_one_film();
        if (film) {
            for (std::size_t point = 0; point < run_.count; point += hn::Lanes(Lanes())) {
                if (prepare_varying(point)) prepare_film(point);
                compute_film(point);
            }
            return;
        }
        if (run_.fixed.empty()) return compute_part(0, run_.count, nullptr);
        std::size_t first = 0;
        for (const FixedPoints& part : run_.fixed) {
            compute_part(first, first + part.count, part.numbers);
            first += part.count;
        }
    }

    /// The rows of a FixedRun, whose program this is.
    void store_fixed(const FixedRun& fixed, bool s, bool p, std::size_t rows, double* numbers) {
        wants_denominators_ = program_.absorbs;
        prepare_constant();
        for (std::size_t point = 0; point < run_.count; point += hn::Lanes(Lanes())) {
            prepare_varying(point);
            double* at = numbers + fixed_place(point, rows) + fixed.step.first * kMostLanes;
            if (s && p) {
                store_fixed<true, true>(fixed.step.kind, point, at);
            } else if (s) {
                store_fixed<true, false>(fixed.step.kind, point, at);
            } else {
                store_fixed<false, true>(fixed.step.kind, point, at);
            }
        }
    }

private:
    /// Points [first, end), vectors beginning with `first`.
    ///   fixed  numbers of their FixedPoints
    void compute_part(std::size_t first, std::size_t end, const double* fixed) {
        for (std::size_t point = first; point < end; point += hn::Lanes(Lanes())) {
            prepare_varying(point);
            fixed_ = fixed + fixed_place(point - first, run_.fixed_rows);
            const std::size_t lanes = std::min(hn::Lanes(Lanes()), end - point);
            if (s_ && p_) {
                compute<true, true>(point, lanes);
            } else if (s_) {
                compute<true, false>(point, lanes);
            } else {
                compute<false, true>(point, lanes);
            }
        }
    }

    /// Of a point's first row among those of its part.
    static std::size_t fixed_place(std::size_t point, std::size_t rows) {
        return point / kMostLanes * kMostLanes * rows + point % kMostLanes;
    }

    void prepare_constant() {
        for (std::size_t m = 0; m < program_.media.size(); ++m) {
            if (is_constant(m)) {
                prepare(m, 0);
            } else {
                varying_.push_back(m);
            }
        }
    }

    /// Returns whether anything is other than at the points before.
    bool prepare_varying(std::size_t point) {
        for (const std::size_t m : varying_) prepare(m, point);
        const bool changed = point == 0 || !varying_.empty();
        if (changed) any_evanescent_ = std::ranges::find(evanescent_, 1) != evanescent_.end();
        return changed;
    }

    bool is_constant(std::size_t m) const {
        const std::size_t material = program_.media[m].material;
        if (material == Program::kIncident) return !run_.incident.varies && !run_.cos_theta.varies;
        return !run_.n[material].varies && !run_.k[material].varies && !run_.incident.varies &&
               !run_.cos_theta.varies;
    }

    /// eps and q2 of a medium.
    HWY_INLINE void permittivity(std::size_t material, std::size_t point, Cx& eps, Cx& q2) const {
        const V n0 = at(run_.incident, point);
        const bool incident = material == Program::kIncident;
        const V n = incident ? n0 : at(run_.n[material], point);
        const V k = incident ? constant(0) : at(run_.k[material], point);
        const V along = Mul(n0, at(run_.cos_theta, point));
        const V twice = Mul(constant(2), Mul(n, k));
        eps = {Mul(Sub(n, k), Add(n, k)), twice};
        // as medium() of coherent.hpp
        const V c = at(run_.cos_theta, point), across = Mul(n0, at(run_.sin_theta, point));
        const V grazing = MulAdd(along, along, NegMulAdd(k, k, Mul(Sub(n, n0), Add(n, n0))));
        const Mask steep = hn::Gt(Mul(c, c), constant(0.5));
        q2 = {IfThenElse(steep, NegMulAdd(across, across, eps.re), grazing), twice};
    }

    void prepare(std::size_t m, std::size_t point) {
        double* record = records_ + m * kRecord;
        Cx eps, q2;
        permittivity(program_.media[m].material, point, eps, q2);
        if (m + 1 == program_.media.size()) {
            put(record, kKzRe,
                normal_ ? normal_root(m, point) : outgoing_root(q2, program_.media[m].absorbs));
            put(record, kEpsRe, eps);
            return;
        }
        if (!program_.media[m].absorbs) {
            const V kz = normal_ ? normal_root(m, point).re
                                 : Max(hn::Sqrt(Abs(q2.re)), constant(kTinyIndex));
            const V inverse = Div(constant(1), kz), signed_kz = hn::CopySign(kz, q2.re);
            put(record, kPhase, kz);
            put(record, kSw, inverse);
            put(record, kSv, signed_kz);
            put(record, kPw, Div(signed_kz, eps.re));
            put(record, kPv, Mul(eps.re, inverse));
            put(record, kSign, hn::CopySign(constant(1), q2.re));
            evanescent_[m] = !hn::AllFalse(Lanes(), hn::Lt(q2.re, constant(0)));
            return;
        }
        const Cx kz = normal_ ? normal_root(m, point) : upward_root(q2.re, q2.im);
        const V inverse_norm = Div(constant(1), norm(kz));
        const V inverse_eps = Div(constant(1), norm(eps));
        const Cx inverse_kz{Mul(kz.re, inverse_norm), negative(Mul(kz.im, inverse_norm))};
        const Cx kz_over_eps = scaled(mul(kz, {eps.re, negative(eps.im)}), inverse_eps);
        put(record, kPhaseRe, kz);
        put(record, kSwRe, minus_i(inverse_kz));
        put(record, kSvRe, minus_i(kz));
        put(record, kPwRe, minus_i(kz_over_eps));
        put(record, kPvRe, minus_i(mul(eps, inverse_kz)));
        put(record, kKzRe, kz);
        put(record, kInvKzRe, Div(constant(1), kz.re));
        put(record, kInvKzIm, Div(constant(1), kz.im));
        put(record, kInvNorm, inverse_norm);
        put(record, kLoss, eps.im);
        put(record, kWRe, scaled(mul(q2, {eps.re, negative(eps.im)}), inverse_eps));
        put(record, kEpsRe, eps);
        const V across = Mul(at(run_.incident, point), at(run_.sin_theta, point));
        put(record, kLossW, Mul(Mul(Mul(across, across), eps.im), inverse_eps));
        evanescent_[m] = false;
    }

    const double* record(std::uint32_t layer) const {
        return records_ + program_.layers[layer].medium * kRecord;
    }

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

    /// What waves that die in a layer turn in the denominator, as dying_phase() in coherent.cpp.
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

    template <bool kS, bool kP, bool kFlux>
    HWY_INLINE void climb(V k0, Fields& s, Fields& p, V& dying, Mask& bad) const {
        for (const Program::Step& step : program_.steps) {
            switch (step.kind) {
                case Program::Kind::transparent:
                    transparent_step<kS, kP, kFlux>(step, k0, s, p);
                    break;
                case Program::Kind::absorbing:
                    if (program_.shares_layers && !kFlux) {
                        shared_absorbing_step<kS, kP>(step, s, p, dying);
                    } else {
                        absorbing_step<kS, kP, kFlux>(step, k0, s, p, dying);
                    }
                    break;
                case Program::Kind::group:
                    group_step<kS, kP>(step, k0, s, p, bad);
                    break;
                default:
                    fixed_step<kS, kP>(step, s, p, dying);
            }
        }
    }

    /// What stands in the stored rows instead of layers.
    template <bool kS, bool kP>
    HWY_INLINE void fixed_step(const Program::Step& step, Fields& s, Fields& p, V& dying) const {
        const std::size_t rows = FixedRun::rows_of(step.kind);
        const double* first = fixed_ + step.first * kMostLanes;
        if (kS) through_fixed(step.kind, first, s);
        if (kP) through_fixed(step.kind, first + rows * kMostLanes, p);
        if (wants_denominators_ && program_.absorbs)
            dying = Add(dying, hn::LoadU(Lanes(), first + 2 * rows * kMostLanes));
    }

    static HWY_INLINE void put_row(double* to, std::size_t row, V value) {
        hn::StoreU(value, Lanes(), to + row * kMostLanes);
    }

    template <bool kS, bool kP>
    void store_fixed(Program::Kind kind, std::size_t point, double* to) {
        const V k0 = at(run_.k0, point), zero = constant(0), one = constant(1);
        if (program_.shares_layers) share_layers(k0);
        const std::size_t rows = FixedRun::rows_of(kind);
        double* to_p = to + rows * kMostLanes;
        V dying = zero;
        Mask bad = no_lanes();
        if (kind == Program::Kind::fixed_fields) {
            Fields s, p;
            outgoing_fields(s, p);
            climb<kS, kP, false>(k0, s, p, dying, bad);
            if (kS) put_fields(s, bad, to);
            if (kP) put_fields(p, bad, to_p);
        } else {
            const Fields b{{one, zero}, {zero, zero}, zero, zero};
            const Fields c{{zero, zero}, {one, zero}, zero, zero};
            Fields s[2] = {b, c}, p[2] = {b, c};
            V same_phase = zero;
            climb<kS, kP, false>(k0, s[0], p[0], dying, bad);
            climb<kS, kP, false>(k0, s[1], p[1], same_phase, bad);
            if (kS) put_matrix(kind, s, bad, to);
            if (kP) put_matrix(kind, p, bad, to_p);
        }
        put_row(to, 2 * rows, dying);
    }

    static HWY_INLINE void put_fields(const Fields& f, Mask bad, double* to) {
        put_row(to, 0, IfThenElse(bad, constant(std::nan("")), f.b.re));
        put_row(to, 1, f.b.im);
        put_row(to, 2, f.c.re);
        put_row(to, 3, f.c.im);
        put_row(to, 4, f.log_scale);
    }

    /// The matrix that makes (1, 0) and (0, 1) these columns.
    static HWY_INLINE void put_matrix(Program::Kind kind, const Fields* columns, Mask bad,
                                      double* to) {
        const V scale = Max(columns[0].log_scale, columns[1].log_scale);
        Cx m[4] = {columns[0].b, columns[0].c, columns[1].b, columns[1].c};
        for (std::size_t i = 0; i < 4; ++i)
            m[i] = scaled(m[i], exp(Sub(columns[i / 2].log_scale, scale)));
        m[0].re = IfThenElse(bad, constant(std::nan("")), m[0].re);
        if (kind == Program::Kind::fixed_real) {
            // as for a transparent layer: beta and gamma stand in it as -i beta and -i gamma
            put_row(to, 0, m[0].re);
            put_row(to, 1, negative(m[1].im));
            put_row(to, 2, negative(m[2].im));
            put_row(to, 3, m[3].re);
            put_row(to, 4, scale);
            return;
        }
        for (std::size_t i = 0; i < 4; ++i) {
            put_row(to, 2 * i, m[i].re);
            put_row(to, 2 * i + 1, m[i].im);
        }
        put_row(to, 8, scale);
    }

    /// kz at normal incidence, where it is the index, with the sign that the other roots have.
    HWY_INLINE Cx normal_root(std::size_t m, std::size_t point) const {
        const std::size_t material = program_.media[m].material;
        if (material == Program::kIncident) return {at(run_.incident, point), constant(0)};
        const V n = at(run_.n[material], point), k = at(run_.k[material], point);
        if (!program_.media[m].absorbs) return {n, constant(0)};
        const Mask gains = hn::Lt(k, constant(0));
        return {IfThenElse(gains, negative(n), n), Abs(k)};
    }

    /// kz of the substrate's wave, exact on the real axis.
    static HWY_INLINE Cx outgoing_root(Cx q2, bool absorbs) {
        const V root = hn::Sqrt(Abs(q2.re)), zero = constant(0);
        const Mask travels = hn::Ge(q2.re, zero);
        const Cx real{IfThenElseZero(travels, root), IfThenElse(travels, zero, root)};
        if (!absorbs) return real;
        const Mask is_real = hn::Eq(q2.im, zero);
        const Cx complex = upward_root(q2.re, q2.im);
        return {IfThenElse(is_real, real.re, complex.re), IfThenElse(is_real, real.im, complex.im)};
    }

    /// Those of the substrate's wave.
    HWY_INLINE void outgoing_fields(Fields& s, Fields& p) const {
        const double* below = records_ + (program_.media.size() - 1) * kRecord;
        const Cx kz = slots(below, kKzRe), eps = slots(below, kEpsRe);
        const V zero = constant(0);
        s = {{constant(1), zero}, kz, zero, zero};
        p = {kz, eps, zero, zero};
    }

    template <bool kS, bool kP>
    void compute(std::size_t point, std::size_t lanes) {
        const V k0 = at(run_.k0, point), zero = constant(0);
        if (program_.shares_layers) share_layers(k0);
        Fields start_s, start_p;
        outgoing_fields(start_s, start_p);
        const Cx kz = start_p.b, eps = start_p.c;
        Fields s = start_s, p = start_p;
        V dying = zero;
        Mask bad = no_lanes();
        const bool with_flux = needs_flux_;
        if (with_flux) {
            climb<kS, kP, true>(k0, s, p, dying, bad);
        } else {
            climb<kS, kP, false>(k0, s, p, dying, bad);
        }
        Incident in_s, in_p;
        incident_waves(point, in_s, in_p, bad);
        Ends ends_s, ends_p;
        Mask small = no_lanes();
        if (kS) small = Or(small, finish(ends_s, s, in_s, start_s.b, kz.re, *s_));
        if (kP) small = Or(small, finish(ends_p, p, in_p, kz, dot(kz, eps), *p_));
        // absorption that 1 - R - T would lose; the next points are likely to need it as well
        needs_flux_ = !hn::AllFalse(Lanes(), small);
        if (needs_flux_) {
            if (!with_flux) {
                s = start_s;
                p = start_p;
                V same_phase = zero;
                climb<kS, kP, true>(k0, s, p, same_phase, bad);
            }
            if (kS) from_flux(ends_s, s);
            if (kP) from_flux(ends_p, p);
        }
        if (wants_denominators_ && program_.absorbs) {
            const SinCos turn = sin_cos(dying);
            if (kS) ends_s.sum = mul(ends_s.sum, {turn.cos, turn.sin});
            if (kP) ends_p.sum = mul(ends_p.sum, {turn.cos, turn.sin});
        }
        std::uint32_t redo = 0;
        if (kS) redo |= store(ends_s, point, lanes, *s_, bad);
        if (kP) redo |= store(ends_p, point, lanes, *p_, bad);
        remember(redo, point, lanes);
    }

    HWY_INLINE void remember(std::uint32_t redo, std::size_t point, std::size_t lanes) {
        for (std::size_t lane = 0; HWY_UNLIKELY(redo != 0) && lane < lanes; ++lane)
            if (redo >> lane & 1) redo_.push_back(point + lane);
    }

    /// The wave that meets the stack, B : C, and what becomes of its power.
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

    /// What leaves the stack at its top.
    struct Ends {
        Cx sum, r, t;
        V R, T, A, log_scale;
        V unit, mixed;  ///< Incident's, for this sum
        Mask balances;  ///< R + T + A is 1 and none of them is negative
    };

    /// One transparent film under the incident medium: sum and difference of the fields at the top
    /// are cos(delta) and sin(delta) times what depends on the media only, the Airy sum in other
    /// words.
    struct Film {
        Cx sum_cos, sum_sin, difference_cos, difference_sin;
        Incident in;
        V out_flux;
        Cx out_b;
    };
    /// beta and gamma without sin(delta).
    static HWY_INLINE void set_film(const Incident& in, V beta, V gamma, Cx out_b, Cx out_c,
                                    Film& film) {
        const V in_b = in.b.re, in_c = in.c.re;
        const Cx first = scaled(out_b, in_c), second = scaled(out_c, in_b);
        const Cx third = minus_i(scaled(out_c, Mul(in_c, beta)));
        const Cx fourth = minus_i(scaled(out_b, Mul(in_b, gamma)));
        film.sum_cos = {Add(first.re, second.re), Add(first.im, second.im)};
        film.sum_sin = {Add(third.re, fourth.re), Add(third.im, fourth.im)};
        film.difference_cos = {Sub(first.re, second.re), Sub(first.im, second.im)};
        film.difference_sin = {Sub(third.re, fourth.re), Sub(third.im, fourth.im)};
        film.in.c = in.c;
        film.in.unit = in.unit;
        film.in.mixed = in.mixed;
        film.out_flux = dot(out_b, out_c);
        film.out_b = out_b;
    }
    static HWY_INLINE Cx turned(Cx cos_part, Cx sin_part, const Turn& t) {
        return {MulAdd(sin_part.re, t.sin, Mul(cos_part.re, t.cos)),
                MulAdd(sin_part.im, t.sin, Mul(cos_part.im, t.cos))};
    }

    HWY_INLINE void prepare_film(std::size_t point) {
        const double* medium = record(program_.order[0]);
        const double* below = records_ + (program_.media.size() - 1) * kRecord;
        const Cx kz = slots(below, kKzRe), eps = slots(below, kEpsRe);
        const V one = constant(1), zero = constant(0);
        Incident in_s, in_p;
        Mask never = no_lanes();
        incident_waves(point, in_s, in_p, never);
        if (s_) set_film(in_s, slot(medium, kSw), slot(medium, kSv), {one, zero}, kz, film_s_);
        if (p_) set_film(in_p, slot(medium, kPw), slot(medium, kPv), kz, eps, film_p_);
    }

    HWY_INLINE void compute_film(std::size_t point) {
        const std::uint32_t layer = program_.order[0];
        const Turn t = transparent_turn(layer, vacuum_phase(layer, at(run_.k0, point)));
        const std::size_t lanes = std::min(hn::Lanes(Lanes()), run_.count - point);
        std::uint32_t redo = 0;
        if (s_) redo |= store_film(film_s_, t, point, lanes, *s_);
        if (p_) redo |= store_film(film_p_, t, point, lanes, *p_);
        remember(redo, point, lanes);
    }

    HWY_INLINE std::uint32_t store_film(const Film& film, const Turn& t, std::size_t point,
                                        std::size_t lanes, const RunOutput& out) const {
        Ends e;
        e.sum = turned(film.sum_cos, film.sum_sin, t);
        e.log_scale = t.exponent;
        powers(e, turned(film.difference_cos, film.difference_sin, t), film.in, film.out_b,
               film.out_flux, out);
        return store(e, point, lanes, out, no_lanes());
    }

    /// A hosted mirror's closed form gives powers and denominators.
    bool is_mirror() const {
        if (run_.above || !program_.mirror) return false;
        const bool amplitudes = (s_ && (s_->r || s_->t)) || (p_ && (p_->r || p_->t));
        return program_.mirror->serves(amplitudes, wants_denominators_);
    }

    HWY_INLINE void run_mirror() {
        const HostedMirror& mirror = *program_.mirror;
        const bool constant = !run_.n[mirror.host].varies && !run_.n[mirror.other].varies &&
                              !run_.incident.varies && !run_.cos_theta.varies;
        for (std::size_t point = 0; point < run_.count; point += hn::Lanes(Lanes())) {
            if (point == 0 || !constant) prepare_mirror(point);
            if (s_ && p_) {
                const std::array<const RunOutput*, 2> both{s_, p_};
                compute_mirror<2>(mirror_, both.data(), point);
            } else {
                compute_mirror<1>(mirror_ + (s_ ? 0 : 1), s_ ? &s_ : &p_, point);
            }
        }
    }

    /// What a mirror's points have in common. With eps = n^2 of host 1 and other layer 2
    ///     s: q = kz2/kz1              q - 1/q = (eps2 - eps1) / (kz1 kz2)
    ///     p: q = eps2 kz1/(eps1 kz2)  q - 1/q = (eps2 - eps1) (cos^2 (eps1 + eps2) - eps1)
    ///                                           / (eps2 kz1 kz2)
    /// where cos is that of the angle of incidence: no digits of small contrasts are lost.
    HWY_INLINE void prepare_mirror(std::size_t point) {
        const HostedMirror& mirror = *program_.mirror;
        const V n1 = at(run_.incident, point), n2 = at(run_.n[mirror.other], point);
        const V cos = at(run_.cos_theta, point), kz1 = Mul(n1, cos), two = constant(2);
        Cx eps2, q2;
        permittivity(mirror.other, point, eps2, q2);
        const V kz2 = normal_ ? n2 : Max(hn::Sqrt(Abs(q2.re)), constant(kTinyIndex));
        const V eps1 = Mul(n1, n1), signed_kz2 = hn::CopySign(kz2, q2.re);
        const V contrast_s = Div(Mul(Sub(n2, n1), Add(n2, n1)), Mul(kz1, kz2));
        const V brewster = hn::MulSub(Mul(cos, cos), Add(eps1, eps2.re), eps1);
        const V ratio = Div(Mul(eps2.re, kz1), eps1), size = Mul(two, kz1);
        mirror_[0] = {Div(kz1, kz2), Div(signed_kz2, kz1), contrast_s, size};
        mirror_[1] = {Div(signed_kz2, ratio), Div(ratio, kz2),
                      Div(Mul(contrast_s, brewster), eps2.re), Mul(size, eps1)};
        mirror_sign_ = hn::CopySign(constant(1), q2.re);
        mirror_evanesces_ = !hn::AllFalse(Lanes(), hn::Lt(q2.re, constant(0)));
        half_path_[0] = Mul(constant(0.5 * mirror.host_nm), kz1);
        half_path_[1] = Mul(constant(0.5 * mirror.other_nm), kz2);
    }

    template <std::size_t count>
    HWY_INLINE void compute_mirror(const MirrorMedia* media, const RunOutput* const* out,
                                   std::size_t point) {
        const V k0 = at(run_.k0, point);
        const V phase[2] = {Mul(k0, half_path_[0]), Mul(k0, half_path_[1])};
        SinCos halves[2];
        sin_cos<2>(phase, halves);
        Mask bad = no_lanes();
        if (HWY_UNLIKELY(mirror_evanesces_)) {
            const Turn t = evanescent_turn(phase[1], mirror_sign_);
            bad = hn::Gt(t.exponent, constant(kLargestHalfExponent));
            const V growth = exp(hn::Min(t.exponent, constant(kLargestHalfExponent)));
            halves[1] = {Mul(t.sin, growth), Mul(t.cos, growth)};
        }
        MirrorEnds ends[count];
        mirror_ends<count>(media, {halves[0], halves[1], mirror_sign_},
                           static_cast<double>(program_.mirror->repeat), wants_denominators_, ends);
        const std::size_t lanes = std::min(hn::Lanes(Lanes()), run_.count - point);
        std::uint32_t redo = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (wants_denominators_ && has_few_layers(*program_.mirror))
                without_logarithm(ends[i], mirror_sign_);
            Ends e;
            e.R = ends[i].R;
            e.T = ends[i].T;
            e.A = constant(0);
            e.r = e.t = {e.A, e.A};
            e.sum = ends[i].sum;
            e.log_scale = ends[i].log_scale;
            redo |= store(e, point, lanes, *out[i], bad);
        }
        remember(redo, point, lanes);
    }

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
        if (!out.A || !program_.absorbs) return no_lanes();
        e.A = Sub(Sub(constant(1), e.R), e.T);
        return hn::Le(Abs(e.A), constant(kSubtractable));
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

    /// A where the difference 1 - R - T would lose it; what roundings did to the denominator that
    /// it has in common with R and T shows in their sum.
    static HWY_INLINE void from_flux(Ends& e, const Fields& f) {
        const Mask small = hn::Le(Abs(e.A), constant(kSubtractable));
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
        const Mask redo = Or(bad, hn::Not(And(finite, weak)));
        if (HWY_LIKELY(hn::AllFalse(Lanes(), redo))) return 0;
        HWY_ALIGN double flags[kMostLanes];
        Store(IfThenElse(redo, constant(1), constant(0)), Lanes(), flags);
        std::uint32_t bits = 0;
        for (std::size_t lane = 0; lane < lanes; ++lane)
            if (flags[lane] != 0) bits |= 1U << lane;
        return bits;
    }

    const Program& program_;
    const PointRun& run_;
    const RunOutput *s_, *p_;
    std::vector<std::size_t>& redo_;
    double *records_, *shared_;
    const double* fixed_ = nullptr;      ///< numbers of a vector of points, see FixedPoints
    std::vector<char>& evanescent_;      ///< per medium of layers: some lane is
    std::vector<std::size_t>& varying_;  ///< media that differ from point to point
    Film film_s_, film_p_;
    MirrorMedia mirror_[2];  ///< s, p
    V half_path_[2];         ///< of a mirror's host and other layer, kz d/2
    V mirror_sign_;          ///< of kz^2 of the other layer
    bool mirror_evanesces_ = false;
    const bool normal_ = !run_.cos_theta.varies && *run_.cos_theta.values == 1;
    bool any_evanescent_ = false;
    bool needs_flux_ = false;
    bool wants_denominators_ = (s_ && s_->log_scale) || (p_ && p_->log_scale);
};

}  // namespace

void run(const Program& program, const PointRun& points, const RunOutput* s, const RunOutput* p,
         std::vector<std::size_t>& redo, RunMemory& memory) {
    Runner(program, points, s, p, redo, memory)();
}

void store(const FixedRun& fixed, const PointRun& points, bool s, bool p, std::size_t rows,
           double* to, RunMemory& memory) {
    std::vector<std::size_t> none;
    Runner(fixed.program, points, nullptr, nullptr, none, memory)
        .store_fixed(fixed, s, p, rows, to);
}

}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace irido {

void run_program(const Program& program, const PointRun& points, const RunOutput* s,
                 const RunOutput* p, std::vector<std::size_t>& redo, RunMemory& memory,
                 SimdLevel level) {
    IRIDO_DISPATCH(level, run)(program, points, s, p, redo, memory);
}

void store_fixed(const FixedRun& fixed, const PointRun& points, bool s, bool p, std::size_t rows,
                 double* to, RunMemory& memory, SimdLevel level) {
    IRIDO_DISPATCH(level, store)(fixed, points, s, p, rows, to, memory);
}

}  // namespace irido

#endif
