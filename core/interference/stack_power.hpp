#pragma once

#include <span>
#include <vector>

#include "core/interference/coherent.hpp"

namespace irido {

/// Power of any stack: coherent layers, incoherent layers between them, spread thicknesses.
///
/// Across an incoherent layer powers add instead of amplitudes: the layers between two incoherent
/// ones form a coherent block with its reflectances and transmittances from both sides, and the
/// bounces between blocks are summed as a geometric series.
/// Source: S. J. Byrnes, arXiv:1603.02720 (2016), section 4.
///
/// A layer with thickness_sigma_nm has its power averaged over a Gaussian of thicknesses, cut at
/// zero, to 1e-10, or as far as 4096 panels go where a resonance is narrower than 1e-5 of the
/// spread; in a repeated group all repetitions share the deviation, different layers are
/// independent.
class StackPower {
public:
    /// Throws DomainError if more than kLargestSpreadLayers layers have a thickness_sigma_nm, or if
    /// groups with incoherent layers stand for more than kLargestIncoherentStack layers.
    explicit StackPower(const Stack& stack);

    static constexpr std::size_t kLargestSpreadLayers = 3;
    static constexpr std::size_t kLargestIncoherentStack = 10000;

    /// R, T, A at one wavelength and angle. `media` has one entry per material of the stack and, as
    /// its last, the incident medium without absorption; k0 = 2 pi / wavelength in 1/nm.
    /// The denominator is the product of those of all coherent blocks at the mean thicknesses.
    Response operator()(std::span<const Medium> media, double k0, Polarization polarization) const;

private:
    /// Coherent layers in both directions of travel.
    struct Block {
        std::vector<Element> down, up;
    };
    /// Blocks with an incoherent layer between each and the next.
    struct Chain {
        std::vector<Block> blocks;
        std::vector<Layer> gaps;
    };

    static Chain chain_of(const std::vector<Element>& elements);
    Response of_chain(const Chain& chain, std::span<const Medium> media, double k0,
                      Polarization polarization) const;
    Response averaged(std::vector<Element>& elements, std::size_t spread,
                      std::span<const Medium> media, double k0, Polarization polarization) const;

    std::size_t substrate_;
    std::vector<Element> elements_;
    Chain chain_;
    std::size_t spread_layers_ = 0;
};

}  // namespace irido
