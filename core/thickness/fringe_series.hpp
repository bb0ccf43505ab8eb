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

/// Means over a Gaussian of thicknesses, cut at zero: the series of the round trips, each term of
/// which is averaged in closed form. Nothing where it would take more terms than quadrature takes
/// thicknesses, or where the layer amplifies.
///   mean_nm   [0, 1e9]
///   sigma_nm  standard deviation before the cut, (0, 1e9]
///   needs_T   if not, T is 0
std::optional<MeanFringes> mean_fringes(const Fringes& fringes, double mean_nm, double sigma_nm,
                                        bool needs_T = true);

}  // namespace irido
