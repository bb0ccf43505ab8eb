// A mirror in a host of the index of one of its layers. The plain twin is
// core/coherent/hosted_mirror.hpp.
// Included once for every instruction set, so no #pragma once: see kernel.cpp.
#if defined(IRIDO_MIRROR_RUN_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IRIDO_MIRROR_RUN_INL
#undef IRIDO_MIRROR_RUN_INL
#else
#define IRIDO_MIRROR_RUN_INL
#endif

#include "core/vector/film-inl.hpp"
#include "core/vector/mirror-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

/// A hosted mirror.
struct MirrorRun : FilmRun {
    using FilmRun::FilmRun;

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

    /// Constants shared by a mirror's points. With eps = n^2 of host 1 and other layer 2
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

    MirrorMedia mirror_[2];  ///< s, p
    V half_path_[2];         ///< of a mirror's host and other layer, kz d/2
    V mirror_sign_;          ///< of kz^2 of the other layer
    bool mirror_evanesces_ = false;
};

}  // namespace
}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
