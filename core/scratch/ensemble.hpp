#pragma once

#include "core/scratch/scratch.hpp"

namespace irido {

/// Many scratches of one width and depth at random places, as seen on average.
struct ScratchEnsemble {
    double share = 0;  ///< rho: part of the area, [0, 1]
    double width_um = 1, depth_um = 0.1;
    double angle_low_deg = 0, angle_high_deg = 180;  ///< evenly between; at most 180 apart
};

/// Mean BRDF of an ensemble in a perfect mirror, 1/sr. With z = (sigma k |xi|)^2/2 and uniformly
/// distributed angles it is
///     f = 2 sqrt(pi) rho sigma W nu^2 sinc^2(pi W |xi| nu) |d|^2 exp(-z) I0(z),
/// which tends to rho W nu sinc^2 |d|^2/(pi |xi|) away from the mirror direction, where sigma
/// cancels, and is finite in it. sinc^2 is evaluated across the scratches that reflect, which is
/// correct to (W/sigma)^2.
///   ensemble       the scratches
///   optics         coherence and depth phase
///   light, view    directions away from the surface
///   wavelength_um  [1e-3, 1e4], else DomainError
/// Source: the mean of scratch_brdf() over places and angles; M. Abramowitz, I. A. Stegun, 9.6.16.
double ensemble_brdf(const ScratchEnsemble& ensemble, const ScratchOptics& optics,
                     const UnitVector& light, const UnitVector& view, double wavelength_um);

}  // namespace irido
