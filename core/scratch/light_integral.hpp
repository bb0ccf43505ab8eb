#pragma once

#include <span>
#include <vector>

#include "core/scratch/cosine_series.hpp"
#include "core/scratch/light.hpp"
#include "core/scratch/lobe_table.hpp"
#include "core/scratch/visible_scratch.hpp"

namespace irido {

/// How the reflection of an area light is integrated along a scratch, over xi_1; across it, over
/// xi_2, it always is exact, but that a slanted depth under `band` is constant on 16 parts.
struct LightIntegral {
    enum class Kind {
        exact,   ///< adaptive, to 1e-8 relative
        points,  ///< Gauss points in erf(sigma k xi_1) between the light's limits
        band,    ///< xi_1 = 0 alone
    };
    Kind kind = Kind::exact;
    int points = 8;  ///< of `points`, [1, 64]
};

/// A light as a view sees it in a scratched surface.
struct LitView {
    const LightSlices& light;  ///< cut across the scratch
    DepthPhase phase;
    UnitVector view;  ///< above the horizon
};

/// Radiance that a scratch reflects over the light's radiance, at every wavelength,
///     L = rho/(pi sqrt(pi)) int dy power(y) sum over arcs of int |d|^2 R dF(2 pi W q nu),
/// y = sigma k xi_1, q = xi_2, F of slit_integral(): closed in q where |d|^2 and R are constant.
///   wavenumber_per_um  [1e-4, 1e3] each
///   reflectance        of the base at the cosine of theta_d, of these wavelengths; empty: 1
///   lobe               of the scratch, from lobe_under() for the shortest wavelength
///   whole              of `exact`: what the radiance is part of, and its error measured by, at
///                      every wavelength; empty: by its own
/// `points` and `band` take a finite scratch to be an infinite one with its share.
/// Throws DomainError for arguments out of range.
/// Source: VWH18 section 3.4 and eq. 27, which is |S|^2: here divided by A_C lambda^2, after which
/// sigma has cancelled.
std::vector<double> light_ratios(const VisibleScratch& scratch, const LitView& lit,
                                 std::span<const double> wavenumber_per_um,
                                 const LightIntegral& method, const CosineSeries& reflectance,
                                 const LobeTable& lobe, std::span<const double> whole = {});

/// The same at one wavelength, [1e-3, 1e4] um, over a perfect mirror.
double light_ratio(const VisibleScratch& scratch, const LightSlices& light, DepthPhase phase,
                   const UnitVector& view, double wavelength_um, const LightIntegral& method);

/// The lobe of a scratch for all that a light asks of it at wavelengths from `shortest_um` on.
LobeTable lobe_under(const VisibleScratch& scratch, const LightSlices& light,
                     const UnitVector& view, double shortest_um);

/// Intervals of q = xi_2 on the band xi_1 = 0, ascending.
struct Interval {
    double from, to;
};
std::vector<Interval> band_intervals(const VisibleScratch& scratch, const LightSlices& light,
                                     const UnitVector& view);

/// Gauss-Legendre rule of any number of points on [-1, 1]; count [1, 64], else DomainError.
struct RulePoint {
    double x, weight;
};
std::vector<RulePoint> legendre_rule(int count);

}  // namespace irido
