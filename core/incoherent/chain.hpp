#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/coherent/slab_response.hpp"
#include "core/incoherent/incoherent.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// Coherent layers, in either direction of travel (`up` is empty if no layer is incoherent).
struct Block {
    std::vector<Element> down, up;
};

/// Coherent blocks separated by incoherent layers (gaps).
struct Chain {
    std::vector<Block> blocks;
    std::vector<Layer> gaps;
    std::size_t substrate = 0;  ///< index of its material
};

/// Splits `elements`, whose incoherent layers are all outside groups.
Chain chain_of(const std::vector<Element>& elements, std::size_t substrate);

/// Number of layers with groups expanded, capped at the largest std::size_t.
std::size_t count_layers(std::span<const Element> elements);

/// Number of layers with groups expanded and each sliced layer counted once.
std::size_t count_listed_layers(std::span<const Element> elements);

/// All layers in order, with groups expanded.
std::vector<Layer> written_out(std::span<const Element> elements);

/// For each of these layers, its position among the layers that count_listed_layers() counts.
std::vector<std::size_t> listed_layers(std::span<const Element> elements);

/// The chain that remains at this wavelength and angle: incoherent layers of zero thickness, and
/// those in which light does not travel (see travels()), become coherent layers of a block. Nothing
/// if there are none.
std::optional<Chain> joined(const Chain& chain, std::span<const Medium> media);

/// A chain, joined(), at one wavelength, angle and polarization.
class ChainLight {
public:
    /// Refers to the chain and the media. Later changes of a thickness take effect only if joined()
    /// had nothing to join.
    ///   chain         blocks and incoherent layers
    ///   media         one per material, followed by the incident medium
    ///   k0            2 pi / wavelength, 1/nm, > 0
    ///   polarization  s or p, the one that `media` were computed for
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

    /// Forward wave above a block, and below it.
    Wave above(std::size_t block) const;
    Wave below(std::size_t block) const;
    Attenuation gap(std::size_t gap) const;

    /// Response of one block to light from above, and to light from the gap below it.
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
