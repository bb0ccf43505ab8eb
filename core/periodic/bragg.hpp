#pragma once

#include <functional>
#include <vector>

#include "core/coherent/coherent.hpp"

namespace irido {

/// Two transparent layers, repeated without end, under one polarization and angle. With
/// a = omega path1_nm, b = omega path2_nm and omega = 2 pi / wavelength its Bloch phase is
///     cos(KL) = cos a cos b - (q + 1/q)/2 sin a sin b.
/// Source: P. Yeh, Optical Waves in Layered Media (1988), section 6.2; FPB24 eqs. 5 to 9.
struct BraggPeriod {
    double path1_nm = 0;          ///< n1 d1 cos(theta1)
    double path2_nm = 0;          ///< n2 d2 cos(theta2); the sum of both > 0
    double admittance_ratio = 1;  ///< q > 0: s: n2 cos(theta2) / (n1 cos(theta1)),
                                  ///< p: n1 cos(theta2) / (n2 cos(theta1))
};

/// A layer of a real index in [1e-6, 1e4], thickness in [0, 1e9].
struct RealLayer {
    double n = 1;
    double thickness_nm = 0;
};

/// The period of two layers in light that comes from an index n0 > 0 under this incidence.
/// Throws DomainError where a layer reflects totally (or just does), and if both have no thickness.
BraggPeriod bragg_period(const RealLayer& first, const RealLayer& second, double n0,
                         IncidentAngle incidence, Polarization polarization);

/// Whether at some angle in the medium n0 p light does not see the interface of two indices
/// (Brewster's), so that all gaps of p close there. Source: Yeh (1988), section 6.3.
bool reaches_brewster(double n1, double n2, double n0);

/// Marks of the reflectance of many periods. Source: FPB24 section 3.
///   mode  omega = m pi / (path1 + path2), in the gap of order m >= 1
///   edge  cos(KL) = 1 or -1: the two ends of the gap of order m
///   airy  cos(KL) = 0, between the modes m and m + 1; m >= 0
///   zero  sin b = 0, where the envelope of R is zero: omega = z pi / path2, z >= 1
enum class LandmarkKind { mode, edge, airy, zero };

struct Landmark {
    LandmarkKind kind = LandmarkKind::mode;
    double order = 0;         ///< whole
    double omega_per_nm = 0;  ///< 2 pi / wavelength
};

/// The gap of order m: where |cos(KL)| > 1. Both ends are the same number where it is closed: q = 1
/// (to 8 roundings), or order path1 / (path1 + path2) is whole (to 4 roundings).
struct BandGap {
    double order = 0;
    double low_per_nm = 0, high_per_nm = 0;  ///< omega of the ends

    bool is_open() const { return low_per_nm < high_per_nm; }
    double centre_per_nm() const { return low_per_nm + (high_per_nm - low_per_nm) / 2; }
};

/// How well landmarks are found that have no formula: as stated below, or to 1e-10 in less time.
enum class Roots { exact, quick };

/// One landmark of given indices; relative errors of omega below 1e-15 plus those of rounding the
/// period. `order` whole, up to 1e9. omega_of_zero is infinite if path2_nm is 0.
double omega_of_mode(const BraggPeriod& period, double order);
double omega_of_airy(const BraggPeriod& period, double order, Roots roots = Roots::exact);
double omega_of_zero(const BraggPeriod& period, double order);
BandGap band_gap(const BraggPeriod& period, double order, Roots roots = Roots::exact);

/// A period whose indices depend on omega, for any omega > 0. May throw.
using PeriodAt = std::function<BraggPeriod(double omega_per_nm)>;

/// The gap whose ends are each taken with the indices at its own wavelength; one of them, if the
/// phases do not grow with omega everywhere.
BandGap band_gap(const PeriodAt& period, double order);

/// Closed range of omega, 1/nm; 0 < low <= high.
struct OmegaRange {
    double low_per_nm = 0, high_per_nm = 0;
};

/// All landmarks in a range, each with the indices at its own wavelength, by ascending omega; where
/// they coincide edges stand around their mode. Throws DomainError if they are of more than
/// kMostOrders orders, or if anomalous dispersion lets the phase of a layer fall with omega.
std::vector<Landmark> landmarks(const PeriodAt& period, const OmegaRange& range);

/// All gaps, closed ones too, that have a point in the range, by ascending order.
std::vector<BandGap> band_gaps(const PeriodAt& period, const OmegaRange& range);

inline constexpr double kMostOrders = 1e5;

}  // namespace irido
