// Means over thickness distributions for as many points at once as a vector has lanes. Compiled
// once for every instruction set: this file includes itself through foreach_target.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "core/vector/spread_program.hpp"
#include "core/vector/spread_rule.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/vector/spread_kernel.cpp"
#include "core/math/vector_targets.hpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "core/vector/powers-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

/// Waves into which the fields are taken apart: each bit tells of a spread layer whether they make
/// a round trip through it.
constexpr std::size_t kMostWaves = std::size_t{1} << kMostMeanSpreads;

/// Resonances of larger ratios are left to other methods.
constexpr double kLargestRatio = 0.9;

/// A plan is made for ratios and standard deviations this much larger, or smaller, so that it holds
/// at the next points, and holds for those that do not ask for much less.
constexpr double kMoreRatio = 1.1, kMoreSigma = 1.03, kMuchLess = 0.7;

/// The kernel for one run of points.
class SpreadRun : PowersRun {
public:
    SpreadRun(const SpreadProgram& spread, double error, const PointRun& run, const RunOutput* s,
              const RunOutput* p, std::vector<std::size_t>& redo, RunMemory& memory)
        : PowersRun(spread.program, run, s, p, redo, memory),
          sigma_nm_(spread.sigma_nm),
          error_(error / static_cast<double>(std::ranges::count_if(
                             spread.sigma_nm, [](double sigma) { return sigma > 0; }))) {}

    void operator()() {
        prepare_constant();
        for (std::size_t point = 0; point < run_.count; point += hn::Lanes(Lanes())) {
            prepare_varying(point);
            const std::size_t lanes = std::min(hn::Lanes(Lanes()), run_.count - point);
            if (s_ && p_) {
                compute<true, true>(point, lanes);
            } else if (s_) {
                compute<true, false>(point, lanes);
            } else {
                compute<false, true>(point, lanes);
            }
        }
    }

private:
    /// The phase of a round trip through a layer of spread thickness.
    struct Spread {
        SinCos half;   ///< of half of it, at the mean thickness
        V sigma;       ///< standard deviation
        V loss, wave;  ///< see SpreadPhase
        double depth = 0;
        bool absorbs = false;
        double least = 0, most = 0;  ///< of sigma
    };
    const Spread& spread_at(std::size_t i) const { return spreads_[order_[i]]; }

    /// The fields' waves, one per bit pattern.
    struct Waves {
        Fields s[kMostWaves], p[kMostWaves];
    };

    template <bool kS, bool kP>
    void compute(std::size_t point, std::size_t lanes) {
        const V k0 = at(run_.k0, point);
        Waves waves;
        outgoing_fields(waves.s[0], waves.p[0]);
        const Cx kz = waves.p[0].b, eps = waves.p[0].c;
        count_ = 1;
        spread_count_ = 0;
        V dying = constant(0);
        Mask bad = no_lanes();
        for (const Program::Step& step : program_.steps) climb<kS, kP>(step, k0, waves, dying, bad);
        Incident in_s, in_p;
        incident_waves(point, in_s, in_p, bad);
        const Mask live = hn::FirstN(Lanes(), lanes);
        choose_order(live);
        std::uint32_t redo = 0;
        if (kS) redo |= finish(waves.s, in_s, kz.re, dying, live, bad, 0, point, lanes, *s_);
        if (kP) redo |= finish(waves.p, in_p, dot(kz, eps), dying, live, bad, 1, point, lanes, *p_);
        remember(redo, point, lanes);
    }

