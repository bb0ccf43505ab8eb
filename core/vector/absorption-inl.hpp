// The power absorbed in each layer. The plain twin is coherent_layer_absorption() of
// core/coherent/slab_response.hpp. Included once for every instruction set, so no #pragma once: see
// kernel.cpp.
#if defined(IRIDO_ABSORPTION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IRIDO_ABSORPTION_INL
#undef IRIDO_ABSORPTION_INL
#else
#define IRIDO_ABSORPTION_INL
#endif

#include "core/vector/powers-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

/// Slots of an absorbing layer at one vector of points: what it absorbs in the units of the fields
/// above it, and their logarithm.
enum AbsorbedSlot { kAbsorbedS = 0, kAbsorbedP = 2, kAbsorbedSlots = 4 };
inline constexpr std::size_t kAbsorbed = kAbsorbedSlots * kMostLanes;

/// Slots of a shared layer's forms.
enum FormSlot { kFormS = 0, kFormP = 4, kFormSlots = 8 };
inline constexpr std::size_t kForms = kFormSlots * kMostLanes;

/// Light on its way up through a LayerProgram.
class AbsorptionRun : PowersRun {
public:
    AbsorptionRun(const LayerProgram& layers, const PointRun& run, const LayerOutput* s,
                  const LayerOutput* p, std::vector<std::size_t>& redo, RunMemory& memory)
        : PowersRun(layers.program, run, nullptr, nullptr, redo, memory),
          layers_(layers),
          out_s_(s),
          out_p_(p),
          absorbed_(aligned_room(memory.absorbed, program_.order.size() * kAbsorbed +
                                                      program_.layers.size() * kForms)),
          forms_(absorbed_ + program_.order.size() * kAbsorbed) {}

    void operator()() {
        for (const LayerOutput* out : {out_s_, out_p_})
            if (out) clear(*out);
        if (!program_.absorbs) return;
        prepare_constant();
        for (std::size_t point = 0; point < run_.count; point += hn::Lanes(Lanes())) {
            prepare_varying(point);
            if (out_s_ && out_p_) {
                compute<true, true>(point);
            } else if (out_s_) {
                compute<true, false>(point);
            } else {
                compute<false, true>(point);
            }
        }
    }

private:
    /// Layers that cannot absorb.
    void clear(const LayerOutput& out) const {
        const auto absorbs_nothing = [&](std::uint32_t layer) {
            for (std::size_t i = 0; i < run_.count; ++i)
                out.A[layer * out.layer_stride + i * out.stride] = 0;
        };
        std::ranges::for_each(layers_.without, absorbs_nothing);
        if (!program_.absorbs) std::ranges::for_each(layers_.owners, absorbs_nothing);
    }

    template <bool kS, bool kP>
    void compute(std::size_t point) {
        const V k0 = at(run_.k0, point);
        if (program_.shares_layers) {
            share_layers(k0);
            share_forms(k0);
        }
        Fields s, p;
        outgoing_fields(s, p);
        const Cx kz = p.b, eps = p.c, one{constant(1), constant(0)};
        for (const Program::Step& step : program_.steps) {
            if (step.kind == Program::Kind::transparent) {
                transparent_step<kS, kP, false>(step, k0, s, p);
            } else if (program_.shares_layers) {
                note_absorbed<kS, kP, true>(step, k0, s, p);
            } else {
                note_absorbed<kS, kP, false>(step, k0, s, p);
            }
        }
        Incident in_s, in_p;
        Mask bad = no_lanes();
        incident_waves(point, in_s, in_p, bad);
        const std::size_t lanes = std::min(hn::Lanes(Lanes()), run_.count - point);
        if (kS) store_layers<kAbsorbedS>(s, in_s, one, kz.re, *out_s_, point, lanes, bad);
        if (kP) store_layers<kAbsorbedP>(p, in_p, kz, dot(kz, eps), *out_p_, point, lanes, bad);
        remember(bits_of(bad), point, lanes);
    }

    struct Forms {
        AbsorbedForm s, p;
    };
    static HWY_INLINE Forms forms_of(const double* medium, const AbsorbingTurn& t, V k0_d) {
        const V e = exp(Mul(constant(-2), t.phase.im));
        const DepthIntegrals i = depth_integrals(medium, t.phase, t.turn, t.less, e, k0_d);
        return {absorbed_form<false>(medium, i), absorbed_form<true>(medium, i)};
    }

    static HWY_INLINE void put_form(double* to, int first, const AbsorbedForm& form) {
        put(to, first, form.bb);
        put(to, first + 1, form.cc);
        put(to, first + 2, form.bc);
    }
    static HWY_INLINE AbsorbedForm form_at(const double* from, int first) {
        return {slot(from, first), slot(from, first + 1), slots(from, first + 2)};
    }

