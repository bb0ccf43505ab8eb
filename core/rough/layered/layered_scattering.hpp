#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/math/lazy.hpp"
#include "core/rough/layered/base_light.hpp"
#include "core/rough/layered/coating.hpp"
#include "core/rough/layered/layer_transport.hpp"
#include "core/rough/layered/layered_surface.hpp"

namespace irido {

/// Light paths taken into account.
enum class Paths {
    single,  ///< a single reflection, by a layer or the base: FPB24 eq. 34
    all,     ///< any number of reflections between layers, base and coating
};

/// A pair of directions outside a surface, pointing away from it.
struct ScatterPair {
    double theta_i_deg = 0, theta_o_deg = 0;  ///< [0, 90]
    double phi_deg = 180;                     ///< azimuth between them, [0, 180]; 0: the same side
};

/// Spectral BRDF and albedo of a layered surface. The coating's mirror reflection is part of the
/// albedo but not of the BRDF.
///
///     f_r(i,o) = T0(i) T0(o) (n0/n_in)^2 sum_l f_l(i',o') prod_{k<l} tau_k(i') tau_k(o')
///     f_l      = D G1 G1 R(theta_d) / (4 cos i' cos o'),   of the base: albedo / pi
///
/// with the refracted directions i', o'. tau multiplies radiance, so it is f_t cos in FPB24's
/// notation: their eq. 34 lacks the cosine. The sum over all paths has a closed form for a single
/// layer without a coating, and for a coating directly on a base: the base, which is lit by its own
/// light, gains the factor 1/(1 - albedo rbar).
/// Source: FPB24 sections 4.1 to 4.3.
///
/// Thread-safe; intermediate results are cached.
class LayeredScattering {
public:
    /// Throws DomainError as LayerTransport and index_at do.
    LayeredScattering(LayeredSurface surface, Crossings crossings, const Execution& execution);

    const LayeredSurface& surface() const { return surface_; }
    const Coating& coating() const { return coating_; }
    Crossings crossings() const { return crossings_; }
    const LayerTransport& layer(std::size_t l) const { return *layers_[l]; }
    std::size_t layers() const { return layers_.size(); }
    /// Whether the sum over all paths has a closed form.
    bool is_closed() const;

    /// Per steradian, [pair][wavelength]. Throws DomainError as IndexTable does, and for Paths::all
    /// unless is_closed().
    std::vector<double> brdf(std::span<const ScatterPair> pairs,
                             const std::vector<double>& wavelength_nm, Paths paths) const;

    /// Contribution of the base to the BRDF.
    ///   pairs          of directions
    ///   wavelength_nm  in vacuum
    ///   paths          single reflection, or all
    ///   times          factor on the result
    std::vector<double> base_brdf(std::span<const ScatterPair> pairs,
                                  const std::vector<double>& wavelength_nm, Paths paths,
                                  double times = 1) const;

    /// Transmission of the layers above layer l on the way in and out, [wavelength].
    ///   l                         number of layers above
    ///   theta_i_deg, theta_o_deg  angles inside, degrees
    ///   wavelength_nm             in vacuum
    std::vector<double> through(std::size_t l, double theta_i_deg, double theta_o_deg,
                                const std::vector<double>& wavelength_nm) const;

    /// Whether there is a non-black base that light can reach.
    bool has_base() const;

    /// Directional-hemispherical albedo, [angle][wavelength]. Throws as brdf() does.
    std::vector<double> albedo(std::span<const double> theta_i_deg,
                               const std::vector<double>& wavelength_nm, Paths paths) const;

    /// f_t cos of one layer at angles inside, [angle][wavelength].
    std::vector<double> straight(std::size_t layer, std::span<const double> theta_deg,
                                 const std::vector<double>& wavelength_nm) const;

    /// Albedo of the base, for all paths over 1 - albedo rbar, [wavelength]. Throws DomainError for
    /// Paths::all unless is_closed().
    std::vector<double> base_factors(const std::vector<double>& wavelength_nm, Paths paths) const;

    /// Albedo of the base, 0 if there is none.
    double base_albedo(double wavelength_nm) const;

    /// Probability of continuing through a layer when sampling it: 2 f_t cos / (1 + G1), the
    /// fraction of light neither masked on entering nor reflected. Source: FPB24 eq. 31.
    double passing(std::size_t layer, double theta_deg, double straight) const;

    /// Sampling probabilities of reflection by the coating, each layer and the base, which receives
    /// the remainder: [angle outside][wavelength][2 + layers]. Source: FPB24 eq. 35.
    std::vector<double> sampling(std::span<const double> theta_i_deg,
                                 const std::vector<double>& wavelength_nm) const;

    /// Sampling probabilities for one sample shared by all wavelengths, from f_t cos averaged over
    /// them: [angle outside][2 + layers].
    std::vector<double> multiplexed_sampling(std::span<const double> theta_i_deg,
                                             const std::vector<double>& wavelength_nm) const;

private:
    struct Straight;
    struct Moments;
    std::size_t crossed_layers() const;
    Straight straight_directly(std::span<const double> theta_deg, std::size_t count,
                               const std::vector<double>& wavelength_nm) const;
    Straight straight_through(std::span<const double> theta_deg, std::size_t count,
                              const std::vector<double>& wavelength_nm) const;
    double masking(std::size_t count, double theta_deg) const;
    AngleSeries exits(std::size_t count, const std::vector<double>& wavelength_nm,
                      double tolerance) const;
    std::vector<double> base_exit(const std::vector<double>& wavelength_nm) const;
    void add_first_layer_albedo(std::span<const double> theta_deg,
                                const std::vector<double>& wavelength_nm,
                                std::span<double> out) const;
    void add_lower_layer_albedo(std::size_t layer, std::span<const double> theta_deg,
                                const std::vector<double>& wavelength_nm,
                                std::span<double> out) const;
    void require_closed(Paths paths) const;
    std::shared_ptr<Moments> first_moments(double theta_deg) const;

    LayeredSurface surface_;
    Coating coating_;
    Execution execution_;
    Crossings crossings_;
    std::vector<std::unique_ptr<const LayerTransport>> layers_;
    mutable std::mutex making_, lock_;
    mutable Lazy<BaseLight> base_light_;
    mutable std::map<double, std::shared_ptr<Moments>> first_moments_;  ///< by theta_i inside
};

}  // namespace irido