    template <bool kS, bool kP>
    HWY_INLINE void climb(const Program::Step& step, V k0, Waves& waves, V& dying, Mask& bad) {
        const auto each = [&](const auto& through) HWY_ATTR {
            for (std::size_t w = 0; w < count_; ++w) {
                if (kS) through(waves.s[w], std::false_type());
                if (kP) through(waves.p[w], std::true_type());
            }
        };
        if (step.kind == Program::Kind::group) {
            for (std::size_t w = 0; w < count_; ++w)
                group_step<kS, kP>(step, k0, waves.s[w], waves.p[w], bad);
            return;
        }
        if (step.kind == Program::Kind::absorbing_group) {
            V same_phase = dying;
            for (std::size_t w = 0; w < count_; ++w)
                absorbing_group_step<kS, kP>(step, k0, waves.s[w], waves.p[w],
                                             w == 0 ? dying : same_phase, bad);
            return;
        }
        for (std::uint32_t i = step.first; i < step.first + step.count; ++i) {
            const std::uint32_t layer = program_.order[i];
            const double* medium = record(layer);
            const V k0_d = vacuum_phase(layer, k0);
            if (sigma_nm_[i] > 0 && step.kind == Program::Kind::transparent) {
                take_apart<kS, kP>(layer, k0, sigma_nm_[i], waves, bad);
            } else if (sigma_nm_[i] > 0) {
                take_absorber_apart<kS, kP>(layer, k0, i, waves, dying);
            } else if (step.kind == Program::Kind::transparent) {
                const Turn t = transparent_turn(layer, k0_d);
                each([&](Fields& f, auto is_p) HWY_ATTR {
                    through_transparent<is_p()>(f, medium, t.cos, t.sin);
                    grow(f, t.exponent);
                });
            } else {
                const AbsorbingTurn t = absorbing_turn(layer, k0_d);
                each([&](Fields& f, auto is_p) HWY_ATTR {
                    through_absorbing(f, t.cos, mul(slots(medium, is_p() ? kPwRe : kSwRe), t.sin),
                                      mul(slots(medium, is_p() ? kPvRe : kSvRe), t.sin));
                    grow(f, t.phase.im);
                });
                if (wants_denominators_) dying = dying_turn(t.phase.re, t.phase.im, dying);
            }
            const std::uint32_t done = i + 1 - step.first;
            if (done % kLayersBetweenChecks == 0 || done == step.count)
                each([](Fields& f, auto) HWY_ATTR { check_size(f); });
        }
    }

    /// A spread layer takes the fields B, C below it to those above, over exp(-i delta)/2:
    ///     B' = B + w C + (B - w C) z,   C' = (B + w C)/w - (B - w C)/w z,   z = exp(2 i delta)
    template <bool kS, bool kP>
    HWY_INLINE void take_apart(std::uint32_t layer, V k0, double sigma_nm, Waves& waves,
                               Mask& bad) {
        const double* medium = record(layer);
        if (HWY_UNLIKELY(evanescent_[program_.layers[layer].medium]))
            bad = Or(bad, hn::Lt(slot(medium, kSign), constant(0)));
        const V kz = slot(medium, kPhase);
        Spread& spread = spreads_[spread_count_++];
        spread.half = sin_cos(Mul(vacuum_phase(layer, k0), kz));
        spread.sigma = Mul(constant(2 * sigma_nm), Mul(k0, kz));
        spread.loss = constant(0);
        spread.wave = constant(1);
        spread.absorbs = false;
        for (std::size_t w = 0; w < count_; ++w) {
            if (kS)
                take_apart(waves.s[w], waves.s[w + count_], slot(medium, kSw), slot(medium, kSv));
            if (kP)
                take_apart(waves.p[w], waves.p[w + count_], slot(medium, kPw), slot(medium, kPv));
        }
        count_ *= 2;
    }
    static HWY_INLINE void take_apart(Fields& once, Fields& again, V w, V v) {
        const Cx b = once.b, c = scaled(once.c, w);
        once.b = {Add(b.re, c.re), Add(b.im, c.im)};
        again.b = {Sub(b.re, c.re), Sub(b.im, c.im)};
        once.c = scaled(once.b, v);
        again.c = scaled(again.b, negative(v));
        again.log_scale = once.log_scale;
        again.absorbed = once.absorbed;
    }

