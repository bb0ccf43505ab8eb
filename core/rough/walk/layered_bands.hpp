#pragma once

#include <span>
#include <vector>

#include "core/rough/layered/lobe.hpp"
#include "core/rough/walk/tabulated_scattering.hpp"

namespace irido {

/// A layered surface in a few bands of the spectrum, for shaders: in every band R of each layer
/// over theta_d, the straight light of each layer over the angle inside, and the base, each a mean
/// over the band; and what a band weighs in X, Y and Z. Colours under layers are products of
/// spectra, not of colours: with enough bands the sum over bands of products is near them.
struct LayeredBands {
    std::size_t bands = 0, angles = 0;           ///< angles equally spaced from 0 to 90 degrees
    std::vector<Triple> weight;                  ///< XYZ of each band
    std::vector<std::vector<double>> reflected;  ///< of each layer: [angle][band]
    std::vector<std::vector<double>> straight;   ///< the same of f_t cos / G1; ones at the last
                                                 ///< layer where nothing is below
    std::vector<double> base;                    ///< albedo, for all paths over 1 - albedo rbar

    /// XYZ of the BRDF per steradian, by linear interpolation in both tables, as a shader has it.
    Triple operator()(const LayeredScattering& scattering, const ScatterPair& pair) const;
};

/// Bands with equal shares of X + Y + Z of the rule's light. bands in [1, 64], angles >= 2.
/// Throws as LayeredScattering::base_factors() does.
LayeredBands layered_bands(const LayeredScattering& scattering, const Sensitivity& sensitivity,
                           const SampleRule& rule, Paths paths, Crossings crossings,
                           std::size_t bands, std::size_t angles, const Execution& execution);

}  // namespace irido
