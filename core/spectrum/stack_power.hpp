#pragma once

#include <span>
#include <vector>

#include "core/coherent/hosted_mirror.hpp"
#include "core/incoherent/chain.hpp"
#include "core/thickness/spread_mean.hpp"

namespace irido {

/// Whether any layer, including those in groups, is incoherent.
bool has_incoherent_layers(std::span<const Element> elements);

/// Power of any stack: coherent layers, incoherent layers between them, thickness distributions.
///
/// Across an incoherent layer powers add instead of amplitudes: the layers between two incoherent
/// ones form a coherent block with reflectances and transmittances for both sides, and the round
/// trips between blocks are summed as a geometric series. For a single incoherent layer that is the
/// mean over the phase of its round trips. R, T and A of stacks without gain are in [0, 1]: an
/// incoherent layer in which light does not travel is treated as coherent (see travels()), and
/// absorbers too thin to lose a phase get a modified wave (see wave_in_gap()).
/// Source: S. J. Byrnes, arXiv:1603.02720 (2016), section 4.
///
/// The power of a layer with thickness_sigma_nm is averaged over a Gaussian of thicknesses
/// truncated at zero, to 1e-12 (kThicknessMeanError). All repetitions of a group share the
/// deviation; different layers are independent.
class StackPower {
public:
    /// Throws DomainError if more than kLargestSpreadLayers layers have a thickness_sigma_nm, or if
    /// groups with incoherent layers expand to more than kLargestIncoherentStack layers.
    explicit StackPower(const Stack& stack) { assign(stack); }
    /// Switches to another stack, reusing memory. Throws as the constructor does.
    void assign(const Stack& stack);

    /// Layers with a thickness_sigma_nm; repetitions of a group count once.
    std::size_t spread_layers() const { return spreads_.size(); }
    static constexpr std::size_t kLargestSpreadLayers = 3;
    static constexpr std::size_t kLargestIncoherentStack = 10000;

    /// R, T, A at one wavelength and angle; those of an embedded mirror are mirror_power(). The
    /// denominator is the product of those of all coherent blocks at the mean thicknesses.
    ///   media         one per material, followed by the incident medium without absorption
    ///   k0            2 pi / wavelength, 1/nm
    ///   polarization  s or p, the one that `media` were computed for
    ///   needs         powers requested
    Response operator()(std::span<const Medium> media, double k0, Polarization polarization,
                        const NeededPowers& needs = {}) const;

    /// Whether Response has r and t, which do not exist where powers are added or averaged.
    bool has_amplitudes() const { return chain_.gaps.empty() && spreads_.empty(); }

    /// The coherent blocks if there is no thickness distribution, else nullptr.
    const Chain* chain() const { return spreads_.empty() ? &chain_ : nullptr; }

    /// The coherent block if there is only one and it has thickness distributions, else nullptr.
    const Block* spread_block() const {
        return spreads_.empty() || !chain_.gaps.empty() ? nullptr : chain_.blocks.data();
    }
    std::size_t substrate() const { return chain_.substrate; }  ///< index of its material

    /// The embedded mirror that the whole stack is, if so and without thickness distribution: its
    /// powers are mirror_power().
    const std::optional<HostedMirror>& mirror() const { return mirror_; }

    /// Number of layers with groups expanded, from the incident side to the substrate; sliced
    /// layers count as one.
    std::size_t layer_count() const { return layer_count_; }

    /// For each layer with groups and slices written out, the layer of layer_count() that it is
    /// part of; empty if that is itself, or if there are more than kLargestLayerList layers.
    std::span<const std::size_t> listed() const { return listed_; }

    static constexpr std::size_t kLargestLayerList = 1000;

    /// Throws DomainError if there are more than kLargestLayerList layers.
    void require_layer_list() const;

    /// Power absorbed in each of these layers, as a fraction of the incident power; gain is
    /// negative. Computed from the layers' own fluxes, so small values are accurate. In an
    /// incoherent layer between absorbing ones it includes the interference flux of its waves at
    /// its faces. Throws as require_layer_list() does.
    ///   media         one per material, followed by the incident medium without absorption
    ///   k0            2 pi / wavelength, 1/nm
    ///   polarization  s or p, the one that `media` were computed for
    ///   absorbed      output, layer_count() entries
    void layer_absorption(std::span<const Medium> media, double k0, Polarization polarization,
                          std::span<double> absorbed) const;

private:
    std::size_t layer_count_ = 0;
    std::vector<std::size_t> listed_;  ///< per layer written out, if some are parts: whose part
    Chain chain_;
    std::optional<HostedMirror> mirror_;
    std::vector<SpreadLayer> spreads_;
    std::vector<std::size_t> spread_of_;  ///< of the chain's spread layers, as in SpreadMean
};

}  // namespace irido
