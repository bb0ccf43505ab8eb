#pragma once

#include "core/material/material.hpp"

namespace irido {

/// The same within 230 to 1690 nm, of s2 = 1/wavelength^2 in 1/um^2: a number or a series.
template <class Number>
Number air_index(const Number& s2, double temperature_c) {
    constexpr double kZero_k = 273.15, kCiddor_c = 15;
    const Number at_15_c = 0.05792105 / (238.0185 - s2) + 0.00167917 / (57.362 - s2);
    return 1 + at_15_c * (kCiddor_c + kZero_k) / (temperature_c + kZero_k);
}

/// Where it is known; outside its end values hold.
inline constexpr WavelengthRange kAirKnown{230, 1690};

/// Index of dry air of 450 ppm CO2 at 101325 Pa and a temperature in [-40, 100] C, for a vacuum
/// wavelength; outside 230 to 1690 nm the end values hold.
/// Source: P. E. Ciddor, Appl. Opt. 35, 1566 (1996), for 15 C; n - 1 goes with the density of an
/// ideal gas from there.
double index_of_air(double wavelength_nm, double temperature_c);

/// The vacuum wavelength of a wave in air, and back; nm.
double vacuum_wavelength(double in_air_nm, double temperature_c);
double air_wavelength(double in_vacuum_nm, double temperature_c);

/// A table of n, or of k, at vacuum wavelengths, n as the index against vacuum. The values of k
/// stay; the first holds from its own wavelength on, as ranges of formulas, round numbers, stay,
/// too.
Table in_vacuum(Table table, const Reference& reference, bool is_n);

}  // namespace irido
