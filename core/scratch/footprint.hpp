#pragma once

#include "core/scratch/scratch.hpp"

namespace irido {

/// Where a pixel sees the surface: an ellipse, evenly weighted, or a Gaussian whose deviations are
/// the semi-axes. a1 points in `angle`, a2 across it.
struct Footprint {
    enum class Kind { ellipse, gaussian };
    Kind kind = Kind::ellipse;
    SurfacePoint center{};
    double a1_um = 1, a2_um = 1;  ///< [1e-6, 1e6]
    double angle_deg = 0;         ///< [-360, 360]
};

/// Throws DomainError naming the member unless all members are in range.
void require_valid(const Footprint& footprint);

/// A footprint along and across a scratch.
struct FootprintFrame {
    double along_um = 0, across_um = 0;  ///< half extents (deviations) along and across: h_t, h
    double offset_um = 0;                ///< of the axis from the centre, s_b
    double middle_um = 0;                ///< of the scratch's point along the axis, s_t
    double slope = 0;                    ///< how the middle shifts across by each um along
    /// a1 a2/h_t: half width (deviation) across at the middle
    double half_um = 0;
};
FootprintFrame frame_of(const Footprint& footprint, const Scratch& scratch);

/// Mean of exp(-s^2/sigma^2) over an ellipse whose half extent across is h and whose centre is s_b
/// off the axis, both in units of sigma:
///     G = (2/pi) int_-1^1 sqrt(1 - u^2) exp(-(s_b + h u)^2) du,
/// so G(0, h) = exp(-z) (I0(z) + I1(z)) with z = h^2/2, and G(s_b, 0) = exp(-s_b^2).
///   offset  |s_b| <= 1e12;  half_extent  [0, 1e12], else DomainError. Error below 1e-14.
double ellipse_mean(double offset, double half_extent);

/// Mean of exp(-s^2/sigma^2) over a Gaussian of deviation tau:
///     exp(-s_b^2/(1 + 2 tau^2))/sqrt(1 + 2 tau^2).
double gaussian_mean(double offset, double deviation);

/// ellipse_mean() as a sum over n points only; for comparisons.
double ellipse_mean_by_points(double offset, double half_extent, int points);

/// Length of the axis inside the ellipse, um: 2 a1 a2/h sqrt(1 - s_b^2/h^2), or 0.
double chord_um(const FootprintFrame& frame);

/// VWH18's approximations of means over an ellipse: of |eta|^2 at xi_1 = 0 in um^2, whose exact
/// mean is 2 pi sigma^2 G, and of the area density, exactly W G/(sqrt(pi) sigma).
enum class FootprintFormula {
    length,            ///< eq. 15: from the length of the axis inside
    blend_as_printed,  ///< eq. 16, whose term for small footprints lacks a factor pi
    blend,             ///< eq. 16 with it
};
/// Their mean of |eta|^2 at xi_1 = 0, um^2.
///   formula              one of those above
///   footprint, scratch   in the same plane
///   coherence_radius_um  sigma
double published_eta2_um2(FootprintFormula formula, const Footprint& footprint,
                          const Scratch& scratch, double coherence_radius_um);
/// Their area density, eq. 18: twice the area.
double published_density(const Footprint& footprint, const Scratch& scratch);

}  // namespace irido
