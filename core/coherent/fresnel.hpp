#pragma once

#include <complex>

#include "core/coherent/layer.hpp"

namespace irido {

/// Reflectance of an interface between two real indices at normal incidence, in (0, 1].
double normal_reflectance(double n1, double n2);

/// Schlick's approximation to the reflectance of an interface, from R0 at normal incidence;
/// cos_theta in [0, 1]. Source: C. Schlick, Computer Graphics Forum 13 (1994), eq. 15.
double schlick(double R0, double cos_theta);

/// Reflection coefficient of the tangential electric field at an interface, (a - b) / (a + b) with
/// s: a = kz1, b = kz2;  p: a = eps1 kz2, b = eps2 kz1; 0 where both vanish. Loses precision for
/// nearly equal media; fresnel_s() and fresnel_p() do not.
Complex face_amplitude(const Medium& above, const Medium& below, Polarization polarization);

/// A wave in one medium: permittivity and normal index, kz / k0.
template <class Number>
struct Ray {
    Number eps, kz;
};

/// The forward wave in a transparent medium below its critical angle.
Ray<double> real_ray(double index, const Medium& medium);

/// The forward wave, travelling or evanescent.
Ray<Complex> outgoing_ray(const Medium& medium);

/// Fresnel reflection coefficient of the tangential electric field, and the transmittance.
template <class Number>
struct FresnelFace {
    Number r;
    double T;
};

/// Fresnel coefficients of an interface. The difference of the admittances (s: kz, p: eps/kz) is
/// rewritten so that nothing cancels:
///     r_s = (eps1 - eps2) / (kz1 + kz2)^2
///     r_p = (eps1 - eps2) (eps1 eps2 - S^2 (eps1 + eps2)) / (eps1 kz2 + eps2 kz1)^2
///   difference  eps1 - eps2, computed as (n1 - n2) (n1 + n2)
template <class Number>
FresnelFace<Number> fresnel_s(const Ray<double>& a, const Ray<Number>& b, Number difference) {
    const Number sum = a.kz + b.kz;
    return {difference / (sum * sum), 4 * a.kz * std::real(b.kz) / std::norm(sum)};
}

/// Fresnel coefficients of p waves, see fresnel_s().
///   a, b        forward waves above and below the interface; `a` travels
///   difference  eps1 - eps2, computed as (n1 - n2) (n1 + n2)
///   s2          S^2, with S = n0 sin(theta) conserved across the stack
template <class Number>
FresnelFace<Number> fresnel_p(const Ray<double>& a, const Ray<Number>& b, Number difference,
                              double s2) {
    const Number sum = a.eps * b.kz + b.eps * a.kz;
    return {difference * (a.eps * b.eps - s2 * (a.eps + b.eps)) / (sum * sum),
            4 * a.eps * a.kz * std::real(b.eps * std::conj(b.kz)) / std::norm(sum)};
}

}  // namespace irido
