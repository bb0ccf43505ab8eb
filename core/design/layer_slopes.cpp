// Compiled once per instruction set: this file includes itself through foreach_target.h.
#include "core/design/layer_slopes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/design/layer_slopes.cpp"
#include "core/math/vector_targets.hpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "core/design/reproducible_math-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

HWY_INLINE V load(const double* row, std::size_t at) {
    return hn::LoadU(Lanes(), row + at);
}
HWY_INLINE CV load(const double* re, const double* im, std::size_t at) {
    return {load(re, at), load(im, at)};
}
HWY_INLINE void store(V value, double* row, std::size_t at) {
    hn::StoreU(value, Lanes(), row + at);
}

/// Numbers stored per layer: cos, sin/y, sin y and sin of [[cos, -i sin/y], [-i y sin, cos]],
/// divided by exp(decay), and exp(-decay); and a pair of fields.
constexpr std::size_t kTurnNumbers = 9, kFieldNumbers = 4;

/// Numbers stored per layer on the way up, for use on the way down.
class Blocks {
public:
    explicit Blocks(double* numbers) : numbers_(numbers) {}
    HWY_INLINE CV complex(std::size_t index) const {
        return {load(numbers_, index * kMostLanes), load(numbers_, (index + 1) * kMostLanes)};
    }
    HWY_INLINE V real(std::size_t index) const { return load(numbers_, index * kMostLanes); }
    HWY_INLINE void put(std::size_t index, CV value) {
        store(value.re, numbers_, index * kMostLanes);
        store(value.im, numbers_, (index + 1) * kMostLanes);
    }
    HWY_INLINE void put(std::size_t index, V value) { store(value, numbers_, index * kMostLanes); }

private:
    double* numbers_;
};

/// sinh(b) exp(-b), accurate for small b.
HWY_INLINE V scaled_sinh(V b, V scale) {
    const V square = hn::Mul(b, b), one = constant(1);
    V series = one;
    for (const double n : {156.0, 110.0, 72.0, 42.0, 20.0, 6.0})
        series = add_product(one, hn::Mul(square, constant(1 / n)), series);
    const V plain = hn::Mul(constant(0.5), less_product(one, scale, scale));
    return hn::IfThenElse(hn::Lt(b, constant(0.5)), hn::Mul(hn::Mul(b, series), scale), plain);
}

/// Fills the block of a layer; returns its decay.
HWY_INLINE V turn(const RunLayer& layer, V k0, std::size_t at, Blocks& blocks, std::size_t place) {
    const V kd = hn::Mul(k0, constant(layer.thickness_nm));
    const MediumRows& m = layer.medium;
    if (m.is_real) {
        const SinCos of = reproducible_sin_cos(hn::Mul(kd, load(m.q_re, at)));
        blocks.put(place, of.cos);
        blocks.put(place + 2, hn::Mul(of.sin, load(m.inverse_re, at)));
        blocks.put(place + 4, hn::Mul(of.sin, load(m.y_re, at)));
        blocks.put(place + 6, of.sin);
        return constant(0);
    }
    const V a = hn::Mul(kd, load(m.q_re, at)), b = hn::Mul(kd, load(m.q_im, at));
    const SinCos of = reproducible_sin_cos(a);
    const V scale = reproducible_decay(b), sinh = scaled_sinh(b, scale);
    const V cosh = hn::Mul(constant(0.5), add_product(constant(1), scale, scale));
    const CV cos{hn::Mul(of.cos, cosh), hn::Neg(hn::Mul(of.sin, sinh))};
    const CV sin{hn::Mul(of.sin, cosh), hn::Mul(of.cos, sinh)};
    blocks.put(place, cos);
    blocks.put(place + 2, sin * load(m.inverse_re, m.inverse_im, at));
    blocks.put(place + 4, sin * load(m.y_re, m.y_im, at));
    blocks.put(place + 6, sin);
    blocks.put(place + 8, scale);
    return b;
}

struct Pair {
    CV b, c;
};

/// f a, where f is complex or real (with no imaginary part stored).
template <bool kReal>
HWY_INLINE CV times(const Blocks& blocks, std::size_t place, CV a) {
    if constexpr (kReal) return blocks.real(place) * a;
    return blocks.complex(place) * a;
}

/// Fields above a layer from those below it.
template <bool kReal>
HWY_INLINE Pair upward(const Blocks& turns, std::size_t place, Pair f) {
    return {times<kReal>(turns, place, f.b) + turned(times<kReal>(turns, place + 2, f.c)),
            times<kReal>(turns, place, f.c) + turned(times<kReal>(turns, place + 4, f.b))};
}

