// A run of points and the media of its layers: their per-vector constants. The plain twin is
// medium() of core/coherent/coherent.hpp. Included once per instruction set, so no #pragma once:
// see kernel.cpp.
#if defined(IRIDO_MEDIA_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IRIDO_MEDIA_INL
#undef IRIDO_MEDIA_INL
#else
#define IRIDO_MEDIA_INL
#endif

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/vector/fields-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

/// The media of a run.
struct MediaRun {
    MediaRun(const Program& program, const PointRun& run, const RunOutput* s, const RunOutput* p,
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
        if (!changed) return false;
        any_evanescent_ = std::ranges::find(evanescent_, 1) != evanescent_.end();
        loss_ = largest_loss();
        return true;
    }

    /// 0 where no layer absorbs or amplifies at these points, though materials do so elsewhere.
    HWY_INLINE V largest_loss() const {
        V largest = constant(0);
        for (std::size_t m = 0; m + 1 < program_.media.size(); ++m) {
            if (!program_.media[m].absorbs) continue;
            const double* record = records_ + m * kRecord;
            largest = Max(largest, Max(Abs(slot(record, kLoss)), Abs(slot(record, kLossW))));
        }
        return largest;
    }

    bool is_constant(std::size_t m) const {
        const std::size_t material = program_.media[m].material;
        if (material == Program::kIncident) return !run_.incident.varies && !run_.cos_theta.varies;
        if (run_.n[material].varies || run_.k[material].varies || run_.incident.varies ||
            run_.cos_theta.varies)
            return false;
        return !has_axis(material) ||
               !(run_.extraordinary_n[material].varies || run_.extraordinary_k[material].varies);
    }

    /// Whether p waves see another index of the material, too.
    bool has_axis(std::size_t material) const {
        return !run_.extraordinary_n.empty() && material != Program::kIncident &&
               run_.extraordinary_n[material].values != nullptr;
    }

    /// eps and q2 of a medium.
    HWY_INLINE void permittivity(std::size_t material, std::size_t point, Cx& eps, Cx& q2) const {
        const bool incident = material == Program::kIncident;
        const V n = at(incident ? run_.incident : run_.n[material], point);
        const V k = incident ? constant(0) : at(run_.k[material], point);
        isotropic(n, k, point, eps, q2);
    }

    /// The same where the axis is along the normal, for p, with the permittivity eps_z along it:
    /// extraordinary_medium() of coherent.hpp.
    HWY_INLINE void axial_permittivity(std::size_t material, std::size_t point, Cx& eps, Cx& q2,
                                       Cx& eps_z) const {
        permittivity(material, point, eps, q2);
        isotropic(at(run_.extraordinary_n[material], point),
                  at(run_.extraordinary_k[material], point), point, eps_z, q2);
        const V inverse = Div(constant(1), norm(eps_z));
        q2 = mul(q2, scaled(mul(eps, {eps_z.re, negative(eps_z.im)}), inverse));
    }

    HWY_INLINE void isotropic(V n, V k, std::size_t point, Cx& eps, Cx& q2) const {
        const V n0 = at(run_.incident, point);
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
        const std::size_t material = program_.media[m].material;
        Cx eps_z;
        const bool axial = has_axis(material);
        if (axial) {
            axial_permittivity(material, point, eps, q2, eps_z);
        } else {
            permittivity(material, point, eps, q2);
        }
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
        put(record, kLossW,
            axial ? Div(Mul(Mul(across, across), eps_z.im), norm(eps_z))
                  : Mul(Mul(Mul(across, across), eps.im), inverse_eps));
        evanescent_[m] = false;
    }

    const double* record(std::uint32_t layer) const {
        return records_ + program_.layers[layer].medium * kRecord;
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

    const Program& program_;
    const PointRun& run_;
    const RunOutput *s_, *p_;
    std::vector<std::size_t>& redo_;
    double *records_, *shared_;
    const double* fixed_ = nullptr;      ///< numbers of a vector of points, see FixedPoints
    std::vector<char>& evanescent_;      ///< per medium of layers: some lane is
    std::vector<std::size_t>& varying_;  ///< media that differ from point to point
    const bool normal_ = !run_.cos_theta.varies && *run_.cos_theta.values == 1;
    bool any_evanescent_ = false;
    V loss_;  ///< see largest_loss()
    bool needs_flux_ = false;
    bool wants_denominators_ = (s_ && s_->log_scale) || (p_ && p_->log_scale);
};

}  // namespace
}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
