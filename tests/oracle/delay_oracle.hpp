#pragma once

#include "core/spectrum/delay.hpp"

namespace irido::oracle {

/// Phases and delays of a coherent stack by central differences of 100-digit amplitudes, which come
/// from Airy's formula layer by layer with groups expanded: shares no formula with the kernel.
/// Supports materials that are constant or use dispersion formulas 2 and 5.
///   stack          the stack
///   wavelength_nm  vacuum wavelength, nm
///   angle_deg      angle of incidence, degrees
///   polarization   s or p
Delays differenced_delays(const Stack& stack, double wavelength_nm, double angle_deg,
                          Polarization polarization);

/// Moduli of r and t from the same amplitudes as differenced_delays().
struct Moduli {
    double r, t;
};
/// Moduli of these amplitudes.
/// stack          the stack
/// wavelength_nm  vacuum wavelength, nm
/// angle_deg      angle of incidence, degrees
/// polarization   s or p
Moduli moduli(const Stack& stack, double wavelength_nm, double angle_deg,
              Polarization polarization);

}  // namespace irido::oracle
