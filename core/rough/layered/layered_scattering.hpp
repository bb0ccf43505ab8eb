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

/// Which light counts.
enum class Paths {
    single,  ///< reflected once, by a layer or the base: FPB24 eq. 34
    all,     ///< between layers, base and coating as often as it may be
};

/// Directions outside a surface that point away from it.
struct ScatterPair {
    double theta_i_deg = 0, theta_o_deg = 0;  ///< [0, 90]
    double phi_deg = 180;                     ///< azimuth between them, [0, 180]; 0: the same side
};

/// BRDF and albedo of a layered surface at wavelengths. The coating's mirror is in the albedo and
/// not in the BRDF.
///
///     f_r(i,o) = T0(i) T0(o) (n0/n_in)^2 sum_l f_l(i',o') prod_{k<l} tau_k(i') tau_k(o')
///     f_l      = D G1 G1 R(theta_d) / (4 cos i' cos o'),   of the base: albedo / pi
///
/// with the refracted directions i', o'. tau multiplies radiance, f_t cos in FPB24's terms: their
/// eq. 34 lacks the cosine. All paths have a closed form if there is one layer without a coating,
/// or a coating over a base alone: the base, which feeds itself, is multiplied by 1/(1 - albedo
/// rbar). Source: FPB24 sections 4.1 to 4.3.
///
/// Safe from many threads; what is computed once is kept.
class LayeredScattering {
public:
    /// Throws DomainError as LayerTransport and index_at do.
    LayeredScattering(LayeredSurface surface, Crossings crossings, const Execution& execution);

    const LayeredSurface& surface() const { return surface_; }
    const Coating& coating() const { return coating_; }
    Crossings crossings() const { return crossings_; }
    const LayerTransport& layer(std::size_t l) const { return *layers_[l]; }
    std::size_t layers() const { return layers_.size(); }
    /// Whether all paths have a closed form.
    bool is_closed() const;

    /// Per steradian, [pair][wavelength]. Throws DomainError as IndexTable does, and for Paths::all
    /// unless is_closed().
    std::vector<double> brdf(std::span<const ScatterPair> pairs,
                             const std::vector<double>& wavelength_nm, Paths paths) const;

    /// What the base does of it, times a number.
    std::vector<double> base_brdf(std::span<const ScatterPair> pairs,
                                  const std::vector<double>& wavelength_nm, Paths paths,
                                  double times = 1) const;

    /// What the layers above layer l let through of light on its way in and out, at angles inside,
    /// [wavelength].
    std::vector<double> through(std::size_t l, double theta_i_deg, double theta_o_deg,
                                const std::vector<double>& wavelength_nm) const;

    /// Whether there is a base that is not black, and it is seen.
    bool has_base() const;

    /// Directional-hemispherical, [angle][wavelength]. Throws as brdf() does.
    std::vector<double> albedo(std::span<const double> theta_i_deg,
                               const std::vector<double>& wavelength_nm, Paths paths) const;

    /// f_t cos of one layer at angles inside, [angle][wavelength].
    std::vector<double> straight(std::size_t layer, std::span<const double> theta_deg,
                                 const std::vector<double>& wavelength_nm) const;

    /// Albedo of the base, for all paths over 1 - albedo rbar, [wavelength]. Throws DomainError for
    /// Paths::all unless is_closed().
    std::vector<double> base_factors(const std::vector<double>& wavelength_nm, Paths paths) const;

    /// Of the base, 0 where there is none.
    double base_albedo(double wavelength_nm) const;

    /// Probability of going on through a layer when it is sampled: 2 f_t cos / (1 + G1), the share
    /// of the light that is neither masked on its way in nor reflected. Source: FPB24 eq. 31.
    double passing(std::size_t layer, double theta_deg, double straight) const;

    /// Probabilities of reflection at the coating, each layer and the base, which takes what is
    /// left: [angle outside][wavelength][2 + layers]. Source: FPB24 eq. 35.
    std::vector<double> sampling(std::span<const double> theta_i_deg,
                                 const std::vector<double>& wavelength_nm) const;

    /// The same for one sample of all wavelengths: [angle outside][2 + layers], with means of
    /// f_t cos over the wavelengths.
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
