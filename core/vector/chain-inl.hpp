// The fields through all steps of a program, and those that are stored for other runs. The plain
// twin is core/coherent/slab_response.hpp.
// Included once for every instruction set, so no #pragma once: see kernel.cpp.
#if defined(IRIDO_CHAIN_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IRIDO_CHAIN_INL
#undef IRIDO_CHAIN_INL
#else
#define IRIDO_CHAIN_INL
#endif

#include "core/vector/absorbing_groups-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

/// All steps, from the substrate up.
struct ChainRun : AbsorbingGroupsRun {
    using AbsorbingGroupsRun::AbsorbingGroupsRun;

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
                case Program::Kind::absorbing_group:
                    absorbing_group_step<kS, kP>(step, k0, s, p, dying, bad);
                    break;
                default:
                    fixed_step<kS, kP>(step, s, p, dying);
            }
        }
    }

    /// Applies the stored rows of fixed layers.
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
    void store_rows(Program::Kind kind, std::size_t point, double* to) {
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

    /// Those of the substrate's wave.
    HWY_INLINE void outgoing_fields(Fields& s, Fields& p) const {
        const double* below = records_ + (program_.media.size() - 1) * kRecord;
        const Cx kz = slots(below, kKzRe), eps = slots(below, kEpsRe);
        const V zero = constant(0);
        s = {{constant(1), zero}, kz, zero, zero};
        p = {kz, eps, zero, zero};
    }
};

}  // namespace
}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
