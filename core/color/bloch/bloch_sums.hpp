#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/colorimetry/smooth_sensitivity.hpp"
#include "core/math/simd_level.hpp"
#include "core/periodic/bloch.hpp"

namespace irido {

/// Points x = cos(pi j / n), j = 0 .. n, with the weights of two rules for integrals over [-1, 1];
/// padded with zeros to full vectors.
struct CosineNodes {
    explicit CosineNodes(std::size_t n);

    std::size_t n = 0;
    std::vector<double> x;
    std::vector<double>
        trapezoid;               ///< pi/n sin(pi j / n): for sqrt(1 - x^2) times smooth functions
    std::vector<double> curtis;  ///< Clenshaw-Curtis: for smooth functions
};

/// A spectral range inside a single band or gap.
struct BlochRange {
    double low = 0, high = 0;  ///< omega, 1/nm
    bool is_gap = false;
    bool is_odd = false;  ///< of a gap: cos KL < -1 there
};

/// Scratch memory.
struct BlochMemory {
    std::vector<double> place;   ///< of each node in the table
    std::vector<double> weight;  ///< [4][node], of the table's rows
};

/// Integral over nu of T times the smoothed colour-matching functions over one range, on the cosine
/// points between its ends. At the ends the terms of the series vanish like sin KL, as a square
/// root, while T as a whole is smooth: each case has its own rule.
///   mirror       the periods at one angle and polarization
///   range        a band or a gap
///   terms        in a band 2^k >= 1: the average and the harmonics m < terms of bloch_series();
///                0: T
///   nodes        points and weights
///   sensitivity  smoothed colour-matching functions
///   memory       scratch
///   level        instruction set; SimdLevel::plain sums bloch_transmittance(), bloch_series() and
///                SmoothSensitivity::at() point by point
Triple bloch_sum(const BlochMirror& mirror, const BlochRange& range, std::uint64_t terms,
                 const CosineNodes& nodes, const SmoothSensitivity& sensitivity,
                 BlochMemory& memory, SimdLevel level);

}  // namespace irido
