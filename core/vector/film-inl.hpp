// One transparent film under the incident medium. The plain twin is core/film/film.hpp.
// Included once for every instruction set, so no #pragma once: see kernel.cpp.
#if defined(IRIDO_FILM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef IRIDO_FILM_INL
#undef IRIDO_FILM_INL
#else
#define IRIDO_FILM_INL
#endif

#include "core/vector/powers-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

/// One film.
struct FilmRun : PowersRun {
    using PowersRun::PowersRun;

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

    Film film_s_, film_p_;
};

}  // namespace
}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
