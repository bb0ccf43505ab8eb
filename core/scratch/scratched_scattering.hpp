#pragma once

#include <span>
#include <variant>
#include <vector>

#include "core/colorimetry/sensitivity.hpp"
#include "core/math/simd_level.hpp"
#include "core/scratch/diffraction.hpp"
#include "core/scratch/energy.hpp"
#include "core/scratch/ensemble.hpp"
#include "core/scratch/light.hpp"
#include "core/scratch/light_integral.hpp"
#include "core/scratch/scratched_surface.hpp"

namespace irido {

/// What looks at a surface.
using ScratchSight = std::variant<SurfacePoint, Footprint>;

/// How scratches are added up.
struct ScratchSum {
    enum class Kind {
        separate,  ///< powers add
        coherent,  ///< waves add, of all scratches
        ensemble,  ///< the mean over all places of the fields, as infinite scratches
    };
    Kind kind = Kind::separate;
    ScratchEnergy energy = ScratchEnergy::balanced;
};

/// Directions away from the surface.
struct SkyPair {
    UnitVector light, view;
};

/// BRDF of a scratched surface seen from a point or by a footprint:
///     f = R(lambda, theta_d) [w sum f_m + w_B D G1 G1/(4 cos theta_i cos theta_o)]
/// with the balance w, w_B at the view's mirror direction, and the second term where the base is
/// rough. Without a base R = w = 1 and w_B = 0. The mirror of a smooth base is left out.
/// Source: VWH18 eqs. 4 to 6, corrected as scratch_brdf() and scratch_balance() say.
/// Safe from many threads.
class ScratchedScattering {
public:
    /// Draws the fields' scratches as far as 6 coherence radii (for waves 9) beyond what is seen.
    /// Throws DomainError for members out of range, and for more than kMostSeen scratches times
    /// points of a footprint.
    ScratchedScattering(ScratchedSurface surface, const ScratchSight& sight, const ScratchSum& sum,
                        const Execution& execution);

    /// Share of the area that scratches cover, each counted, seen or on average.
    double density() const;
    std::size_t scratches() const { return visible_.size(); }
    /// Whether an end of a scratch lies nearer than 3 coherence radii to what is seen.
    bool ends_nearby() const;

    /// Per steradian, [pair][wavelength]; wavelengths in [1, 1e7] nm.
    std::vector<double> brdf(std::span<const SkyPair> pairs,
                             const std::vector<double>& wavelength_nm) const;
    /// Colours of the BRDF (not times pi), integrals to 1e-11 relative but for kinks of materials.
    std::vector<Triple> colors(std::span<const SkyPair> pairs,
                               const Sensitivity& sensitivity) const;

    /// Outgoing radiance over that of the lights, which must not overlap, [view][wavelength].
    /// Throws DomainError for waves and ensembles, which lights are not integrated over.
    std::vector<double> light_ratios(std::span<const LightCone> lights,
                                     std::span<const UnitVector> views,
                                     const std::vector<double>& wavelength_nm,
                                     const LightIntegral& method) const;
    /// Its colours, to 1e-8 of the largest but for kinks of materials.
    std::vector<Triple> light_colors(std::span<const LightCone> lights,
                                     std::span<const UnitVector> views,
                                     const Sensitivity& sensitivity,
                                     const LightIntegral& method) const;

    static constexpr double kMostSeen = 2e7;

private:
    std::vector<ScratchBalance> balances(double view_rise,
                                         const std::vector<double>& wavelength_nm) const;
    /// Adds what all scratches reflect of a light, whose slices are across each of them.
    void add_light(const std::vector<LightSlices>& slices, const UnitVector& view,
                   const std::vector<double>& nu, const LightIntegral& method,
                   const CosineSeries& reflectance, std::vector<double>& sums) const;
    /// Of the Gauss rule for a light that is almost a point; 0 for others.
    int order_of(const LightCone& light, const std::vector<double>& wavelength_nm) const;
    /// Adds what is reflected of such a light.
    void add_points(const AreaLight& light, int order, const UnitVector& view,
                    const std::vector<double>& wavelength_nm, std::vector<double>& sums) const;
    std::vector<double> separate(const SkyPair& pair,
                                 const std::vector<double>& wavelength_nm) const;
    double coherent(const SkyPair& pair, double wavelength_um) const;
    double ensemble(const SkyPair& pair, double wavelength_um) const;
    std::vector<double> pair_brdf(const SkyPair& pair,
                                  const std::vector<double>& wavelength_nm) const;
    double longest_path_um(const SkyPair& pair) const;

    ScratchedSurface surface_;
    ScratchSum sum_;
    Execution execution_;
    std::vector<VisibleScratch> visible_;
    /// Of waves: a point, or those of a footprint, each with what it sees.
    struct Place {
        double weight;
        std::vector<VisibleScratch> visible;
    };
    std::vector<Place> places_;
    std::vector<ScratchEnsemble> ensembles_;
};

/// The parts of a field, seen on average: Gauss points of width and depth with their shares.
std::vector<ScratchEnsemble> ensembles_of(const ScratchField& field);

}  // namespace irido
