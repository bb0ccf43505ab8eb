#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/color/color_method.hpp"
#include "core/color/quadrature/integration.hpp"
#include "core/rough/layered/layered_scattering.hpp"

namespace irido {

/// XYZ of spectra [item][wavelength], sampled at the wavelengths of a rule.
std::vector<Triple> sampled_colors(const Sensitivity& sensitivity, const SampleRule& rule,
                                   std::span<const double> spectra);

struct SurfaceColor {
    Triple xyz{};
    double error = 0;  ///< estimated largest error of X, Y, Z
};

/// Colours of layered surfaces. The first layer contributes the colour of its facets at theta_d, by
/// color_algorithm()'s automatic method, times factors independent of wavelength; the layers below
/// are integrated over the spectrum together with the transmission of those above.
class LayeredColor {
public:
    /// tolerance  largest error of X, Y, Z, [1e-12, 1]: of BRDFs relative to 1 or, where that is
    ///            more, to the BRDF times pi of a mirror's facets
    /// method     of the first layer's colours; StackColor::error says what others than the
    ///            automatic one give
    /// Materials hold their end values where they are not known, see held_stack(), which throws
    /// DomainError; `tables` must outlive the result.
    LayeredColor(const ColorTables& tables, LayeredSurface surface, Crossings crossings,
                 double tolerance, const Execution& execution, const ColorMethod& method = {});

    /// pi times the BRDF of pairs of directions, so that a white diffuser has the illuminant's
    /// white. Where all paths have no closed form, their contribution is computed by Adding, with
    /// its error.
    std::vector<SurfaceColor> brdf(std::span<const ScatterPair> pairs, Paths paths) const;

    /// Directional-hemispherical albedo.
    std::vector<SurfaceColor> albedo(std::span<const double> theta_i_deg, Paths paths) const;

    const LayeredScattering& scattering() const { return scattering_; }

private:
    /// Spectra of several items, [item][wavelength], approximately in [0, 1].
    using SpectraAt = std::function<std::vector<double>(const std::vector<double>& wavelength_nm)>;
    std::vector<SurfaceColor> integrated(std::size_t count, double tolerance,
                                         const SpectraAt& spectra_at) const;
    void add_rest_of(std::span<const ScatterPair> pairs, std::span<SurfaceColor> colors) const;
    SurfaceColor lower_layer(std::size_t layer, const ScatterPair& inside) const;
    std::vector<SpectralPanel> panels(double path_nm) const;
    void add_first_layer(std::span<const ScatterPair> pairs, std::span<const double> factors,
                         std::span<SurfaceColor> colors) const;

    const ColorTables& tables_;
    double tolerance_;
    Execution execution_;
    ColorMethod method_;
    LayeredScattering scattering_;
    std::vector<double> pieces_;  ///< ends of the wavelength ranges in which everything is smooth
};

}  // namespace irido
