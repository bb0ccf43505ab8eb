#pragma once

#include <functional>
#include <vector>

#include "core/coherent/coherent.hpp"

namespace irido {

/// An infinite periodic stack of two transparent layers, at one angle and polarization. With
/// a = omega path1_nm, b = omega path2_nm and omega = 2 pi / wavelength, its Bloch phase is
///     cos(KL) = cos a cos b - (q + 1/q)/2 sin a sin b.
/// Source: P. Yeh, Optical Waves in Layered Media (1988), section 6.2; FPB24 eqs. 5 to 9.
struct BraggPeriod {
    double path1_nm = 0;          ///< n1 d1 cos(theta1)
    double path2_nm = 0;          ///< n2 d2 cos(theta2); path1_nm + path2_nm > 0
    double admittance_ratio = 1;  ///< q > 0: s: n2 cos(theta2) / (n1 cos(theta1)),
                                  ///< p: n1 cos(theta2) / (n2 cos(theta1))
};

/// A layer of real index in [1e-6, 1e4] and thickness in [0, 1e9] nm.
struct RealLayer {
    double n = 1;
    double thickness_nm = 0;
};

/// The period formed by two layers. Throws DomainError if a layer is at or beyond its critical
/// angle, or if both have zero thickness.
///   first, second  the layers, from the incident side
///   n0             index of the incident medium, > 0
///   incidence      direction of the light in n0
///   polarization   s or p
BraggPeriod bragg_period(const RealLayer& first, const RealLayer& second, double n0,
                         IncidentAngle incidence, Polarization polarization);

/// Whether p light can reach Brewster's angle of an n1 | n2 interface from the medium n0; all p
/// gaps close there. Source: Yeh (1988), section 6.3.
bool reaches_brewster(double n1, double n2, double n0);

/// Landmarks in the reflectance spectrum of many periods. Source: FPB24 section 3.
///   mode  omega = m pi / (path1 + path2), in the gap of order m >= 1
///   edge  cos(KL) = 1 or -1: the two ends of the gap of order m
///   airy  cos(KL) = 0, between the modes m and m + 1; m >= 0
///   zero  sin b = 0, where the envelope of R vanishes: omega = z pi / path2, z >= 1
enum class LandmarkKind { mode, edge, airy, zero };

struct Landmark {
    LandmarkKind kind = LandmarkKind::mode;
    double order = 0;         ///< an integer
    double omega_per_nm = 0;  ///< 2 pi / wavelength
};

/// The band gap of order m, where |cos(KL)| > 1. Both ends coincide if it is closed: q = 1 (to 8
/// roundings), or order path1 / (path1 + path2) an integer (to 4 roundings).
struct BandGap {
    double order = 0;
    double low_per_nm = 0, high_per_nm = 0;  ///< omega of the ends

    bool is_open() const { return low_per_nm < high_per_nm; }
    double centre_per_nm() const { return low_per_nm + (high_per_nm - low_per_nm) / 2; }
};

/// Accuracy of landmarks without a closed formula: full, as stated below, or 1e-10 and faster.
enum class Roots { exact, quick };

/// One landmark for fixed indices; relative error of omega below 1e-15, plus that of rounding the
/// period. `order` is an integer up to 1e9. omega_of_zero is infinite if path2_nm is 0.
double omega_of_mode(const BraggPeriod& period, double order);
double omega_of_airy(const BraggPeriod& period, double order, Roots roots = Roots::exact);
double omega_of_zero(const BraggPeriod& period, double order);
BandGap band_gap(const BraggPeriod& period, double order, Roots roots = Roots::exact);

/// A period whose indices depend on omega, callable for any omega > 0. May throw.
using PeriodAt = std::function<BraggPeriod(double omega_per_nm)>;

/// The gap with each end computed from the indices at its own wavelength. If the phases do not
/// increase with omega everywhere, there may be several such gaps: one of them.
BandGap band_gap(const PeriodAt& period, double order);

/// Closed range of omega, 1/nm; 0 < low <= high.
struct OmegaRange {
    double low_per_nm = 0, high_per_nm = 0;
};

/// All landmarks in a range in ascending omega, each with the indices at its own wavelength; where
/// they coincide, edges bracket their mode. Throws DomainError if more than kMostOrders orders are
/// in range, or if anomalous dispersion makes the phase of a layer decrease with omega.
std::vector<Landmark> landmarks(const PeriodAt& period, const OmegaRange& range);

/// All gaps, closed ones included, with a point in the range, by ascending order.
std::vector<BandGap> band_gaps(const PeriodAt& period, const OmegaRange& range);

inline constexpr double kMostOrders = 1e5;

}  // namespace irido
