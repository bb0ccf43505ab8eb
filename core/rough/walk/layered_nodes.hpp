#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/color/color_tables.hpp"
#include "core/rough/walk/tabulated_scattering.hpp"

namespace irido {

/// A layered surface for shaders. What the top layer reflects is a colour. What lies below is seen
/// through spectra, which colours cannot stand for: these are known at a few wavelengths, the
/// nodes, and every node has its part in the colour of what is below,
///     int s(lambda) f(lambda) prod_{k<=l} tau_k(i) tau_k(o) dlambda
///         ~ sum_j F_j prod_{k<=l} tau_k(i, lambda_j) tau_k(o, lambda_j),
/// with F_j = int s f e_j dlambda and spectra e_j that reproduce such products from their values
/// at the nodes. f is R of the next layer, however narrow its bands, or the base's albedo.
/// Source: pivoted QR for the nodes, as of discrete empirical interpolation, S. Chaturantabut and
/// D. C. Sorensen, SIAM J. Sci. Comput. 32, 2737 (2010); here e_j are fitted by least squares.
struct LayeredNodes {
    std::vector<double> wavelength_nm;  ///< of the nodes; none where nothing is seen through layers
    std::size_t angles = 0;             ///< equally spaced from 0 to 90 degrees
    std::vector<Triple> top;            ///< XYZ of R of the top layer, [theta_d]
    /// Of each layer that light crosses: f_t cos / G1, [angle inside][node].
    std::vector<std::vector<double>> straight;
    /// Of each layer that light crosses: F of what is directly below, [theta_d][node].
    std::vector<std::vector<Triple>> below;

    /// XYZ of the BRDF per steradian, by linear interpolation in all tables, as a shader has it.
    Triple operator()(const LayeredScattering& scattering, const ScatterPair& pair) const;
};

/// CIEDE2000 of pi times two BRDFs (XYZ), where one is brighter than white both brought down alike.
double scatter_difference(const Triple& a, const Triple& b, const Triple& white);

/// Reproducible pairs of directions up to 85 degrees, every second one near the mirror's.
std::vector<ScatterPair> sample_pairs(std::size_t count, std::uint64_t seed);

struct NodeRequest {
    std::optional<std::size_t> nodes;   ///< a multiple of 3 up to kMostNodes, else by the tolerance
    std::optional<std::size_t> angles;  ///< from 2, else by the tolerance
    double tolerance = 1;               ///< CIEDE2000 of sample_pairs()
    std::function<double(double)> stored = [](double value) { return value; };  ///< as read back
};
inline constexpr std::size_t kMostNodes = 60;

struct FoundNodes {
    LayeredNodes table;
    double error = 0;     ///< largest CIEDE2000 at random pairs, of the table as stored
    double products = 0;  ///< the same where colours are multiplied in the place of spectra
};

/// The fewest nodes, and angles, that meet the tolerance; where none do, those with the smallest
/// error. `exact` is by a rule of the tables' sensitivity. Throws as color_algorithm() does.
FoundNodes find_nodes(const LayeredScattering& scattering, const TabulatedScattering& exact,
                      const ColorTables& tables, const NodeRequest& request,
                      const Execution& execution);

}  // namespace irido
