#pragma once

#include <functional>
#include <span>

#include "core/complex.hpp"

namespace irido {

/// Gaussian spread of one layer's thickness, cut at zero.
struct ThicknessSpread {
    double mean_nm;       ///< [0, 1e9]
    double sigma_nm;      ///< standard deviation before the cut, (0, 1e9]
    Complex turn_per_nm;  ///< 2 k0 sqrt(q2): what a round trip through 1 nm adds to a wave's phase
    bool has_phase = false;  ///< whether the function takes a phase
};

/// Values at a thickness, where a round trip through the layer has `phase` radians more than that
/// (0 unless has_phase). Returns a number without poles whose zeros are the poles of the values:
/// where it turns by half a turn between two thicknesses, a narrow line hides between them.
using ThicknessFunction =
    std::function<Complex(double thickness_nm, double phase, std::span<double> values)>;

/// Largest error of a mean of values between 0 and 1. A stack's own rounding adds to it, about
/// 1e-15 times the finesse of its sharpest resonance.
inline constexpr double kThicknessMeanError = 1e-12;

/// Mean of values that depend on a layer's thickness d by its waves only, that is on
/// exp(i turn d), and in absorbers on d.
///   A few fringes    equally spaced thicknesses, doubled until they agree; if they do not, or
///                    where a line hides, panels of 21 Gauss-Kronrod points halved around it.
///   No absorption    a mean over one fringe, with the Gaussian wrapped around it.
///   Many fringes     a spread of 9 radians forgets the phase to 1e-17, so the phase and the
///                    thickness are averaged one after the other. If the function takes no phase,
///                    the Gaussian is taken apart into Gaussians of 9 radians.
///   Cut at zero      the fringes beside the cut, which do remember it, are integrated directly.
/// Throws DomainError if the mean does not exist because the stack amplifies without bound at one
/// of the thicknesses, and if it takes more than 1e6 of them (thousands of lines in the spread).
void thickness_mean(const ThicknessSpread& spread, const ThicknessFunction& function,
                    std::span<double> mean);

}  // namespace irido