    /// The same of a layer that absorbs; the records have -i/w and -i w.
    template <bool kS, bool kP>
    HWY_INLINE void take_absorber_apart(std::uint32_t layer, V k0, std::uint32_t order,
                                        Waves& waves, V& dying) {
        const double* medium = record(layer);
        const Cx kz = slots(medium, kPhaseRe);
        const Cx phase = scaled(kz, vacuum_phase(layer, k0));
        const V turn = Mul(constant(2 * sigma_nm_[order]), k0);
        Spread& spread = spreads_[spread_count_++];
        spread.half = sin_cos(phase.re);
        spread.sigma = Mul(turn, kz.re);
        spread.loss = Mul(turn, kz.im);
        spread.wave = exp(Mul(constant(-2), phase.im));
        spread.absorbs = true;
        spread.depth = program_.layers[layer].thickness_nm / sigma_nm_[order];
        for (std::size_t w = 0; w < count_; ++w) {
            if (kS)
                take_apart(waves.s[w], waves.s[w + count_], slots(medium, kSwRe),
                           slots(medium, kSvRe), phase.im);
            if (kP)
                take_apart(waves.p[w], waves.p[w + count_], slots(medium, kPwRe),
                           slots(medium, kPvRe), phase.im);
        }
        count_ *= 2;
        if (wants_denominators_) dying = dying_turn(phase.re, phase.im, dying);
    }
    static HWY_INLINE void take_apart(Fields& once, Fields& again, Cx w, Cx v, V exponent) {
        const Cx b = once.b, c = minus_i(mul(once.c, w));  // of the opposite sign
        once.b = {Sub(b.re, c.re), Sub(b.im, c.im)};
        again.b = {Add(b.re, c.re), Add(b.im, c.im)};
        const Cx first = minus_i(mul(once.b, v));
        once.c = {negative(first.re), negative(first.im)};
        again.c = minus_i(mul(again.b, v));
        grow(once, exponent);
        again.log_scale = once.log_scale;
        again.absorbed = once.absorbed;
    }

    /// The layer of the most fringes among those that do not absorb comes first, if there is one:
    /// its mean is a series.
    void choose_order(Mask live) {
        for (std::size_t i = 0; i < spread_count_; ++i) {
            order_[i] = i;
            Spread& spread = spreads_[i];
            spread.most = largest(live, spread.sigma);
            spread.least = -largest(live, negative(spread.sigma), -1e300);
        }
        std::sort(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(spread_count_),
                  [&](std::size_t a, std::size_t b) {
                      const Spread &first = spreads_[a], &second = spreads_[b];
                      if (first.absorbs != second.absorbs) return second.absorbs;
                      return first.most > second.most;
                  });
        for (std::size_t w = 0; w < count_; ++w) {
            places_[w] = 0;
            for (std::size_t i = 0; i < spread_count_; ++i)
                if (w >> i & 1) places_[w] |= std::size_t{1} << order_[i];
        }
        for (std::size_t i = 0; i < spread_count_; ++i) {
            const Spread& spread = spread_at(i);
            const auto [sin, cos] = spread.half;
            turns_[i] = {Mul(spread.wave, Mul(Sub(cos, sin), Add(cos, sin))),
                         Mul(spread.wave, Mul(constant(2), Mul(sin, cos)))};
        }
        has_series_ = !spread_at(0).absorbs;
    }

    static HWY_INLINE double largest(Mask live, V values, double least = 0) {
        return hn::GetLane(hn::MaxOfLanes(Lanes(), IfThenElse(live, values, constant(least))));
    }

    /// Incident and reflected waves at the top, by the round trips through the layers in order_,
    /// over the incident one of none.
    struct Forms {
        Cx incident[kMostWaves], reflected[kMostWaves];
    };

    /// Incident and reflected wave of fields at the top, over exp(scale).
    struct Ways {
        Cx incident, reflected;
    };
    static HWY_INLINE Ways ways_of(const Fields& f, const Incident& in, V scale) {
        const V size = exp_of_log_scale(Sub(f.log_scale, scale), 1);
        const Cx b = scaled(f.b, Mul(size, in.c.re)), c = scaled(f.c, Mul(size, in.b.re));
        return {{Add(b.re, c.re), Add(b.im, c.im)}, {Sub(b.re, c.re), Sub(b.im, c.im)}};
    }

