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

#include "core/vector/absorption-inl.hpp"
#include "core/vector/mirror_run-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

/// The kernel for one run of points.
class Runner : MirrorRun {
public:
    using MirrorRun::MirrorRun;

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
                store_rows<true, true>(fixed.step.kind, point, at);
            } else if (s) {
                store_rows<true, false>(fixed.step.kind, point, at);
            } else {
                store_rows<false, true>(fixed.step.kind, point, at);
            }
        }
    }

private:
    /// Points [first, end), vectors beginning with `first`.
    ///   fixed  numbers of their FixedPoints, or nullptr
    void compute_part(std::size_t first, std::size_t end, const double* fixed) {
        for (std::size_t point = first; point < end; point += hn::Lanes(Lanes())) {
            prepare_varying(point);
            fixed_ = fixed ? fixed + fixed_place(point - first, run_.fixed_rows) : nullptr;
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
        if (program_.has_absorbing_groups) {  // whose depth integrals the plain kernel has
            bad = Or(bad, small);
            small = no_lanes();
        }
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
};

}  // namespace

void run(const Program& program, const PointRun& points, const RunOutput* s, const RunOutput* p,
         std::vector<std::size_t>& redo, RunMemory& memory) {
    Runner(program, points, s, p, redo, memory)();
}

void run_each(const LayerProgram& layers, const PointRun& points, const LayerOutput* s,
              const LayerOutput* p, std::vector<std::size_t>& redo, RunMemory& memory) {
    AbsorptionRun(layers, points, s, p, redo, memory)();
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

void run_layers(const LayerProgram& layers, const PointRun& points, const LayerOutput* s,
                const LayerOutput* p, std::vector<std::size_t>& redo, RunMemory& memory,
                SimdLevel level) {
    IRIDO_DISPATCH(level, run_each)(layers, points, s, p, redo, memory);
}

void store_fixed(const FixedRun& fixed, const PointRun& points, bool s, bool p, std::size_t rows,
                 double* to, RunMemory& memory, SimdLevel level) {
    IRIDO_DISPATCH(level, store)(fixed, points, s, p, rows, to, memory);
}

}  // namespace irido

#endif
