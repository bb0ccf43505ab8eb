#pragma once

#include <span>
#include <vector>

#include "core/color/color_tables.hpp"
#include "core/rough/facet_series.hpp"
#include "core/rough/layered/layered_color.hpp"

namespace irido {

/// Light that a rough stack refracts into its substrate: facets of GGX roughness, each the stack,
/// T(theta) times refraction_lobe(). Of one film that is BB17's transmission, whose T is the Airy
/// sum's. A pair's theta_o counts from the normal below, in the substrate; azimuth 180 is the side
/// to which light goes straight on.
class RefractedLight {
public:
    /// Throws DomainError for an alpha outside [1e-4, 1], a uniaxial medium on either side, and as
    /// StackPower does.
    RefractedLight(Stack stack, double alpha, const Execution& execution);

    /// Per steradian, of radiance, [pair][wavelength]. Throws DomainError where the substrate
    /// absorbs, or has the index of the incident medium: light then goes straight on.
    std::vector<double> btdf(std::span<const ScatterPair> pairs,
                             const std::vector<double>& wavelength_nm) const;

    /// X, Y, Z of pi times it. With media of constant index on both sides the colour of T at the
    /// facet, by the method; else, by the automatic one, a sum over wavelengths 1 nm apart, which
    /// refract at facets of their own; other methods take the facet of 550 nm. A method that knows
    /// reflection alone has T = 1 - R, as BB17 do, which takes a film that does not absorb. The
    /// materials hold their end values, see held_stack(). Errors as those of stack_color().
    std::vector<SurfaceColor> color(const ColorTables& tables, std::span<const ScatterPair> pairs,
                                    const ColorMethod& method, double tolerance) const;

private:
    struct Lobes {
        std::vector<double> theta_deg, scale;  ///< of each pair; scale 0 where no facet is there
    };
    Lobes lobes(std::span<const ScatterPair> pairs, double wavelength_nm) const;
    bool is_constant() const;

    double alpha_;
    Execution execution_;
    FacetSeries facets_;
};

}  // namespace irido
