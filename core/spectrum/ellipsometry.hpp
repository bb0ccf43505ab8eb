#pragma once

#include <span>

#include "core/complex.hpp"
#include "core/spectrum/stack_power.hpp"

namespace irido {

/// The angles that an ellipsometer measures, rho = r_p / r_s = tan(psi) exp(i delta).
struct EllipsometricAngles {
    double psi_deg;    ///< [0, 90]
    double delta_deg;  ///< (-180, 180]
};

/// From the amplitudes of the tangential electric fields, time factor exp(-i w t). r_p = r_s at
/// normal incidence, so that delta = 0 there for every stack; in the other common convention, where
/// r_p changes its sign, delta differs by 180 degrees. Where nothing is reflected, psi = 45 and
/// delta = 0, as at normal incidence.
/// Source: R. M. A. Azzam and N. M. Bashara, Ellipsometry and Polarized Light (1977), section 4.2.
EllipsometricAngles ellipsometric_angles(Complex r_s, Complex r_p);

/// What an ellipsometer prints, in the convention of instruments (Nebraska, Muller): time factor
/// exp(+i w t) and r_p = -r_s at normal incidence, rho = -conj(r_p / r_s) = tan(psi) exp(i Delta).
struct Ellipsometry {
    double psi_deg = 45;              ///< [0, 90]
    double delta_nebraska_deg = 180;  ///< [0, 360): 180 - delta of ellipsometric_angles()
    double N = 0, C = -1, S = 0;      ///< cos 2psi, sin 2psi cos Delta, sin 2psi sin Delta
    double depolarization = 0;        ///< 1 - N^2 - C^2 - S^2, [0, 1]
};

/// From the amplitudes of a coherent stack.
Ellipsometry ellipsometry(Complex r_s, Complex r_p);

/// From the reflectances and the mean of r_p conj(r_s), see cross_reflection():
///     N = (R_s - R_p)/(R_s + R_p),   C + i S = -2 conj(K)/(R_s + R_p)
/// and psi = atan2(sqrt(C^2 + S^2), N)/2, Delta = atan2(S, C).
Ellipsometry ellipsometry(double R_s, double R_p, Complex cross);

/// For a stack with incoherent layers and no thickness distribution, with all of its beams
/// collected.
///   stack             power of the stack
///   media_s, media_p  for each polarization, one per material, followed by the incident medium
///   k0                2 pi / wavelength, 1/nm
Ellipsometry ellipsometry(const StackPower& stack, std::span<const Medium> media_s,
                          std::span<const Medium> media_p, double k0);

}  // namespace irido
