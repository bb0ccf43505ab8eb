#pragma once

#include <span>
#include <vector>

#include "core/rough/layered/layered_scattering.hpp"

namespace irido {

/// Light reflected more than once between the layers, base and coating of a surface, by the adding
/// method in azimuthal modes. Let K_l^m(i,o) be the m-th mode of a layer's lobe, (1/2 pi) integral
/// f_l cos(m phi) dphi, tau_l its straight transmission, and w the weights of the angle nodes, 2 pi
/// cos sin dtheta. From the base (which has mode 0 only) upwards
///     B <- K_l + tau_l (1 - B w K_l w)^-1 B tau_l,
/// and with a coating of reflectance R0, whose mirror reflection rotates the azimuth by half a
/// turn,
///     U = (1 - (-1)^m B w R0)^-1 B.
/// Single reflections are subtracted analytically: the rest is smooth and needs few modes. The
/// angles requested are added as nodes of zero weight. Nodes and modes are refined until two levels
/// agree.
/// Source: H. C. van de Hulst, Multiple Light Scattering (1980), chapter 4; for the individual
/// facets, FPB24 section 4.
class Adding {
public:
    /// Refers to `scattering`. `tolerance` is relative to the sum over all paths.
    Adding(const LayeredScattering& scattering, double tolerance, const Execution& execution);

    struct Values {
        std::vector<double> values;
        double error = 0;  ///< largest estimate, relative to the value for all paths
    };

    /// What all paths add to the BRDF by single reflections, [pair][wavelength].
    Values brdf_rest(std::span<const ScatterPair> pairs,
                     const std::vector<double>& wavelength_nm) const;

    /// Contribution of multiple reflections to the albedo, [angle][wavelength].
    Values albedo_rest(std::span<const double> theta_i_deg,
                       const std::vector<double>& wavelength_nm) const;

private:
    struct Grid;
    struct Lobes;
    Grid grid_of(std::size_t level, std::span<const double> extra_deg) const;
    Lobes lobes_of(const Grid& grid, std::size_t layer, std::size_t azimuths) const;
    template <class Take>
    void solve(const Grid& grid, std::span<const Lobes> lobes, std::span<const double> tau,
               double wavelength_nm, std::size_t most_modes, const Take& take) const;
    std::size_t first_level() const;

    const LayeredScattering& scattering_;
    double tolerance_;
    Execution execution_;
};

}  // namespace irido
