#pragma once

#include <complex>

#include "core/coherent/layer.hpp"

namespace irido {

/// Reflectance at normal incidence of a face between two real indices, in (0, 1].
double normal_reflectance(double n1, double n2);

/// Schlick's reflectance of a face from its reflectance R0 at normal incidence; cos_theta in [0,
/// 1]. Source: C. Schlick, Computer Graphics Forum 13 (1994), eq. 15.
double schlick(double R0, double cos_theta);

/// Amplitude of the tangential electric field that a face reflects, as (a - b) / (a + b) with
/// s: a = kz1, b = kz2;  p: a = eps1 kz2, b = eps2 kz1; 0 where both vanish. It loses digits where
/// the media are nearly equal, which fresnel_s() and fresnel_p() do not.
Complex face_amplitude(const Medium& above, const Medium& below, Polarization polarization);

/// A wave in one medium: permittivity and normal index, kz / k0.
template <class Number>
struct Ray {
    Number eps, kz;
};

/// The wave that goes on, in a transparent medium below its critical angle.
Ray<double> real_ray(double index, const Medium& medium);

/// The wave that goes on or dies away.
Ray<Complex> outgoing_ray(const Medium& medium);

/// Fresnel's amplitude of the tangential electric field and the power that passes.
template <class Number>
struct FresnelFace {
    Number r;
    double T;
};

/// A face between two media. The difference of admittances, s: kz, p: eps/kz, is written as what is
/// left after its cancellation:
///     r_s = (eps1 - eps2) / (kz1 + kz2)^2
///     r_p = (eps1 - eps2) (eps1 eps2 - S^2 (eps1 + eps2)) / (eps1 kz2 + eps2 kz1)^2
/// difference  eps1 - eps2, as (n1 - n2) (n1 + n2)
template <class Number>
FresnelFace<Number> fresnel_s(const Ray<double>& a, const Ray<Number>& b, Number difference) {
    const Number sum = a.kz + b.kz;
    return {difference / (sum * sum), 4 * a.kz * std::real(b.kz) / std::norm(sum)};
}

/// s2  S^2, of the conserved S = n0 sin(theta)
template <class Number>
FresnelFace<Number> fresnel_p(const Ray<double>& a, const Ray<Number>& b, Number difference,
                              double s2) {
    const Number sum = a.eps * b.kz + b.eps * a.kz;
    return {difference * (a.eps * b.eps - s2 * (a.eps + b.eps)) / (sum * sum),
            4 * a.eps * a.kz * std::real(b.eps * std::conj(b.kz)) / std::norm(sum)};
}

}  // namespace irido
