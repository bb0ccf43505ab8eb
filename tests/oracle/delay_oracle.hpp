#pragma once

#include "core/spectrum/delay.hpp"

namespace irido::oracle {

/// Phases and delays of a coherent stack by central differences of 100-digit amplitudes, which come
/// from Airy's formula layer by layer, groups written out: shares no formula with the kernel. Takes
/// materials that are constant or dispersion formulas 2 and 5.
Delays differenced_delays(const Stack& stack, double wavelength_nm, double angle_deg,
                          Polarization polarization);

/// Modulus of r and t of the same.
struct Moduli {
    double r, t;
};
Moduli moduli(const Stack& stack, double wavelength_nm, double angle_deg,
              Polarization polarization);

}  // namespace irido::oracle