/// The row vector below a layer from the one above it.
template <bool kReal>
HWY_INLINE Pair downward(const Blocks& turns, std::size_t place, Pair z) {
    return {times<kReal>(turns, place, z.b) + turned(times<kReal>(turns, place + 4, z.c)),
            times<kReal>(turns, place, z.c) + turned(times<kReal>(turns, place + 2, z.b))};
}

HWY_INLINE void add_to(double* row, std::size_t at, V value) {
    store(hn::Add(load(row, at), value), row, at);
}

/// Accumulates one of the two result rows of a run.
struct Sums {
    double* rows;
    std::size_t stride;

    HWY_INLINE double* row(std::size_t slot, bool imaginary) const {
        return rows + (2 * slot + (imaginary ? 1 : 0)) * stride;
    }
    HWY_INLINE void add(std::size_t slot, std::size_t at, CV value) const {
        add_to(row(slot, false), at, value.re);
        add_to(row(slot, true), at, value.im);
    }
};

/// Numbers per layer to accumulate, over all its repetitions, products of the row z above it with
/// fields: for its thickness z_B C and z_C B with the fields above; for its index z_B B + z_C C,
/// z_B C and z_C B with those below.
constexpr std::size_t kProductNumbers = 10;

/// Adds -i k0 q (z_B C / y + z_C B y), the derivative with respect to the layer's thickness.
template <bool kReal>
HWY_INLINE void add_thickness(const RunLayer& layer, V k0, std::size_t at, CV bc, CV cb,
                              bool complex, const Sums& sums) {
    const MediumRows& m = layer.medium;
    if constexpr (kReal) {
        const V rate = hn::Mul(k0, load(m.q_re, at));
        const V inverse = load(m.inverse_re, at), y = load(m.y_re, at);
        add_to(sums.row(layer.thickness_slot, false), at,
               hn::Mul(rate, hn::Add(hn::Mul(bc.im, inverse), hn::Mul(cb.im, y))));
        if (complex)
            add_to(sums.row(layer.thickness_slot, true), at,
                   hn::Neg(hn::Mul(rate, hn::Add(hn::Mul(bc.re, inverse), hn::Mul(cb.re, y)))));
    } else {
        const CV u = bc * load(m.inverse_re, m.inverse_im, at) + cb * load(m.y_re, m.y_im, at);
        sums.add(layer.thickness_slot, at, k0 * turned(load(m.q_re, m.q_im, at) * u));
    }
}

/// Derivative with respect to the layer's index, from products with the fields below.
HWY_INLINE CV index_slope(const RunLayer& layer, V k0, std::size_t at, const Blocks& turns,
                          std::size_t place, bool is_p, CV below, CV bc, CV cb) {
    const MediumRows& m = layer.medium;
    const V kd = hn::Mul(k0, constant(layer.thickness_nm)), zero = constant(0);
    CV cos, sin;
    V scale = constant(1);
    if (m.is_real) {
        cos = {turns.real(place), zero};
        sin = {turns.real(place + 6), zero};
    } else {
        cos = turns.complex(place);
        sin = turns.complex(place + 6);
        scale = turns.real(place + 8);
    }
    const CV q = load(m.q_re, m.q_im, at), n = load(m.n_re, m.n_im, at);
    const CV q2 = q * q, eps = n * n;
    const CV sd = sin * inverse(q);
    // d(cos) and d(sd) by q2, the latter as a series where it would cancel
    const CV dcos = hn::Mul(constant(-0.5), kd) * sd;
    const CV delta2 = hn::Mul(kd, kd) * q2;
    const V small = constant(1e-2);
    CV series = {constant(1), zero};
    for (const double factor : {88.0, 54.0, 28.0, 10.0}) {
        const CV term = constant(-1 / factor) * (delta2 * series);
        series = {hn::Add(constant(1), term.re), term.im};
    }
    const V cube = hn::Mul(hn::Mul(kd, hn::Mul(kd, kd)), hn::Mul(scale, constant(-1.0 / 6)));
    const CV thin = cube * series;
    const CV plain = constant(0.5) * ((kd * cos - sd) * inverse(q2));
    const Mask is_small = hn::Lt(norm(delta2), hn::Mul(small, small));
    const CV dsd{hn::IfThenElse(is_small, thin.re, plain.re),
                 hn::IfThenElse(is_small, thin.im, plain.im)};
    const CV grown = sd + q2 * dsd;
    CV sum = dcos * below;
    if (is_p) {
        const CV inverse_eps = inverse(eps);
        const CV upper = (grown - q2 * (inverse_eps * sd)) * inverse_eps;
        sum = sum + turned(upper * bc) + turned((eps * dsd + sd) * cb);
    } else {
        sum = sum + turned(dsd * bc) + turned(grown * cb);
    }
    return constant(2) * (n * sum);
}

