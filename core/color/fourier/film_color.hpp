#pragma once

#include <memory>
#include <string>

#include "core/color/color_request.hpp"
#include "core/color/color_tables.hpp"

namespace irido {

/// Whether the stack is at most one coherent film of real index on any base, as the Fourier method
/// requires.
bool is_one_film(const Stack& stack);

/// Why the stack is not such a film, in words; "" if it is.
std::string film_fault(const Stack& stack);

/// That film; if there is none, a layer of the incident medium with zero thickness.
Layer only_film(const Stack& stack);

/// Whether any index of the stack depends on the wavelength.
bool has_dispersion(const Stack& stack);

/// Colours of one film by BB17's series over the orders of interference,
///     T_j = T_0 H_j(0) + 2 sum_m T_0 rho^m Re( exp(i m phi) H_j(m D) ),   R_j = H_j(0) - T_j,
/// with FilmSeries's symbols and SensitivityTransform's H. `method` is fourier or fourier_constant.
///
/// Constant indices: exact, and `error` bounds what is left; it is infinite where method.count ends
/// the series.
/// A thickness_sigma_nm damps order m by exactly the spread of its path, (2 m n2 cos(theta2)
/// sigma)^2. Its Gaussian is not cut at zero thickness, unlike StackPower's, which `error` allows
/// for; orders are summed over all points of the sensitivity, some 20 us each.
///
/// Dispersion: an approximation whose `error` is infinite.
///   fourier           T_0 is the mean over two points of each channel, those of its Gauss rule;
///                     the logarithms of T_0, of one bounce and of its turn are lines through them.
///                     Order m then has m times the group path D_g = d(nu D + phi / 2 pi)/dnu, with
///                     the phase that matches at the centroid, and an imaginary path for the slope
///                     of its amplitude
///   fourier_constant  C_m, phi and D of each channel where BB17 has its peak: 600, 560 and 450 nm
/// The tables must outlive the result.
/// Throws DomainError if the stack is not one real film over a base, if there is no series at an
/// angle (past the film's critical angle, or over a base that amplifies as much), or a material is
/// not known where it is asked for. Source: BB17 section 4 (eqs. 5, 6 and 10) and section 5.
std::unique_ptr<ColorAlgorithm> film_color(const ColorTables& tables, const Stack& stack,
                                           const ColorMethod& method, const ColorRequest& request);

}  // namespace irido
