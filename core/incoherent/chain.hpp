#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/coherent/slab_response.hpp"
#include "core/incoherent/incoherent.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// Coherent layers, in both directions of travel (`up` is empty without incoherent layers).
struct Block {
    std::vector<Element> down, up;
};

/// Blocks with an incoherent layer, a gap, between each and the next.
struct Chain {
    std::vector<Block> blocks;
    std::vector<Layer> gaps;
    std::size_t substrate = 0;  ///< index of its material
};

/// `elements` have their incoherent layers outside groups.
Chain chain_of(const std::vector<Element>& elements, std::size_t substrate);

/// Layers with groups written out; the largest number there is, if they are more.
std::size_t count_layers(std::span<const Element> elements);

/// The same, each layer that is written in parts being one.
std::size_t count_listed_layers(std::span<const Element> elements);

/// These layers in their order.
std::vector<Layer> written_out(std::span<const Element> elements);

/// Of each of these layers, its place among those that count_listed_layers() counts.
std::vector<std::size_t> listed_layers(std::span<const Element> elements);

/// The chain whose gaps part coherent blocks at this wavelength and angle: those in which light
/// does not travel (see travels()), and those of no thickness, are layers of a block. Nothing if
/// the chain has none of them.
std::optional<Chain> joined(const Chain& chain, std::span<const Medium> media);

/// A chain, joined(), in the light of one wavelength, angle and polarization; arguments as those of
/// StackPower. It refers to them, and sees thicknesses that change in a chain that is joined.
class ChainLight {
public:
    ChainLight(const Chain& chain, std::span<const Medium> media, double k0,
               Polarization polarization)
        : own_(joined(chain, media)),
          chain_(own_ ? *own_ : chain),
          media_(media),
          k0_(k0),
          polarization_(polarization) {}
    ChainLight(const ChainLight&) = delete;
    ChainLight& operator=(const ChainLight&) = delete;

    std::span<const Medium> media() const { return media_; }
    double k0() const { return k0_; }
    Polarization polarization() const { return polarization_; }
    std::size_t last_block() const { return chain_.gaps.size(); }

    /// The wave that goes down above a block, and below it.
    Wave above(std::size_t block) const;
    Wave below(std::size_t block) const;
    Attenuation gap(std::size_t gap) const;

    /// Of one block for light from above, and for light from the gap below it.
    Response down(std::size_t block) const;
    Response up(std::size_t block) const;

    Response response() const;

    /// As StackPower::layer_absorption().
    void layer_absorption(std::span<double> absorbed) const;

private:
    void add_block_layers(std::size_t block, double from_above, double from_below,
                          std::span<double> absorbed) const;

    Wave in_gap(std::size_t gap) const;

    std::optional<Chain> own_;
    const Chain& chain_;
    std::span<const Medium> media_;
    double k0_;
    Polarization polarization_;
};

}  // namespace irido
