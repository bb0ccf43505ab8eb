#pragma once

#include <span>
#include <vector>

#include "core/colorimetry/sensitivity.hpp"
#include "core/rough/layered/layered_scattering.hpp"
#include "core/rough/layered/lobe.hpp"
#include "core/rough/walk/facet_table.hpp"

namespace irido {

/// Colours of a layered surface for very many pairs of directions: R and f_t cos of every layer on
/// uniform grids of angles, linear in between (1e-4 of R measured), at the wavelengths of a plain
/// rule. All paths where they have a closed form.
class TabulatedScattering {
public:
    /// Throws as LayeredScattering::brdf() does.
    TabulatedScattering(const LayeredScattering& scattering, const SampleRule& rule, Triple white,
                        Paths paths, Crossings crossings, const Execution& execution);

    /// What one direction outside needs, made once.
    struct Direction {
        double theta_inside_deg = 0, transmittance = 1;
        std::vector<double>
            straight;  ///< prod f_t cos above each layer and the base, [l][wavelength]
    };
    /// theta_deg in [0, 90]
    Direction direction(double theta_deg) const;

    /// X, Y, Z of the BRDF, per steradian.
    ///   near, far  cos and sin of half the azimuth between the directions
    Triple operator()(const Direction& i, const Direction& o, double near, double far) const;
    /// The same of a facet, inside the coating, that is given.
    Triple operator()(const Direction& i, const Direction& o, const MirrorFacet& facet) const;

    std::size_t wavelengths() const { return wavelengths_; }
    const std::vector<double>& wavelength_nm() const { return wavelength_nm_; }
    /// X of a spectrum is the sum of its products with weight()[0].
    const std::array<std::vector<double>, 3>& weight() const { return weight_; }
    /// R and T of each layer; f_t cos / G1 of each that light crosses.
    const std::vector<AngleTable>& facets() const { return facets_; }
    const std::vector<AngleTable>& straight() const { return straight_; }
    /// Albedo of the base by wavelength, for all paths over 1 - albedo rbar; none if it is black.
    const std::vector<double>& base() const { return base_; }

private:
    const LayeredScattering& scattering_;
    std::vector<double> wavelength_nm_;
    std::size_t wavelengths_;
    std::array<std::vector<double>, 3> weight_;
    std::vector<AngleTable> facets_, straight_;
    std::vector<double> base_;
};

}  // namespace irido