    std::uint32_t finish(const Fields* fields, const Incident& in, V out_flux, V dying, Mask live,
                         Mask bad, std::size_t polarization, std::size_t point, std::size_t lanes,
                         const RunOutput& out) {
        Forms forms;
        Ends e;
        V scale = fields[0].log_scale;
        for (std::size_t w = 1; w < count_; ++w) scale = Max(scale, fields[w].log_scale);
        const Ways none = ways_of(fields[0], in, scale);
        const Cx first = none.incident;
        const V inverse = Div(constant(1), norm(first));
        const Cx over{Mul(first.re, inverse), negative(Mul(first.im, inverse))};
        forms.incident[0] = {constant(1), constant(0)};
        forms.reflected[0] = mul(none.reflected, over);
        for (std::size_t w = 1; w < count_; ++w) {
            const Ways ways = ways_of(fields[places_[w]], in, scale);
            forms.incident[w] = mul(ways.incident, over);
            forms.reflected[w] = mul(ways.reflected, over);
        }
        e.log_scale = scale;
        e.sum = mul(first, denominator(forms, dying));
        const V through =
            Mul(Mul(Mul(in.unit, out_flux), inverse),
                Mul(constant(static_cast<double>(count_ * count_)), exp_of_log_scale(scale, -2)));
        V mean_R = constant(0), mean_T = constant(0);
        if (plan(forms, live, bad, polarization)) {
            add_means(forms, mean_R, mean_T);
        } else {
            bad = live;
        }
        e.T = Mul(through, mean_T);
        e.R = program_.absorbs ? mean_R : Sub(constant(1), e.T);
        e.A = constant(0);
        e.r = e.t = {e.A, e.A};
        return store(e, point, lanes, out, bad);
    }

    /// At the mean thicknesses, over the first wave's.
    HWY_INLINE Cx denominator(const Forms& forms, V dying) const {
        Cx parts[kMostWaves];
        std::copy_n(forms.incident, count_, parts);
        for (std::size_t i = 0, count = count_ / 2; i < spread_count_; ++i, count /= 2) {
            for (std::size_t w = 0; w < count; ++w)
                parts[w] = mul_add(parts[2 * w + 1], turns_[i], parts[2 * w]);
            const SinCos half = spread_at(i).half;
            for (std::size_t w = 0; w < count; ++w)
                parts[w] = mul(parts[w], {half.cos, negative(half.sin)});
        }
        if (!program_.absorbs) return parts[0];
        const SinCos turn = sin_cos(dying);
        return mul(parts[0], {turn.cos, turn.sin});
    }

    /// Largest ratio of the Fourier coefficients along the phase of a layer, whatever the others.
    HWY_INLINE V ratio_of(const Forms& forms, std::size_t layer) const {
        const Cx* const all = forms.incident;
        const std::size_t own = std::size_t{1} << layer;
        if (spread_count_ == 2) {
            // |a + b z| / |1 + d z| on the circle |z| = 1, which becomes one
            const Cx a = all[own], b = all[3], d = all[own ^ 3];
            const Cx conj_d{d.re, negative(d.im)};
            const Cx bd = mul(b, conj_d), ad = mul(a, d);
            const V centre = hn::Sqrt(norm({Sub(a.re, bd.re), Sub(a.im, bd.im)}));
            const V radius = hn::Sqrt(norm({Sub(ad.re, b.re), Sub(ad.im, b.im)}));
            const V less = Sub(constant(1), norm(d));
            return IfThenElse(hn::Gt(less, constant(0)), Div(Add(centre, radius), less),
                              constant(1));
        }
        V upper = constant(0), lower = constant(1);
        for (std::size_t w = 1; w < count_; ++w) {
            const V size = hn::Sqrt(norm(all[w]));
            if (w & own) {
                upper = Add(upper, size);
            } else {
                lower = Sub(lower, size);
            }
        }
        return IfThenElse(hn::Gt(lower, upper), Div(upper, lower), constant(1));
    }

