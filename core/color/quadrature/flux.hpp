#pragma once

#include "core/spectrum/spectrum.hpp"

namespace irido {

/// Whether T is flux / |D|^2 at every wavelength, as it is where all waves travel and nothing
/// absorbs.
///   spectrum  R or T, with denominators
///   flux      set to that flux
bool has_flux(const Spectrum& spectrum, double& flux);

}  // namespace irido
