#pragma once

#include <vector>

#include "core/spectrum/spectrum.hpp"

namespace irido {

/// Light from all directions within half_angle of an axis, in the incident medium, in degrees:
/// axis + half_angle in [0, 90].
struct Cone {
    double axis_deg = 0, half_angle_deg = 0;
};

/// Shares of s and p in the light of a cone at a polar angle, per radian of it.
struct ConeShares {
    double s = 0, p = 0;
};

/// A polar angle in radians, with the shares of a step of the parameter that it belongs to.
struct ConeNode {
    double theta = 0;
    ConeShares shares;

    IncidentAngle incidence() const;
};

/// Polar angles of a cone, in radians, and their shares. Radiance is uniform: an element of solid
/// angle has the weight cos(theta) dOmega, all together pi sin^2 a cos b for the half-angle a and
/// the axis b. R and T depend on the polar angle alone, so the azimuth is integrated here.
class ConeLight {
public:
    /// Throws DomainError if the cone passes 90 degrees.
    explicit ConeLight(const Cone& cone);

    /// The ends of its polar angles, and where its shares have a kink, in radians from the axis, so
    /// that narrow cones keep their digits: ascending.
    const std::vector<double>& ends() const { return ends_; }

    /// Of light that is polarized along the surface before a lens whose axis is the cone's: behind
    /// it a ray v has e' = e - (e.v)(a + v)/(1 + a.v). Light polarized across has s and p
    /// exchanged, and unpolarized light the mean of both. On a normal axis each is half.
    ///   offset   polar angle from the axis, radians
    ConeShares shares(double offset) const;

    /// The ends, and the critical angles of transparent media among them: ascending.
    ///   index   of media;   n0  of the incident one
    std::vector<double> smooth_ends(std::span<const Complex> index, double n0) const;

    /// The node at t in [i, i + 1] between the ends i and i + 1,
    ///     offset = begin + (end - begin)(1 - cos(pi (t - i)))/2,
    /// so that square roots at either end are smooth in t.
    ConeNode node(double t, std::span<const double> ends) const;

private:
    double axis_, half_angle_, norm_;
    std::vector<double> ends_;
};

/// What a cone means for the incident medium's index: a half-angle, or an f-number N of an
/// aplanatic lens, n sin(a) = 1/(2N).
struct ConeSize {
    double half_angle_deg = 0;  ///< unless
    double f_number = 0;        ///< is not 0

    bool is_none() const { return half_angle_deg == 0 && f_number == 0; }
    /// Degrees. Throws DomainError if n sin(a) = 1/(2N) has no solution.
    double half_angle(double incident_index) const;
};

/// The largest error of R, T and A over a cone.
inline constexpr double kConeError = 1e-10;

/// spectra() over cones about the angles: R, T, A and A_layers of light polarized along the
/// surface (s) and across it (p) before the lens. Integrals over the polar angle, split at the
/// critical angles of transparent media, to kConeError. Throws DomainError as ConeLight and
/// spectra() do, ToleranceError where resonances are too narrow.
///   stack       of the power;  table  of its materials
///   axes_deg    the cones' axes
void cone_spectra(const Stack& stack, const StackPower& power, const IndexTable& table,
                  std::span<const double> axes_deg, const ConeSize& size, const Needs& needs,
                  const Execution& execution, Spectra& out);

}  // namespace irido
