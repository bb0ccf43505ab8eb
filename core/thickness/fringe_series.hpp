#pragma once

#include <optional>

#include "core/thickness/thickness_mean.hpp"

namespace irido {

/// R and T of a coherent stack as functions of one layer's thickness d, whose round trip multiplies
/// a wave by E = exp(i turn d), |E| <= 1:
///     R = |near + far E|^2 / |1 + bounce E|^2,    T = through |E| / |1 + bounce E|^2
struct Fringes {
    Complex near, far, bounce;
    double through;
    Complex turn_per_nm;  ///< 2 k0 kz, Im >= 0
};

/// Reflectance and transmittance, averaged over thicknesses.
struct MeanFringes {
    double R, T;
};

/// Means over a Gaussian thickness distribution truncated at zero: a series over round trips, each
/// term averaged in closed form. Returns nothing if that takes more terms than quadrature takes
/// thicknesses, or if the layer amplifies.
///   fringes   R and T as functions of the thickness
///   mean_nm   [0, 1e9]
///   sigma_nm  standard deviation before truncation, (0, 1e9]
///   needs_T   if false, T is returned as 0
std::optional<MeanFringes> mean_fringes(const Fringes& fringes, double mean_nm, double sigma_nm,
                                        bool needs_T = true);

}  // namespace irido
