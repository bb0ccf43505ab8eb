#pragma once

#include <span>

#include "core/complex.hpp"
#include "core/stack/stack.hpp"

namespace irido {

enum class Polarization { s, p };

/// Reflected, transmitted and absorbed fraction of the incident power; R + T + A = 1.
struct Power {
    double R = 0;
    double T = 0;
    double A = 0;
};

/// Direction of the incident light in the incident medium. The sine stands beside the cosine
/// because each loses its digits where it is formed from the other.
struct IncidentAngle {
    double cos = 1, sin = 0;

    /// cos_theta in [0, 1]
    IncidentAngle(double cos_theta);
    IncidentAngle(double cos_theta, double sin_theta) : cos(cos_theta), sin(sin_theta) {}
    friend bool operator==(const IncidentAngle&, const IncidentAngle&) = default;
};

/// Of an angle in degrees, [0, 90], else DomainError: cos_of_incidence(), and the sine to its last
/// digit, exactly 1/2 at 30 degrees.
IncidentAngle incident_angle(double angle_deg);

/// One medium at one wavelength and angle.
struct Medium {
    Complex eps;      ///< permittivity (n + ik)^2; along the faces where the medium is uniaxial
    Complex q2;       ///< (kz / k0)^2 = eps - S^2, formed without its cancellation near grazing
    Complex eps_z{};  ///< permittivity along the normal
};

/// Whether a medium absorbs or amplifies.
inline bool is_lossy(const Medium& medium) {
    return medium.eps.imag() != 0 || medium.q2.imag() != 0;
}

/// Permittivity and squared normal index of a medium of the given complex index,
///     q2 = eps - (n0 sin theta)^2                                   up to 45 degrees,
///     q2 = (n - n0)(n + n0) - k^2 + 2 i n k + (n0 cos theta)^2      beyond:
/// the first keeps the digits of small indices, the second those of grazing angles.
/// n0 > 0 is the real index of the incident medium, to which the incidence belongs.
Medium medium(Complex index, double n0, IncidentAngle incidence);

/// The medium that p waves see where the axis of a uniaxial one is along the normal,
///     kz^2/k0^2 = eps_o (1 - S^2/eps_e) = eps_o/eps_e (eps_e - S^2),   Y = eps_o k0/kz,
/// which is what p waves have of eps and q2 everywhere else; s waves see medium(ordinary).
/// Source: P. Yeh, Optical Waves in Layered Media (1988), section 9.4.
Medium extraordinary_medium(Complex ordinary, Complex extraordinary, double n0,
                            IncidentAngle incidence);

/// Closed range of the angle of incidence, degrees.
inline constexpr double kLargestAngle_deg = 90;

/// cos(angle of incidence), formed as sin(90 - angle) with the subtraction in degrees, where it is
/// exact, so that grazing angles keep all their digits. angle_deg in [0, 90], else DomainError.
double cos_of_incidence(double angle_deg);

/// Powers, and the function whose zeros are their poles: exp(log_scale) denominator = Y0 B + C,
/// which has no poles in the wavenumber, up to a phase without zeros of waves that die in
/// absorbers.
struct Response {
    Power power;
    Complex r{}, t{};  ///< amplitudes of the tangential electric field, reflected and transmitted
    Complex denominator{1};
    double log_scale = 0;
};

/// Power reflected by, transmitted through and absorbed in coherent layers between two half-spaces.
/// From the substrate up, tangential fields (B, C) obey, with delta = k0 d sqrt(q2),
///     s:  B' = c B - i sd C            C' = c C - i q2 sd B
///     p:  B' = c B - i (q2/eps) sd C   C' = c C - i eps sd B
///     c = cos(delta), sd = k0 d sinc(delta)
/// which are entire functions of q2: the critical angle, evanescent layers and zero thickness are
/// ordinary points. Exponentials are factored out into a logarithm, groups are raised to their
/// power in closed form. A comes from the absorbed flux of every layer where 1 - R - T would lose
/// digits.
///   above, below  the half-spaces; light comes from `above`
///   elements      layers and groups from `above` to `below`
///   media         one per material of the stack;  k0 = 2 pi / wavelength, 1/nm
/// Power is {1, 0, 0} when `above` carries no power towards the layers (exactly 90 degrees),
/// {0, 1, 0} if then all media are the same. Throws DomainError at the laser threshold of a stack
/// that amplifies, where no power is finite.
/// Source: P. Yeh, Optical Waves in Layered Media (1988), ch. 4 and 5; H. A. Macleod, Thin-Film
/// Optical Filters (2010), ch. 2.
Response coherent_response(const Medium& above, std::span<const Element> elements,
                           const Medium& below, std::span<const Medium> media, double k0,
                           Polarization polarization);

}  // namespace irido
