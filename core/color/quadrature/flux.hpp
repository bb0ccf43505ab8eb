#pragma once

#include <span>

#include "core/color/quadrature/integration.hpp"
#include "core/spectrum/spectrum.hpp"

namespace irido {

/// Whether T is flux / |D|^2 at every wavelength, as it is where all waves travel and nothing
/// absorbs.
///   spectrum  R or T, with denominators
///   flux      set to that flux
bool has_flux(const Spectrum& spectrum, double& flux);

/// Rows from one polarization, or the mean of two, and the denominators of both.
///   sides    of the rows
///   first    at the points of `samples`
///   second   nullptr if there is none
///   samples  sized
void fill_samples(std::span<const Side> sides, const Spectrum& first, const Spectrum* second,
                  Samples& samples);

}  // namespace irido
