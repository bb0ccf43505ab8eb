#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/math/simd_level.hpp"

namespace irido {

/// Trigonometric functions of one angle theta in [0, 90] degrees that F_alpha needs: sines and
/// cosines of theta / 2 and of (90 - theta) / 2. From these, sines of half the sum of two angles
/// follow without cancellation.
struct HalfAngles {
    double deg = 0;
    double sin = 0, cos = 1;            ///< of theta / 2
    double sin_left = 0, cos_left = 0;  ///< of (90 - theta) / 2

    explicit HalfAngles(double theta_deg);
};

/// HalfAngles of many angles, as rows for vector code.
class FilterAxis {
public:
    /// Throws DomainError naming `name` unless every angle is in [0, 90].
    FilterAxis(std::span<const double> theta_deg, const char* name,
               SimdLevel level = SimdLevel::plain);

    std::size_t count() const { return count_; }
    const double* deg() const { return row(0); }
    const double* sin() const { return row(1); }
    const double* cos() const { return row(2); }
    const double* sin_left() const { return row(3); }
    const double* cos_left() const { return row(4); }

private:
    const double* row(std::size_t i) const { return values_.data() + i * stride_; }

    std::size_t count_, stride_;
    std::vector<double> values_;  ///< [row][angle], each row padded by kMostLanes
};

/// Transmission filter of a rough layer, per radian of theta_d: the fraction of the light incident
/// at theta_i that passes through facets it meets at theta_d,
///     F_alpha = 2 G1(ti)^2 (cos td / cos ti) sin td  integral_0^psi_max D(theta_m) dpsi,
///     cos theta_m = cos ti cos td + sin ti sin td cos psi.
/// Its integral over theta_d from 0 to 90 degrees is G1(theta_i).
/// Source: FPB24 eqs. 24 to 30.
///
/// The integral over psi has a closed form. With x = cos theta_m and s = sqrt(1 - alpha^2),
///     1/(1 - s^2 x^2)^2 = 1/4 sum over both signs of [1/(1 -+ s x)^2 + 1/(1 -+ s x)],
/// and 1 -+ s x = p + q cos psi, which is P at psi = 0 and M at psi = pi:
///     J1 = integral dpsi/(p + q cos psi)   = 2/sqrt(P M) atan2(sqrt(M) sin(psi/2),
///                                                              sqrt(P) cos(psi/2))
///     J2 = integral dpsi/(p + q cos psi)^2 = (p J1 - q sin psi/(p + q cos psi)) / (P M)
/// Let A = cos(ti - td) and B = -cos(ti + td). If B > 0 the integral ends at cos theta_m = 0, where
/// p + q cos psi = 1, sin^2(psi/2) : cos^2(psi/2) = A : B and q sin psi = -+ s sqrt(A B). Otherwise
/// it ends at pi, which corresponds to B = 0 in the same formulas.
///
/// The following is free of cancellation for every alpha:
///     P- = alpha^2/(1 + s) + 2 s sin^2((ti - td)/2)   P+ = 2 - P-
///     M- = alpha^2/(1 + s) + 2 s sin^2((ti + td)/2)
///     M+ = alpha^2/(1 + s) + 2 s cos^2((ti + td)/2),  p = (P + M)/2
/// ti - td and ti + td - 90 are computed in degrees, where they are exact if small. Errors of P+,
/// and of the subtraction in J2 for the plus sign, are negligible next to the term of the minus
/// sign.
class TransmissionFilter {
public:
    /// alpha in [1e-4, 1], else DomainError.
    explicit TransmissionFilter(double alpha);

    double alpha() const { return alpha_; }

    /// F_alpha with a relative error below 1e-14 (2e-15 measured). Both angles in [0, 90] degrees,
    /// else DomainError; 0 where theta_i is 90 or theta_d is 0 or 90.
    double operator()(double theta_i_deg, double theta_d_deg) const;
    double operator()(const HalfAngles& theta_i, const HalfAngles& theta_d) const;

    /// The corresponding filter for facets that straight light meets from behind,
    ///     2 (G1(ti)/cos ti) cos td sin td  integral D(theta_m) dpsi   over cos theta_m < 0,
    /// whose integral over theta_d is 1 - G1(theta_i); 0 up to theta_d = 90 - theta_i. The error is
    /// 1e-15 of the largest value of F_alpha.
    double behind(double theta_i_deg, double theta_d_deg) const;

    /// F_alpha for one theta_i and many theta_d, with the same error.
    ///   theta_i_deg  [0, 90] degrees
    ///   theta_d      axis of angles
    ///   out          results, one per theta_d
    ///   level        instruction set
    void row(double theta_i_deg, const FilterAxis& theta_d, std::span<double> out,
             SimdLevel level) const;

private:
    /// Integrals of D(theta_m) over psi, without the factor alpha^2/pi: over cos theta_m > 0, and
    /// over the whole ring if part of it has cos theta_m < 0, else 0.
    struct Rings {
        double seen, whole;
    };
    Rings rings(const HalfAngles& theta_i, const HalfAngles& theta_d) const;
    /// Factor that does not depend on theta_d.
    double scale(const HalfAngles& theta_i) const;

    double alpha_;
    double s_, rest_;  ///< sqrt(1 - alpha^2) and 1 - s
};

}  // namespace irido
