#pragma once

#include <span>
#include <vector>

#include "core/coherent/hosted_mirror.hpp"
#include "core/incoherent/chain.hpp"
#include "core/thickness/spread_mean.hpp"

namespace irido {

/// Whether any layer is incoherent, those of groups included.
bool has_incoherent_layers(std::span<const Element> elements);

/// Power of any stack: coherent layers, incoherent layers between them, spread thicknesses.
///
/// Across an incoherent layer powers add instead of amplitudes: the layers between two incoherent
/// ones form a coherent block with its reflectances and transmittances from both sides, and the
/// bounces between blocks are summed as a geometric series. Of one incoherent layer that is the
/// mean over the phase of its round trips. R, T and A of layers that do not amplify are in [0, 1]:
/// where light does not travel in an incoherent layer it is coherent (see travels()), and absorbers
/// too thin to lose a phase have a wave of their own (see wave_in_gap()).
/// Source: S. J. Byrnes, arXiv:1603.02720 (2016), section 4.
///
/// A layer with thickness_sigma_nm has its power averaged over a Gaussian of thicknesses, cut at
/// zero, to 1e-12 (kThicknessMeanError); in a repeated group all repetitions share the deviation,
/// different layers are independent.
class StackPower {
public:
    /// Throws DomainError if more than kLargestSpreadLayers layers have a thickness_sigma_nm, or if
    /// groups with incoherent layers stand for more than kLargestIncoherentStack layers.
    explicit StackPower(const Stack& stack) { assign(stack); }
    /// Becomes the power of another stack; memory is used again. Throws as above.
    void assign(const Stack& stack);

    /// Layers with a thickness_sigma_nm; repetitions of a group count once.
    std::size_t spread_layers() const { return spreads_.size(); }
    static constexpr std::size_t kLargestSpreadLayers = 3;
    static constexpr std::size_t kLargestIncoherentStack = 10000;

    /// R, T, A at one wavelength and angle. `media` has one entry per material of the stack and, as
    /// its last, the incident medium without absorption; k0 = 2 pi / wavelength in 1/nm.
    /// Powers of a mirror in its host are mirror_power().
    /// The denominator is the product of those of all coherent blocks at the mean thicknesses.
    Response operator()(std::span<const Medium> media, double k0, Polarization polarization,
                        const NeededPowers& needs = {}) const;

    /// Whether Response has r and t: they do not survive where powers are added or averaged.
    bool has_amplitudes() const { return chain_.gaps.empty() && spreads_.empty(); }

    /// Its blocks, if no thickness is spread; else nullptr.
    const Chain* chain() const { return spreads_.empty() ? &chain_ : nullptr; }

    /// What the whole stack is, if no thickness is spread: its powers are mirror_power() then.
    const std::optional<HostedMirror>& mirror() const { return mirror_; }

    /// Layers with groups written out, from the incident side to the substrate.
    std::size_t layer_count() const { return layer_count_; }

    static constexpr std::size_t kLargestLayerList = 1000;

    /// Power absorbed in each of them, as part of the incident one; gain is negative. From the
    /// layers' own fluxes, so that it keeps its digits where it is small. Arguments as above;
    /// absorbed has layer_count() entries. In an incoherent layer between absorbing ones this
    /// includes what the interference of its waves at its faces takes. Throws DomainError if there
    /// are more than kLargestLayerList layers.
    void layer_absorption(std::span<const Medium> media, double k0, Polarization polarization,
                          std::span<double> absorbed) const;

private:
    std::size_t layer_count_ = 0;
    Chain chain_;
    std::optional<HostedMirror> mirror_;
    std::vector<SpreadLayer> spreads_;
    std::vector<std::size_t> spread_of_;  ///< of the chain's spread layers, as in SpreadMean
};

}  // namespace irido
