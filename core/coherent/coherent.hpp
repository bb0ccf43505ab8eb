#pragma once

#include <span>

#include "core/complex.hpp"
#include "core/stack/stack.hpp"

namespace irido {

enum class Polarization { s, p };

/// Fractions of the incident power reflected, transmitted and absorbed; R + T + A = 1.
struct Power {
    double R = 0;
    double T = 0;
    double A = 0;
};

/// Direction of the light in the incident medium. Both cosine and sine are stored because computing
/// either from the other loses precision.
struct IncidentAngle {
    double cos = 1, sin = 0;

    /// cos_theta in [0, 1]
    IncidentAngle(double cos_theta);
    IncidentAngle(double cos_theta, double sin_theta) : cos(cos_theta), sin(sin_theta) {}
    friend bool operator==(const IncidentAngle&, const IncidentAngle&) = default;
};

/// Direction for an angle in [0, 90] degrees, else DomainError: cos_of_incidence(), and the sine
/// correct to the last digit (exactly 1/2 at 30 degrees).
IncidentAngle incident_angle(double angle_deg);

/// One medium at one wavelength and angle.
struct Medium {
    Complex eps;      ///< permittivity (n + ik)^2; its in-plane value in a uniaxial medium
    Complex q2;       ///< (kz / k0)^2 = eps - S^2, evaluated without cancellation near grazing
    Complex eps_z{};  ///< permittivity along the normal
};

/// Whether a medium absorbs or amplifies.
inline bool is_lossy(const Medium& medium) {
    return medium.eps.imag() != 0 || medium.q2.imag() != 0;
}

/// Permittivity and squared normal index of a medium with the given complex index:
///     q2 = eps - (n0 sin theta)^2                                   up to 45 degrees,
///     q2 = (n - n0)(n + n0) - k^2 + 2 i n k + (n0 cos theta)^2      beyond.
/// The first form is accurate for small indices, the second at grazing angles. n0 > 0 is the real
/// index of the incident medium, in which `incidence` is measured.
Medium medium(Complex index, double n0, IncidentAngle incidence);

/// Effective medium of p waves in a uniaxial material whose optic axis is along the normal:
///     kz^2/k0^2 = eps_o (1 - S^2/eps_e) = eps_o/eps_e (eps_e - S^2),   Y = eps_o k0/kz,
/// with which the isotropic formulas for p waves hold unchanged; s waves see medium(ordinary).
///   ordinary       complex index n + ik for fields along the faces
///   extraordinary  complex index n + ik for fields along the normal
///   n0             real index of the incident medium, > 0
///   incidence      direction of the light in that medium
/// Source: P. Yeh, Optical Waves in Layered Media (1988), section 9.4.
Medium extraordinary_medium(Complex ordinary, Complex extraordinary, double n0,
                            IncidentAngle incidence);

/// Closed range of the angle of incidence, degrees.
inline constexpr double kLargestAngle_deg = 90;

/// Cosine of the angle of incidence, computed as sin(90 - angle): the subtraction is exact in
/// degrees, so grazing angles keep full precision. angle_deg in [0, 90], else DomainError.
double cos_of_incidence(double angle_deg);

/// Powers, together with a function whose zeros are their poles:
///     exp(log_scale) denominator = Y0 B + C
/// up to a zero-free factor, the phase of damped waves in absorbers. It has no poles in the
/// wavenumber.
struct Response {
    Power power;
    Complex r{}, t{};  ///< amplitudes of the tangential electric field, reflected and transmitted
    Complex denominator{1};
    double log_scale = 0;
};

/// Power reflected, transmitted and absorbed by coherent layers between two half-spaces. From the
/// substrate up, the tangential fields (B, C) obey, with delta = k0 d sqrt(q2),
///     s:  B' = c B - i sd C            C' = c C - i q2 sd B
///     p:  B' = c B - i (q2/eps) sd C   C' = c C - i eps sd B
///     c = cos(delta), sd = k0 d sinc(delta)
/// c and sd are entire functions of q2, so the critical angle, evanescent layers and zero thickness
/// need no special treatment. Exponentials are carried in a logarithm, groups are raised to their
/// power in closed form, and A is summed over the flux absorbed in each layer wherever 1 - R - T
/// would lose precision.
///   above         half-space of the incident light
///   elements      layers and groups from `above` to `below`
///   below         half-space of the transmitted light
///   media         one per material of the stack
///   k0            2 pi / wavelength, 1/nm, > 0
///   polarization  s or p, the one that `media` were computed for
/// Returns {1, 0, 0} if `above` carries no power towards the layers (exactly 90 degrees), except
/// {0, 1, 0} if in addition all media are the same. Throws DomainError at the lasing threshold of
/// an amplifying stack, where the powers are infinite.
/// Source: P. Yeh, Optical Waves in Layered Media (1988), ch. 4 and 5; H. A. Macleod, Thin-Film
/// Optical Filters (2010), ch. 2.
Response coherent_response(const Medium& above, std::span<const Element> elements,
                           const Medium& below, std::span<const Medium> media, double k0,
                           Polarization polarization);

}  // namespace irido
