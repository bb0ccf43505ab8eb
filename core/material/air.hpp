#pragma once

#include "core/material/material.hpp"

namespace irido {

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