    /// What the means over a layer's thickness take.
    struct Plan {
        SpreadPhase phase{-1, 0, 0};  ///< that it holds for
        bool absorbs = false, is_series = false;
        std::size_t terms = 0;  ///< of the series
        SpreadRule rule{};      ///< in its place

        bool holds_for(const SpreadPhase& other, bool absorbs_too, bool is_series_too) const {
            return absorbs == absorbs_too && is_series == is_series_too &&
                   other.ratio <= phase.ratio && other.ratio >= kMuchLess * phase.ratio &&
                   other.least >= phase.least && other.most <= phase.most &&
                   other.most >= kMuchLess * phase.most && other.loss <= phase.loss &&
                   other.wave <= phase.wave && other.depth == phase.depth;
        }
    };

    /// False if there is none for a lane; lanes that have none join the bad ones.
    bool plan(const Forms& forms, Mask live, Mask& bad, std::size_t polarization) {
        for (std::size_t i = 0; i < spread_count_; ++i) {
            const V ratio = ratio_of(forms, i);
            bad = Or(bad, hn::Not(hn::Le(ratio, constant(kLargestRatio))));
            const Mask good = hn::AndNot(bad, live);
            const Spread& spread = spread_at(i);
            const SpreadPhase phase{
                largest(good, ratio),       spread.least, spread.most, largest(good, spread.loss),
                largest(good, spread.wave), spread.depth};
            const bool is_series = i == 0 && has_series_;
            Plan& plan = plans_[polarization][i];
            if (plan.holds_for(phase, spread.absorbs, is_series)) continue;
            plan.phase = {std::min(kMoreRatio * phase.ratio, (1 + kLargestRatio) / 2),
                          phase.least / kMoreSigma,
                          phase.most * kMoreSigma,
                          phase.loss * kMoreRatio,
                          std::min(phase.wave * kMoreRatio, 1.0),
                          phase.depth};
            plan.absorbs = spread.absorbs;
            plan.is_series = is_series;
            if (is_series) {
                const std::optional<std::size_t> terms = series_terms(plan.phase, error_);
                plan.terms = terms.value_or(0);
                if (!terms) return forget(plan);
            } else {
                const std::optional<SpreadRule> rule = spread.absorbs
                                                           ? lossy_spread_rule(plan.phase, error_)
                                                           : spread_rule(plan.phase, error_);
                if (!rule) return forget(plan);
                plan.rule = *rule;
            }
        }
        plan_ = &plans_[polarization];
        return true;
    }
    static bool forget(Plan& plan) {
        plan.phase.ratio = -1;
        return false;
    }

    /// Means over all phases: of R, unless it is 1 - T, and of 1/|incident|^2.
    void add_means(const Forms& forms, V& mean_R, V& mean_T) {
        if (has_series_) harmonics_left(0, (*plan_)[0].terms, series_);
        for (std::size_t i = has_series_ ? 1 : 0; i < spread_count_; ++i) find_nodes(i);
        if (!program_.absorbs) return add_all<false, true>(forms, mean_R, mean_T);
        if (has_series_) return add_all<true, true>(forms, mean_R, mean_T);
        add_all<true, false>(forms, mean_R, mean_T);
    }
    template <bool kWithR, bool kSeries>
    HWY_INLINE void add_all(const Forms& forms, V& mean_R, V& mean_T) const {
        const Weights one{constant(1), constant(1)};
        if (spread_count_ == 1) return add_nodes<kWithR, kSeries, 1>(forms, one, mean_R, mean_T);
        if (spread_count_ == 2) return add_nodes<kWithR, kSeries, 2>(forms, one, mean_R, mean_T);
        add_nodes<kWithR, kSeries, 3>(forms, one, mean_R, mean_T);
    }

