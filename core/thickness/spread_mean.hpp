#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/incoherent/chain.hpp"
#include "core/thickness/thickness_mean.hpp"
#include "core/thickness/thickness_sweep.hpp"

namespace irido {

/// Powers that are read; the others are unspecified.
struct NeededPowers {
    bool T = true, A = true;
};

/// A layer with a thickness distribution.
struct SpreadLayer {
    std::size_t material;
    double mean_nm, sigma_nm;
};

/// Layers and groups, some with a thickness distribution; the fixed ones are combined once.
class MovingElements {
public:
    MovingElements(std::span<const Element> elements, const ChainLight& light);

    Slab slab() const { return slab(0, pieces_.size()); }

    /// The stack as a function of one of its layers, which must not be in a group.
    ThicknessSweep sweep(const Wave& in, const Layer* layer, const Wave& out) const;

private:
    struct Piece {
        std::span<const Element> elements;
        bool moves;
        Slab slab;
    };

    Slab slab_of(std::span<const Element> elements) const;
    Slab slab(std::size_t begin, std::size_t end) const;

    const ChainLight& light_;
    std::vector<Piece> pieces_;
};

/// Means over the thickness distributions of several layers, nested, each by thickness_mean(). The
/// innermost is a layer outside groups, if there is one: the rest of the stack is then evaluated
/// once for all its thicknesses (ThicknessSweep), and averaged in closed form where mean_fringes()
/// can.
class SpreadMean {
public:
    /// Refers to its arguments.
    ///   chain         blocks and incoherent layers
    ///   spreads       the thickness distributions
    ///   spread_of     per layer of the chain with a thickness_sigma_nm, from the incident side:
    ///                 the entry of `spreads` whose deviation it shares
    ///   media         one per material, followed by the incident medium
    ///   k0            2 pi / wavelength, 1/nm
    ///   polarization  s or p, the one that `media` were computed for
    SpreadMean(const Chain& chain, std::span<const SpreadLayer> spreads,
               std::span<const std::size_t> spread_of, std::span<const Medium> media, double k0,
               Polarization polarization);

    Power power(const NeededPowers& needs);
    void layer_absorption(std::span<double> absorbed);

private:
    using Evaluate = std::function<Complex(std::span<double>)>;

    /// A layer with a thickness distribution: in a block, for either direction, or incoherent.
    struct Place {
        std::size_t spread;
        std::size_t block;
        Layer *down, *up;
        bool sweepable;  ///< in a block, but in no group
    };
    /// A block in one direction of travel.
    struct Direction {
        Response fixed;
        std::optional<MovingElements> moving;
    };
    /// The chain around one block.
    struct Surroundings {
        std::vector<BlockPower> above;
        std::vector<Attenuation> gaps;
        Power below;
        Power with(const BlockPower& block) const;
    };

    void find_places(std::span<const std::size_t> spread_of);
    Direction direction(const std::vector<Element>& elements, const Wave& in,
                        const Wave& out) const;
    Response response_of(const Direction& direction, const Wave& in, const Wave& out) const;
    BlockPower power_of(std::size_t block) const;
    Surroundings around(std::size_t block) const;
    Complex turn_per_nm(std::size_t spread) const;
    void choose_innermost();
    void set(std::size_t spread, double thickness_nm);
    Complex mean_from(std::size_t level, std::span<double> mean, const Evaluate& evaluate);
    Complex mean_of_sweep(const ThicknessSpread& thicknesses, const Place& place,
                          std::span<double> mean);
    std::optional<Power> series_mean(const ThicknessSweep& sweep,
                                     const ThicknessSpread& thicknesses) const;
    Complex power_now(std::span<double> power) const;
    bool waves_move() const;

    std::span<const SpreadLayer> spreads_;
    Chain chain_;
    ChainLight light_;
    std::vector<Place> places_;
    std::vector<std::size_t> order_;  ///< of the spreads, outermost first
    const Place* innermost_ = nullptr;
    NeededPowers needs_;
    std::vector<Direction> downs_, ups_;
};

}  // namespace irido