/// dy/dn of the substrate.
HWY_INLINE CV substrate_slope(const MediumRows& m, std::size_t at, bool is_p) {
    const CV q = load(m.q_re, m.q_im, at), n = load(m.n_re, m.n_im, at);
    const CV plain = n * inverse(q);
    if (!is_p) return plain;
    const CV q2 = q * q, eps = n * n;
    return plain * ((constant(2) * q2 - eps) * inverse(q2));
}

/// One vector of lanes of a run.
class Block {
public:
    Block(const SlopeRun& run, SlopeAnswer& answer, SlopeMemory& memory, std::size_t at)
        : run_(run),
          answer_(answer),
          turns_(memory.turns.data()),
          fields_(memory.fields.data()),
          products_(memory.products.data()),
          at_(at),
          k0_(load(run.k0, at)) {}

    HWY_INLINE void up() {
        V decay = constant(0);
        const std::size_t count = run_.layers.size();
        for (std::size_t l = 0; l < count; ++l) {
            const V own = turn(run_.layers[l], k0_, at_, turns_, l * kTurnNumbers);
            if (run_.layers[l].medium.is_real) continue;
            fields_.put(decay_place(l), own);
        }
        Pair f{{constant(1), constant(0)}, load(run_.substrate.y_re, run_.substrate.y_im, at_)};
        put_fields(run_.sequence.size(), f);
        for (std::size_t i = run_.sequence.size(); i-- > 0;) {
            const std::size_t l = run_.sequence[i];
            if (run_.layers[l].medium.is_real) {
                f = upward<true>(turns_, l * kTurnNumbers, f);
            } else {
                f = upward<false>(turns_, l * kTurnNumbers, f);
                decay = hn::Add(decay, fields_.real(decay_place(l)));
            }
            put_fields(i, f);
        }
        y0_ = load(run_.incident_y, at_);
        inverse_d_ = inverse(y0_ * f.b + f.c);
        r_ = (y0_ * f.b - f.c) * inverse_d_;
        const V scale = reproducible_decay(decay);
        const CV t = hn::Mul(constant(2), hn::Mul(y0_, scale)) * inverse_d_;
        R_ = norm(r_);
        // |t|^2 / y0, to be multiplied by the flux y of the substrate
        t2_ = hn::Div(norm(t), y0_);
        T_ = hn::Mul(t2_, load(run_.substrate.y_re, at_));
        store(r_.re, answer_.r_re.data(), at_);
        store(r_.im, answer_.r_im.data(), at_);
        store(t.re, answer_.t_re.data(), at_);
        store(t.im, answer_.t_im.data(), at_);
        store(R_, answer_.R.data(), at_);
        store(T_, answer_.T.data(), at_);
    }

    HWY_INLINE void down() {
        const V one = constant(1);
        const CV with_r = run_.of_amplitudes ? inverse_d_ : conjugate(r_) * inverse_d_;
        const Pair z{y0_ * (with_r * CV{hn::Sub(one, r_.re), hn::Neg(r_.im)}),
                     with_r * CV{hn::Neg(hn::Add(one, r_.re)), hn::Neg(r_.im)}};
        const Sums reflected{answer_.reflected.data(), run_.stride};
        const Pair end = carry(z, reflected);
        if (run_.substrate_slot != kNoSlot)
            reflected.add(run_.substrate_slot, at_,
                          end.c * substrate_slope(run_.substrate, at_, run_.is_p));
        if (!run_.with_transmission) return;
        const CV with_t = hn::Neg(run_.of_amplitudes ? one : T_) * inverse_d_;
        const Sums transmitted{answer_.transmitted.data(), run_.stride};
        const Pair last = carry({y0_ * with_t, with_t}, transmitted);
        if (run_.substrate_slot == kNoSlot) return;
        const CV dy = substrate_slope(run_.substrate, at_, run_.is_p);
        CV slope = last.c * dy;
        if (!run_.of_amplitudes) slope = slope + hn::Mul(constant(0.5), t2_) * dy;
        transmitted.add(run_.substrate_slot, at_, slope);
    }

private:
    std::size_t decay_place(std::size_t layer) const {
        return kFieldNumbers * (run_.sequence.size() + 1) + layer;
    }
    HWY_INLINE void put_fields(std::size_t i, Pair f) {
        fields_.put(kFieldNumbers * i, f.b);
        fields_.put(kFieldNumbers * i + 2, f.c);
    }
    HWY_INLINE Pair fields(std::size_t i) const {
        return {fields_.complex(kFieldNumbers * i), fields_.complex(kFieldNumbers * i + 2)};
    }

    /// Adds to one complex number of a layer's products.
    HWY_INLINE void add_product_of(std::size_t index, CV value) {
        products_.put(index, products_.complex(index) + value);
    }

