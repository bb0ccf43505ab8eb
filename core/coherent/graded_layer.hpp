#pragma once

#include <memory>
#include <vector>

#include "core/material/material.hpp"

namespace irido {

/// Error of r and t that the parts of a graded layer stay below, if kMostGradedSteps suffice.
inline constexpr double kGradedError = 2e-11;
inline constexpr std::size_t kMostGradedSteps = 4096;

/// Where this is measured, nm: it falls with the fourth power of longer wavelengths.
inline constexpr double kGradedWavelength_nm = 380;

/// A graded layer as homogeneous parts of equal thickness, see GradedHalfStep.
struct GradedLayer {
    std::vector<Material> parts;  ///< from the top
    double error = 0;             ///< estimate for r and t, between media of index n0, up to 60
                                  ///< degrees in them, at kGradedWavelength_nm or the end of what
                                  ///< the materials are known for that is next to it
};

/// The parts of a layer whose index goes from that of one material to that of another. As many as
/// the error needs: the layer is computed with twice the steps until it settles.
///   from, to      isotropic; name of the parts in messages
///   thickness_nm  [0, 1e9]
///   n0            of the incident medium, for its angles
/// Throws DomainError as index_at() does.
GradedLayer graded_layer(const Material& from, const Material& to, GradedProfile profile,
                         double thickness_nm, double n0, const std::string& name);

}  // namespace irido