    /// exp(-k^2 sigma^2 / 2) for k = 0 to `count`.
    HWY_INLINE void harmonics_left(std::size_t layer, std::size_t count, V* left) const {
        const V sigma = spread_at(layer).sigma;
        const V first = exp(Mul(constant(-0.5), Mul(sigma, sigma)));
        const V square = Mul(first, first);
        V factor = first;
        left[0] = constant(1);
        for (std::size_t k = 1; k <= count; ++k) {
            left[k] = Mul(left[k - 1], factor);
            factor = Mul(factor, square);
        }
    }

    /// Of R, and of 1/|incident|^2, whose unit is the wave's loss on its way at the mean thickness.
    struct Weights {
        V R, T;
    };
    struct Node {
        Cx turn;
        Weights weight;
    };

    /// Phases of one layer, and their weights.
    void find_nodes(std::size_t layer) {
        const SpreadRule& rule = (*plan_)[layer].rule;
        node_counts_[layer] = rule.count;
        Node* node = nodes_[layer];
        const Cx mean = turns_[layer];
        if (rule.by_thickness) {
            const Spread& spread = spread_at(layer);
            for (const HermiteNode& at : hermite_nodes(rule.count)) {
                const V weight = constant(at.weight);
                if (at.x == 0) {
                    *node++ = {mean, {weight, weight}};
                    continue;
                }
                const SinCos off = sin_cos(Mul(constant(at.x), spread.sigma));
                const Cx later{off.cos, off.sin}, earlier{off.cos, negative(off.sin)};
                if (!spread.absorbs) {
                    *node++ = {mul(mean, later), {weight, weight}};
                    *node++ = {mul(mean, earlier), {weight, weight}};
                    continue;
                }
                const V less = exp(Mul(constant(-at.x), spread.loss));
                const V more = Div(constant(1), less);
                *node++ = {mul(mean, scaled(later, less)), {weight, Mul(weight, less)}};
                *node++ = {mul(mean, scaled(earlier, more)), {weight, Mul(weight, more)}};
            }
            return;
        }
        const std::size_t most = rule.count / 2;
        V left[kMostSeriesTerms + 1];
        harmonics_left(layer, most, left);
        const auto count = static_cast<double>(rule.count);
        std::array<double, kMostSpreadNodes> cosines;
        for (std::size_t j = 0; j < rule.count; ++j)
            cosines[j] = std::cos(2 * std::numbers::pi * static_cast<double>(j) / count);
        for (std::size_t j = 0; j <= most; ++j) {
            V sum = constant(0.5);
            for (std::size_t k = 1; k <= most; ++k)
                sum = MulAdd(left[k], constant(cosines[j * k % rule.count]), sum);
            const V weight = Mul(constant(2 / count), sum);
            const double sine = std::sin(2 * std::numbers::pi * static_cast<double>(j) / count);
            const V cos = constant(cosines[j]), sin = constant(sine);
            *node++ = {mul(mean, {cos, sin}), {weight, weight}};
            if (j > 0) *node++ = {mul(mean, {cos, negative(sin)}), {weight, weight}};
        }
    }

    /// Sums over the nodes of the first kLayers layers, the first of which may have a series.
    template <bool kWithR, bool kSeries, std::size_t kLayers>
    HWY_INLINE void add_nodes(const Forms& forms, Weights weight, V& mean_R, V& mean_T) const {
        if constexpr (kLayers == 0) {
            const V inverse = Div(constant(1), norm(forms.incident[0]));
            mean_T = MulAdd(weight.T, inverse, mean_T);
            mean_R = MulAdd(weight.R, Mul(norm(forms.reflected[0]), inverse), mean_R);
        } else if constexpr (kLayers == 1 && kSeries) {
            add_series<kWithR>(forms, weight, mean_R, mean_T);
        } else {
            constexpr std::size_t layer = kLayers - 1, half = std::size_t{1} << layer;
            for (std::size_t j = 0; j < node_counts_[layer]; ++j) {
                const Node& node = nodes_[layer][j];
                Forms at;
                for (std::size_t w = 0; w < half; ++w) {
                    at.incident[w] =
                        mul_add(forms.incident[w + half], node.turn, forms.incident[w]);
                    if (kWithR)
                        at.reflected[w] =
                            mul_add(forms.reflected[w + half], node.turn, forms.reflected[w]);
                }
                const Weights product{Mul(weight.R, node.weight.R), Mul(weight.T, node.weight.T)};
                add_nodes<kWithR, kSeries, kLayers - 1>(at, product, mean_R, mean_T);
            }
        }
    }

