#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/rough/facet_series.hpp"
#include "core/rough/filter.hpp"
#include "core/rough/layered/layered_surface.hpp"
#include "core/rough/layered/lobe_nodes.hpp"

namespace irido {

/// How straight rays cross a rough layer.
enum class Crossings {
    single,    ///< one facet each, FPB24's f_t cos
    multiple,  ///< as many as Smith's model has on a straight ray, 1 + 2 Lambda on average
};

/// What one rough layer does with light, a wavelength at a time: what is computed once is kept.
/// Safe from many threads; a value depends on its own arguments only.
class LayerTransport {
public:
    /// Throws DomainError for an alpha outside [1e-4, 1] and as StackPower does.
    LayerTransport(const RoughLayer& layer, SimdLevel simd);

    double alpha() const { return filter_.alpha(); }
    /// Functions of its series.
    static constexpr std::size_t kR = 0, kT = 1;
    const FacetSeries& facets() const { return facets_; }

    /// f_t cos of straight light, [wavelength]: tau, or with Crossings::multiple
    ///     tau* = tau / (1 - (1 - G1) Tf Tb),
    /// Tf and Tb being the means of T over the facets that the ray meets from the front and from
    /// behind: 1 where T = 1. theta_deg [0, 90].
    std::vector<double> straight(double theta_deg, std::span<const double> wavelength_nm,
                                 Crossings crossings) const;

    /// R of the facets at all wavelengths, then T, as one series on panels of 3 degrees, and
    /// straight light by it: quicker than the above for many angles that are asked for once.
    /// Resonances at grazing angles, narrower than the panels, are worth 1e-5 of 1.
    AngleSeries powers(const std::vector<double>& wavelength_nm) const;
    std::vector<double> straight(const AngleSeries& powers, double theta_deg,
                                 Crossings crossings) const;

private:
    struct Moments;
    std::shared_ptr<Moments> moments_of(double theta_deg, bool behind) const;

    SimdLevel simd_;
    TransmissionFilter filter_;
    FacetSeries facets_;
    mutable std::mutex lock_;
    mutable std::map<std::pair<double, bool>, std::shared_ptr<Moments>> moments_;
};

}  // namespace irido
