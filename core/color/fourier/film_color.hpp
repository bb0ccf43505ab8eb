#pragma once

#include <memory>
#include <string>

#include "core/color/color_method.hpp"

namespace irido {

/// Whether the stack is at most one coherent film of real index on any base, as the Fourier method
/// requires.
bool is_one_film(const Stack& stack);

/// Why the stack is not such a film, in words; "" if it is.
std::string film_fault(const Stack& stack);

/// The same as a sentence, for the Fourier method.
std::string series_fault(const Stack& stack);

/// That film; if there is none, a layer of the incident medium with zero thickness.
Layer only_film(const Stack& stack);

/// Whether any index of the stack depends on the wavelength.
bool has_dispersion(const Stack& stack);

/// Colours of one film by BB17's series over the orders of interference,
///     T_j = T_0 H_j(0) + 2 sum_m T_0 rho^m Re( exp(i m phi) H_j(m D) ),   R_j = H_j(0) - T_j,
/// with FilmSeries's symbols and SensitivityTransform's H. `method` is fourier or
/// fourier-constant.
///
/// Constant indices: exact, with `error` a bound on the remainder; it is infinite if method.count
/// truncates the series. A thickness_sigma_nm damps order m exactly, by the variance
/// (2 m n2 cos(theta2) sigma)^2 of its optical path difference. Unlike StackPower's, its Gaussian
/// is not truncated at zero thickness, which `error` allows for; orders are then summed over all
/// points of the weighted colour-matching functions, at some 20 us each.
///
/// Dispersion: an approximation whose `error` is infinite.
///   fourier           T_0 is the mean over two points per channel, those of its Gauss rule; the
///                     logarithms of T_0 and of one round trip, its phase included, are lines
///                     through them. Order m has m times the group path difference
///                     D_g = d(nu D + phi / 2 pi)/dnu, a phase that matches at the centroid, and an
///                     imaginary path difference for the slope of its amplitude
///   fourier-constant  C_m, phi and D of each channel at BB17's peaks: 600, 560 and 450 nm
/// Throws DomainError if there is no series at an angle (beyond the film's critical angle, or on a
/// base with too much gain), or if a material has no data where needed.
///   tables   observer and illuminant; must outlive the result
///   stack    the film, without a series_fault()
///   method   fourier or fourier-constant
///   request  options
/// Source: BB17 section 4 (eqs. 5, 6 and 10) and section 5.
std::unique_ptr<ColorAlgorithm> film_color(const ColorTables& tables, const Stack& stack,
                                           const ColorMethod& method, const ColorRequest& request);

}  // namespace irido
