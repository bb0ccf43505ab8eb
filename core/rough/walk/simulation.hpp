#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/long_sum.hpp"
#include "core/rough/layered/layered_scattering.hpp"
#include "core/rough/walk/facet_table.hpp"

namespace irido {

/// How a path crosses rough layers.
enum class FacetChoice {
    sampled,  ///< a facet drawn at every crossing, of those that the direction sees
    filter,   ///< the mean over them, F_alpha: FPB24 eqs. 31 to 35
};

struct SimulationRequest {
    Paths paths = Paths::all;
    FacetChoice facets = FacetChoice::sampled;
    Crossings crossings = Crossings::single;  ///< of FacetChoice::filter
    std::uint64_t samples = 1'000'000;        ///< paths of each direction of the light, at least 2
    std::uint64_t first = 0;                  ///< number of the first one: others draw others
    std::uint64_t seed = 1;
};

/// Position-free Monte Carlo of a layered surface: paths of light between coating, layers and base,
/// with a visible facet (or the filter) at every layer, a cosine lobe at the base, and connections
/// to the directions asked for at every reflection upwards. All wavelengths follow one path, whose
/// choices are made with their mean; R comes from tables in steps of 0.01 degrees. Sample n of
/// light k draws from counters (n, k) of a Philox generator: neither the number of threads nor
/// other lights change it. Weights, corrected from FPB24 eqs. 31 to 33: a facet that reflects has
/// R G1(o)/(1 - p), one that lets through T G1(i)/p, the filter f_t cos/p.
class LayeredSimulation {
public:
    /// Refers to the scattering.
    LayeredSimulation(const LayeredScattering& scattering, const SimulationRequest& request,
                      const std::vector<double>& wavelength_nm, const Execution& execution);

    /// What each wavelength adds to X, Y and Z.
    using ColorWeights = std::array<std::vector<double>, 3>;

    /// Colours instead: wherever there is [wavelength] below it is [X, Y, Z].
    void set_colors(ColorWeights weights) { colors_ = std::move(weights); }

    /// The paths from `first` on, as many as `samples`.
    void set_paths(std::uint64_t first, std::uint64_t samples) {
        request_.first = first;
        request_.samples = samples;
    }

    /// Means and their standard errors, and the sums that they are of, which make those of some
    /// paths and of the others those of all, to the last digit.
    struct Values {
        std::vector<double> mean, error;
        std::vector<LongSum> sum, square;
        std::uint64_t samples = 0;

        /// Takes in other paths.
        void add(const Values& others);
        /// Means and errors of the sums.
        void set_means();
    };

    /// BRDF, [pair][wavelength]. Pairs of one theta_i share paths.
    Values brdf(std::span<const ScatterPair> pairs) const;

    /// Albedo, the coating's mirror included, [angle][wavelength].
    Values albedo(std::span<const double> theta_i_deg) const;

private:
    class Walk;
    Values simulated(std::span<const ScatterPair> pairs, double theta_i_deg, std::uint32_t light,
                     bool is_albedo) const;
    /// Numbers of each pair or angle.
    std::size_t numbers() const { return colors_[0].empty() ? wavelengths_ : colors_.size(); }

    const LayeredScattering& scattering_;
    SimulationRequest request_;
    std::size_t wavelengths_;
    std::vector<double> base_;  ///< albedo at each wavelength
    ColorWeights colors_;       ///< empty: the wavelengths themselves
    Execution execution_;
    std::vector<AngleTable> facets_, straight_;
};

}  // namespace irido
