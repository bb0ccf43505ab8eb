#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/complex.hpp"
#include "core/scratch/visible_scratch.hpp"

namespace irido {

/// A pair of directions as a scratch sees it.
struct ScratchPair {
    double xi1 = 0, xi2 = 0;  ///< (w_i + w_o) along the scratch and across it
    double path_um = 0;       ///< v: the wave from the bottom is late by this path
};
ScratchPair pair_of(const VisibleScratch& scratch, DepthPhase phase, const UnitVector& light,
                    const UnitVector& view);

/// |d|^2 = |1 - exp(2 pi i v nu)|^2 = 4 sin^2(pi v nu)
double groove_power(double path_um, double wavenumber_per_um);

/// sinc(x) = sin(x)/x, the sine being known.
double sinc_of(double x, double sine);

/// sinc^2(pi W xi_2 nu)
double slit_power(double width_um, double xi2, double wavenumber_per_um);

/// BRDF of one scratch in a perfect mirror, 1/sr:
///     f = 2 W^2 nu^2 sinc^2(pi W xi_2 nu) |d|^2 |eta|^2/(2 pi sigma^2),   nu = 1/lambda,
/// reciprocal, without cosines or obliquity factors (the Harvey-Shack form). Its integral over all
/// directions is rho |d|^2, but that the tail of sinc^2 beyond the horizon is evanescent.
/// wavelength_um [1e-3, 1e4], else DomainError.
/// Source: VWH18 eqs. 6 to 12; S. Werner, Z. Velinov, W. Jakob, M. B. Hullin, ACM TOG 36(6), 207
/// (2017). The constant follows from Parseval's theorem: int w^2 = pi sigma^2.
double scratch_brdf(const VisibleScratch& scratch, const ScratchPair& pair, double wavelength_um);

/// The same with |eta|^2/(2 pi sigma^2) given, as VisibleScratch::power() has it.
double scratch_brdf_of_lobe(const VisibleScratch& scratch, const ScratchPair& pair,
                            double wavelength_um, double power);

/// The amplitude whose squared magnitude that is; amplitudes of scratches seen from the same point
/// add up where their waves are coherent.
Complex scratch_amplitude(const VisibleScratch& scratch, const ScratchPair& pair,
                          double wavelength_um);

/// |sum of amplitudes|^2 of scratches seen from one point, 1/sr.
double coherent_brdf(std::span<const VisibleScratch> scratches, DepthPhase phase,
                     const UnitVector& light, const UnitVector& view, double wavelength_um);

/// Points and weights (which add up to 1) whose mean over a footprint is exact for what varies no
/// faster than exp(-r^2/sigma^2): for coherent sums, whose mean has no closed form.
struct FootprintPoint {
    SurfacePoint at;
    double weight;
};
std::vector<FootprintPoint> footprint_points(const Footprint& footprint,
                                             double coherence_radius_um);

}  // namespace irido
