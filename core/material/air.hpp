#pragma once

#include "core/material/material.hpp"

namespace irido {

/// index_of_air() within 230 to 1690 nm, from s2 = 1/wavelength^2 in 1/um^2: a number or a series.
template <class Number>
Number air_index(const Number& s2, double temperature_c) {
    constexpr double kZero_k = 273.15, kCiddor_c = 15;
    const Number at_15_c = 0.05792105 / (238.0185 - s2) + 0.00167917 / (57.362 - s2);
    return 1 + at_15_c * (kCiddor_c + kZero_k) / (temperature_c + kZero_k);
}

/// Range of the formula; clamped outside.
inline constexpr WavelengthRange kAirKnown{230, 1690};

/// Index of dry air with 450 ppm CO2 at 101325 Pa and a temperature in [-40, 100] C, for a vacuum
/// wavelength; clamped outside 230 to 1690 nm. Temperatures other than 15 C scale n - 1 with the
/// density of an ideal gas.
/// Source: P. E. Ciddor, Appl. Opt. 35, 1566 (1996), for 15 C.
double index_of_air(double wavelength_nm, double temperature_c);

/// Converts a wavelength in air to vacuum, and back; nm.
double vacuum_wavelength(double in_air_nm, double temperature_c);
double air_wavelength(double in_vacuum_nm, double temperature_c);

/// Converts a table of n or of k to vacuum wavelengths, and n to the index relative to vacuum. The
/// values of k are unchanged. The first value is extended down to its unconverted wavelength, so
/// that the table starts at the same round number as the ranges of formulas.
Table in_vacuum(Table table, const Reference& reference, bool is_n);

}  // namespace irido
