#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/rough/layered/layered_scattering.hpp"

namespace irido {

/// Light that is reflected more than once between the layers, the base and the coating of a
/// surface, by the adding method in azimuthal modes. With K_l^m(i,o) the m-th mode of a layer's
/// lobe, (1/2 pi) integral f_l cos(m phi) dphi, tau_l its straight transmission and w the weights
/// of angle nodes, 2 pi cos sin dtheta, from the base (in mode 0 alone) upwards
///     B <- K_l + tau_l (1 - B w K_l w)^-1 B tau_l,
/// and with a coating of reflectance R0, whose mirror turns the azimuth by half a turn,
///     U = (1 - (-1)^m B w R0)^-1 B.
/// What is reflected once is left out, analytically: the rest is smooth and needs few modes. Angles
/// asked for are nodes without a weight. Nodes and modes are refined until two levels agree.
/// Source: H. C. van de Hulst, Multiple Light Scattering (1980), chapter 4; of the single facets,
/// FPB24 section 4.
class Adding {
public:
    /// Refers to the scattering. tolerance is relative to what all paths together give.
    Adding(const LayeredScattering& scattering, double tolerance, const Execution& execution);

    /// How finely angles and modes are taken, and what that leaves.
    struct Level {
        std::size_t level = 0;
        double error = 0;  ///< largest difference from the next finer one, relative to all paths
    };

    /// The coarsest level whose values at these wavelengths differ from the next one's by the
    /// tolerance at most, or the last but one.
    Level level_of(std::span<const ScatterPair> pairs,
                   const std::vector<double>& wavelength_nm) const;

    /// What all paths add to the BRDF by single reflections, [pair][wavelength], at a level.
    std::vector<double> brdf_rest(std::span<const ScatterPair> pairs,
                                  const std::vector<double>& wavelength_nm,
                                  std::size_t level) const;

    struct Values {
        std::vector<double> values;
        double error = 0;  ///< largest estimate, relative to the value by all paths
    };

    /// The same at the level that the tolerance takes, judged at some of the wavelengths; the finer
    /// of the two compared where that is all of them.
    Values brdf_rest(std::span<const ScatterPair> pairs,
                     const std::vector<double>& wavelength_nm) const;

    /// What they add to the albedo, [angle][wavelength].
    Values albedo_rest(std::span<const double> theta_i_deg,
                       const std::vector<double>& wavelength_nm) const;

private:
    struct Grid;
    struct Lobes;
    struct Workspace;
    /// Values of things at a level, [thing][wavelength].
    using AtLevel = std::function<std::vector<double>(const std::vector<double>& wavelength_nm,
                                                      std::size_t level)>;
    /// once  by single reflections, as AtLevel's values are
    template <class Once>
    Level level_of(const std::vector<double>& wavelength_nm, const Once& once,
                   const AtLevel& at_level, std::vector<double>* finer) const;
    template <class Once>
    Values refined(const std::vector<double>& wavelength_nm, const Once& once,
                   const AtLevel& at_level) const;

    Grid grid_of(std::size_t level, std::span<const double> extra_deg) const;
    Lobes lobes_of(const Grid& grid, std::size_t layer, std::size_t azimuths) const;
    /// f_t cos of all layers, [wavelength][layer][angle].
    std::vector<double> straight_of(const Grid& grid,
                                    const std::vector<double>& wavelength_nm) const;
    template <class Take>
    void solve(const Grid& grid, std::span<const Lobes> lobes, std::span<const double> tau,
               double wavelength_nm, std::size_t most_modes, bool to_nodes, const Take& take) const;
    std::vector<double> block_at(std::span<const ScatterPair> pairs,
                                 const std::vector<double>& wavelength_nm, std::size_t level) const;
    std::size_t first_level() const;

    const LayeredScattering& scattering_;
    double tolerance_;
    Execution execution_;
};

}  // namespace irido