    /// The forms of all layers at one vector of points.
    void share_forms(V k0) {
        for (std::uint32_t layer = 0; layer < program_.layers.size(); ++layer) {
            if (!program_.media[program_.layers[layer].medium].absorbs) continue;
            const V k0_d = vacuum_phase(layer, k0);
            const Forms forms = forms_of(record(layer), absorbing_turn(layer, k0_d), k0_d);
            put_form(forms_ + layer * kForms, kFormS, forms.s);
            put_form(forms_ + layer * kForms, kFormP, forms.p);
        }
    }

    /// Takes the fields through absorbing layers and notes what each of them absorbs.
    ///   kIsShared  matrices and forms are those of share_layers() and share_forms()
    template <bool kS, bool kP, bool kIsShared>
    HWY_NOINLINE void note_absorbed(const Program::Step& step, V k0, Fields& s_out, Fields& p_out) {
        double* absorbed = absorbed_ + step.first * kAbsorbed;
        const auto note = [&](Fields& f, const AbsorbedForm& form, Cx c, Cx b_of_c, Cx c_of_b,
                              V decay, int first) HWY_ATTR {
            put(absorbed, first, absorbed_in(f, form));
            through_absorbing(f, c, b_of_c, c_of_b);
            grow(f, decay);
            put(absorbed, first + 1, f.log_scale);
        };
        const auto through = [&](std::uint32_t layer, Fields& s, Fields& p) HWY_ATTR {
            if constexpr (kIsShared) {
                const double *shared = shared_ + layer * kShared, *forms = forms_ + layer * kForms;
                const Cx c = slots(shared, kCRe);
                const V decay = slot(shared, kDecay);
                if (kS)
                    note(s, form_at(forms, kFormS), c, slots(shared, kPsRe), slots(shared, kQsRe),
                         decay, kAbsorbedS);
                if (kP)
                    note(p, form_at(forms, kFormP), c, slots(shared, kPpRe), slots(shared, kQpRe),
                         decay, kAbsorbedP);
            } else {
                const double* medium = record(layer);
                const V k0_d = vacuum_phase(layer, k0);
                const AbsorbingTurn t = absorbing_turn(layer, k0_d);
                const Forms forms = forms_of(medium, t, k0_d);
                if (kS)
                    note(s, forms.s, t.cos, mul(slots(medium, kSwRe), t.sin),
                         mul(slots(medium, kSvRe), t.sin), t.phase.im, kAbsorbedS);
                if (kP)
                    note(p, forms.p, t.cos, mul(slots(medium, kPwRe), t.sin),
                         mul(slots(medium, kPvRe), t.sin), t.phase.im, kAbsorbedP);
            }
            absorbed += kAbsorbed;
        };
        layer_by_layer<kS, kP>(step, s_out, p_out, through);
    }

    /// Stores what the layers absorb of the incident power.
    ///   kFirst          AbsorbedSlot of the polarization
    ///   top             fields at the top
    ///   in              incident wave
    ///   out_b, out_flux  B and the flux of the substrate's wave
    ///   out             destination
    ///   point, lanes    first point and number of points
    ///   bad             receives lanes that need the plain kernel
    template <int kFirst>
    HWY_NOINLINE void store_layers(const Fields& top, const Incident& in, Cx out_b, V out_flux,
                                   const LayerOutput& out, std::size_t point, std::size_t lanes,
                                   Mask& bad) const {
        Ends ends;
        finish(ends, top, in, out_b, out_flux, {});
        const std::size_t count = program_.order.size();
        for (std::size_t i = 0; i < count;) {
            const std::uint32_t owner = layers_.owners[i];
            V sum = constant(0);
            for (; i < count && layers_.owners[i] == owner; ++i) {
                if (!program_.media[program_.layers[program_.order[i]].medium].absorbs) continue;
                const double* absorbed = absorbed_ + i * kAbsorbed;
                const V down = exp(Sub(slot(absorbed, kFirst + 1), top.log_scale));
                sum = Add(sum, Mul(Mul(Mul(ends.unit, slot(absorbed, kFirst)), down), down));
            }
            store(sum, out.A + owner * out.layer_stride, point, lanes, out.stride);
            bad = Or(bad, hn::Not(hn::Le(Abs(sum), constant(kAmplified))));
        }
    }

    const LayerProgram& layers_;
    const LayerOutput *out_s_, *out_p_;
    double *absorbed_, *forms_;
};

}  // namespace
}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
