#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace irido {

/// R or T as a function of the phase of a layer's round trip, and the Gaussian of these phases. If
/// the layer neither absorbs nor amplifies, the Fourier coefficients of the function from the first
/// one on are a geometric series, and the first one is at most 1/pi, because values are in [0, 1].
struct SpreadPhase {
    double ratio;        ///< of the series, [0, 1)
    double least, most;  ///< standard deviation of the phase, radians: where it is not the same
                         ///< everywhere, its smallest and its largest value
    // of layers that absorb
    double loss = 0;   ///< standard deviation of the logarithm of a round trip's wave
    double wave = 1;   ///< largest modulus of a round trip's wave at the mean thickness
    double depth = 0;  ///< mean thickness in its standard deviations: nodes are not beyond
};

/// Fourier coefficients that the mean needs besides the first ones: k = 1 to this number, at least
/// 1. Nothing if these are more than kMostSeriesTerms.
///   error  largest error of the mean, > 0
std::optional<std::size_t> series_terms(const SpreadPhase& phase, double error);
inline constexpr std::size_t kMostSeriesTerms = 48;

/// Nodes that the mean needs.
struct SpreadRule {
    /// True: so many thicknesses of Gauss and Hermite's rule, see hermite_nodes(). False: as many
    /// phases, an odd number, equally spaced around the turn, of the weights of the Gaussian that
    /// is wrapped around it, up to its harmonic count/2.
    bool by_thickness;
    std::size_t count;
};
inline constexpr std::size_t kMostHermiteNodes = 24, kMostSpreadNodes = 2 * kMostSeriesTerms + 1;

/// The rule of the fewest nodes for a layer that does not absorb; nothing if it takes more than
/// kMostSpreadNodes.
///   error  largest error of the mean, > 0
std::optional<SpreadRule> spread_rule(const SpreadPhase& phase, double error);

/// The same for one that absorbs, whose rule is by_thickness. With r = sum r_j z^j of the wave z of
/// a round trip, where |r_j| is taken to be at most ratio^(j-1) from j = 1 on, R is the sum of
/// r_j conj(r_k) z^j conj(z)^k, each of which has an error of its own.
std::optional<SpreadRule> lossy_spread_rule(const SpreadPhase& phase, double error);

struct HermiteNode {
    double x;       ///< standard deviations from the mean, >= 0; unless 0, -x is a node as well
    double weight;  ///< of this node alone
};
/// Gauss and Hermite's rule for the mean over a standard normal deviation, exact for polynomials of
/// degree below 2 count.
///   count  [1, kMostHermiteNodes]
std::span<const HermiteNode> hermite_nodes(std::size_t count);

}  // namespace irido