    /// With a + b z reflected and c + d z incident, q = -d/c, |z| = 1 and the mean over its phase
    ///     <1/|c + d z|^2> = (1 + 2 Re S) / (|c|^2 - |d|^2),   S = sum_{k>0} q^k <z^k>,
    ///     <z/|c + d z|^2> = (S/q + conj(q) (1 + conj(S))) / (|c|^2 - |d|^2)
    template <bool kWithR>
    HWY_INLINE void add_series(const Forms& forms, Weights weight, V& mean_R, V& mean_T) const {
        const Cx c = forms.incident[0], d = forms.incident[1], z = turns_[0];
        const V size = norm(c), gap = Sub(size, norm(d));
        const V inverse = Div(constant(1), Mul(size, gap));
        const V over_gap = Mul(inverse, size), over_size = Mul(inverse, gap);
        const Cx q = scaled(mul(d, {c.re, negative(c.im)}), negative(over_size));
        const Cx u = mul(q, z);
        const std::size_t terms = (*plan_)[0].terms;
        Cx rest{series_[terms], constant(0)};  // S/u
        for (std::size_t k = terms; k-- > 1;) rest = mul_add(rest, u, {series_[k], constant(0)});
        const Cx sum = mul(u, rest);
        const V one = constant(1), two = constant(2);
        const V inverse_mean = Mul(over_gap, MulAdd(two, sum.re, one));
        mean_T = MulAdd(weight.T, inverse_mean, mean_T);
        if (!kWithR) return;
        const Cx a = forms.reflected[0], b = forms.reflected[1];
        const Cx turn =
            mul_add({q.re, negative(q.im)}, {Add(one, sum.re), negative(sum.im)}, mul(z, rest));
        const Cx beat = mul({a.re, negative(a.im)}, b);
        const V swing = NegMulAdd(beat.im, turn.im, Mul(beat.re, turn.re));
        const V R = MulAdd(Add(norm(a), norm(b)), inverse_mean, Mul(two, Mul(over_gap, swing)));
        mean_R = MulAdd(weight.R, R, mean_R);
    }

    const std::vector<double>& sigma_nm_;
    double error_;  ///< of each spread layer
    std::size_t count_ = 1, spread_count_ = 0;
    Spread spreads_[kMostMeanSpreads];
    bool has_series_ = true;
    std::array<std::size_t, kMostMeanSpreads> order_{};
    std::array<std::size_t, kMostWaves> places_{};  ///< of the waves in that order
    Cx turns_[kMostMeanSpreads];                    ///< mean round trips, in that order
    std::array<std::array<Plan, kMostMeanSpreads>, 2> plans_;
    const std::array<Plan, kMostMeanSpreads>* plan_ = nullptr;
    V series_[kMostSeriesTerms + 1];
    std::array<std::size_t, kMostMeanSpreads> node_counts_{};
    Node nodes_[kMostMeanSpreads][kMostSpreadNodes];
};

}  // namespace

void run_means(const SpreadProgram& program, double error, const PointRun& points,
               const RunOutput* s, const RunOutput* p, std::vector<std::size_t>& redo,
               RunMemory& memory) {
    SpreadRun(program, error, points, s, p, redo, memory)();
}

}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace irido {

void run_spread(const SpreadProgram& program, double error, const PointRun& run, const RunOutput* s,
                const RunOutput* p, std::vector<std::size_t>& redo, RunMemory& memory,
                SimdLevel level) {
    IRIDO_DISPATCH(level, run_means)(program, error, run, s, p, redo, memory);
}

}  // namespace irido

#endif
