#pragma once

#include <vector>

#include "core/vector/kernel.hpp"

namespace irido {

/// Coherent layers some of which have a thickness distribution, for means over these.
struct SpreadProgram {
    Program program;               ///< at the mean thicknesses
    std::vector<double> sigma_nm;  ///< per entry of its order; 0 without a distribution
};

/// Layers with a distribution that means may have.
inline constexpr std::size_t kMostMeanSpreads = 3;

/// Compiles coherent elements, reusing memory. Returns false if compile() of program.hpp fails, if
/// no layer has a distribution or more than kMostMeanSpreads, or one that is in a repeated group of
/// several layers or is cut at zero. None may amplify.
///   elements   from the incident side
///   substrate  index of its material
///   absorbs    per material: whether its index has an imaginary part anywhere
///   reach      standard deviations below the mean at which a distribution may be cut
///   program    result
bool compile(std::span<const Element> elements, std::size_t substrate,
             const std::vector<bool>& absorbs, double reach, SpreadProgram& program);

/// Means of R and T over the thicknesses of all spread layers, which vary independently. The fields
/// at the top are taken apart into the waves of one and of no round trip through each of them; R, T
/// are functions of their phases. The mean over that of the largest spread of a layer that does not
/// absorb is a sum over Fourier coefficients, a geometric series, times those of the Gaussian; that
/// over another is by spread_rule() or lossy_spread_rule(). Denominators: at the mean thicknesses.
///   program  compiled layers
///   error    largest error of R and T, which the spread layers share
///   run      points
///   s, p     outputs, nullptr for a polarization that is not needed; without amplitudes and A
///   redo     receives the points at which it is not known to the error: waves of a spread layer
///            are evanescent, or its resonances are sharp
///   memory   scratch
///   level    instruction set
void run_spread(const SpreadProgram& program, double error, const PointRun& run, const RunOutput* s,
                const RunOutput* p, std::vector<std::size_t>& redo, RunMemory& memory,
                SimdLevel level);

}  // namespace irido
