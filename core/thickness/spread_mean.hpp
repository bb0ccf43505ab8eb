#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/incoherent/chain.hpp"
#include "core/thickness/thickness_mean.hpp"
#include "core/thickness/thickness_sweep.hpp"

namespace irido {

/// Which powers are read; others may come out as anything.
struct NeededPowers {
    bool T = true, A = true;
};

/// A layer with a spread of thickness.
struct SpreadLayer {
    std::size_t material;
    double mean_nm, sigma_nm;
};

/// Layers and groups of which some have a spread: what does not change is worked out once.
class MovingElements {
public:
    MovingElements(std::span<const Element> elements, const ChainLight& light);

    Slab slab() const { return slab(0, pieces_.size()); }

    /// The stack as a function of one of its layers, which stands in no group.
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

/// Means over the thicknesses of all spread layers, one inside the other, each as thickness_mean()
/// does it. The innermost one is a layer outside groups, if there is one: the rest of the stack is
/// then worked out once for all its thicknesses (ThicknessSweep), and averaged in closed form where
/// mean_fringes() can.
class SpreadMean {
public:
    /// spread_of  for every layer of the chain with a thickness_sigma_nm, from the incident side,
    ///            which of `spreads` it shares its deviation with
    SpreadMean(const Chain& chain, std::span<const SpreadLayer> spreads,
               std::span<const std::size_t> spread_of, std::span<const Medium> media, double k0,
               Polarization polarization);

    Power power(const NeededPowers& needs);
    void layer_absorption(std::span<double> absorbed);

private:
    using Evaluate = std::function<Complex(std::span<double>)>;

    /// A spread layer in the chain: in a block, seen in both directions, or as a gap.
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