    /// Accumulates a layer's products at one position of the sequence.
    HWY_INLINE void add_products(std::size_t l, Pair z, std::size_t i) {
        const RunLayer& layer = run_.layers[l];
        const std::size_t first = l * kProductNumbers;
        if (layer.thickness_slot != kNoSlot) {
            const Pair f = fields(i);
            add_product_of(first, z.b * f.c);
            add_product_of(first + 2, z.c * f.b);
        }
        if (layer.index_slot != kNoSlot) {
            const Pair f = fields(i + 1);
            add_product_of(first + 4, z.b * f.b + z.c * f.c);
            add_product_of(first + 6, z.b * f.c);
            add_product_of(first + 8, z.c * f.b);
        }
    }

    HWY_INLINE void add_thickness_of(std::size_t l, CV bc, CV cb, const Sums& sums) const {
        if (run_.layers[l].medium.is_real)
            add_thickness<true>(run_.layers[l], k0_, at_, bc, cb, run_.of_amplitudes, sums);
        else
            add_thickness<false>(run_.layers[l], k0_, at_, bc, cb, true, sums);
    }
    HWY_INLINE void add_index_of(std::size_t l, CV below, CV bc, CV cb, const Sums& sums) const {
        sums.add(run_.layers[l].index_slot, at_,
                 index_slope(run_.layers[l], k0_, at_, turns_, l * kTurnNumbers, run_.is_p, below,
                             bc, cb));
    }

    /// Propagates a row vector down to the substrate and accumulates the derivatives on the way.
    HWY_INLINE Pair carry(Pair z, const Sums& sums) {
        const bool repeats = run_.sequence.size() > run_.layers.size();
        const std::size_t count = run_.layers.size();
        if (repeats)
            for (std::size_t k = 0; k < count * kProductNumbers; ++k) products_.put(k, constant(0));
        for (std::size_t i = 0; i < run_.sequence.size(); ++i) {
            const std::size_t l = run_.sequence[i], place = l * kTurnNumbers;
            const RunLayer& layer = run_.layers[l];
            if (repeats) {
                add_products(l, z, i);
            } else {
                if (layer.thickness_slot != kNoSlot) {
                    const Pair f = fields(i);
                    add_thickness_of(l, z.b * f.c, z.c * f.b, sums);
                }
                if (layer.index_slot != kNoSlot) {
                    const Pair f = fields(i + 1);
                    add_index_of(l, z.b * f.b + z.c * f.c, z.b * f.c, z.c * f.b, sums);
                }
            }
            z = layer.medium.is_real ? downward<true>(turns_, place, z)
                                     : downward<false>(turns_, place, z);
        }
        for (std::size_t l = 0; repeats && l < count; ++l) {
            const std::size_t first = l * kProductNumbers;
            const auto sum = [&](std::size_t k) { return products_.complex(first + k); };
            if (run_.layers[l].thickness_slot != kNoSlot) add_thickness_of(l, sum(0), sum(2), sums);
            if (run_.layers[l].index_slot != kNoSlot) add_index_of(l, sum(4), sum(6), sum(8), sums);
        }
        return z;
    }

    const SlopeRun& run_;
    SlopeAnswer& answer_;
    Blocks turns_, fields_, products_;
    std::size_t at_;
    V k0_, y0_, R_, T_, t2_;
    CV inverse_d_, r_;
};

}  // namespace

void all_layer_slopes(const SlopeRun& run, SlopeAnswer& answer, SlopeMemory& memory) {
    for (std::size_t at = 0; at < run.stride; at += hn::Lanes(Lanes())) {
        Block block(run, answer, memory, at);
        block.up();
        if (run.with_slopes) block.down();
    }
}

}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace irido {

void layer_slopes(const SlopeRun& run, SlopeAnswer& answer, SlopeMemory& memory, SimdLevel simd) {
    for (std::vector<double>* row :
         {&answer.r_re, &answer.r_im, &answer.t_re, &answer.t_im, &answer.R, &answer.T})
        row->resize(run.stride);
    const std::size_t numbers = run.with_slopes ? 2 * run.slots * run.stride : 0;
    answer.reflected.assign(numbers, 0);
    answer.transmitted.assign(run.with_transmission ? numbers : 0, 0);
    constexpr std::size_t kTurn = 9, kField = 4, kProducts = 10;
    memory.turns.resize(kTurn * run.layers.size() * kMostLanes);
    memory.products.resize(kProducts * run.layers.size() * kMostLanes);
    memory.fields.resize((kField * (run.sequence.size() + 1) + run.layers.size()) * kMostLanes);
    IRIDO_DISPATCH(simd, all_layer_slopes)(run, answer, memory);
}

}  // namespace irido

#endif
