#pragma once

#include <memory>
#include <vector>

#include "core/material/material.hpp"

namespace irido {

/// Upper bound on the error of r and t due to slicing a graded layer, provided kMostGradedSteps
/// suffice.
inline constexpr double kGradedError = 2e-11;
inline constexpr std::size_t kMostGradedSteps = 4096;

/// Wavelength at which that error is measured, nm; it falls as the fourth power of the wavelength.
inline constexpr double kGradedWavelength_nm = 380;

/// A graded layer sliced into homogeneous parts of equal thickness, see GradedHalfStep.
struct GradedLayer {
    std::vector<Material> parts;  ///< from the top
    double error = 0;             ///< estimated error of r and t between media of index n0, up to
                                  ///< 60 degrees in them, at kGradedWavelength_nm or the nearest
                                  ///< wavelength for which the materials have data
};

/// Slices a layer whose index runs from one material to another, doubling the number of steps until
/// r and t converge to kGradedError.
///   from, to      isotropic materials at the top and at the bottom
///   profile       shape of the index between them
///   thickness_nm  [0, 1e9]
///   n0            index of the incident medium, which sets the angles inside the layer
///   name          name of the parts in messages
/// Throws DomainError as index_at() does.
GradedLayer graded_layer(const Material& from, const Material& to, GradedProfile profile,
                         double thickness_nm, double n0, const std::string& name);

}  // namespace irido
