#pragma once

#include <cmath>
#include <optional>

#include "core/coherent/coherent.hpp"

namespace irido {

/// A transparent film between two half-spaces.
struct Film {
    double incident = 1;      ///< index n1 > 0
    double film = 1;          ///< index n2 > 0
    Complex base = 1;         ///< index n3 + i k3
    double thickness_nm = 0;  ///< d
};

/// Powers of a film as Fourier series in its fringe phase, at one angle, polarization and set of
/// indices:
///     R = R_0 - 2 T_0 sum_{m>=1} rho^m cos(m Phi),   T = T_0 + 2 T_0 sum_{m>=1} rho^m cos(m Phi),
///     Phi = 2 pi D / lambda + phi,   T_0 = T12 T23 / (1 - R12 R23),
///     R_0 = R12 + T12^2 R23 / (1 - R12 R23).
/// BB17's C_0 is R_0, and its C_m = rho^m (R* - T12) is -rho^m T_0 because the film is lossless.
/// T23 is the real flux into the base. Source: BB17 eqs. 5 and 6 and its appendix.
struct FilmSeries {
    double R = 0, T = 0;  ///< R_0 and T_0
    Complex bounce{};     ///< round-trip coefficient r21 r23, of the tangential electric field
    double opd_nm = 0;    ///< optical path difference D = 2 n2 d cos(theta2)

    double ratio() const { return std::sqrt(std::norm(bounce)); }  ///< rho = sqrt(R12 R23), [0, 1)
    double phase_rad() const { return std::arg(bounce); }          ///< phi = arg(r21) + arg(r23)
    /// C_m of R or T.
    double coefficient(bool transmitted, double order) const;
};

/// The series, with `incidence` in the incident medium. Returns nothing where it does not exist:
/// beyond the film's critical angle, and on a base with so much gain that rho >= 1. Where no light
/// enters the base, and at 90 degrees unless all media are the same, R = 1 and T = 0.
std::optional<FilmSeries> film_series(const Film& film, IncidentAngle incidence,
                                      Polarization polarization);

}  // namespace irido
