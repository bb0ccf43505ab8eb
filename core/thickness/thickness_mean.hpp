#pragma once

#include <functional>
#include <span>

#include "core/complex.hpp"

namespace irido {

/// Gaussian distribution of one layer's thickness, truncated at zero.
struct ThicknessSpread {
    double mean_nm;          ///< [0, 1e9]
    double sigma_nm;         ///< standard deviation before truncation, (0, 1e9]
    Complex turn_per_nm;     ///< 2 k0 sqrt(q2): phase per nm of thickness that a round trip adds
    bool has_phase = false;  ///< whether the function takes a phase
};

/// Evaluates the quantities at a thickness, with `phase` radians added to each round trip through
/// the layer (0 unless has_phase). Returns a pole-free function whose zeros are the poles of the
/// values: if its argument changes by half a turn between two thicknesses, a narrow line lies
/// between them.
using ThicknessFunction =
    std::function<Complex(double thickness_nm, double phase, std::span<double> values)>;

/// Largest error of a mean of values between 0 and 1. A stack's own rounding adds to it, about
/// 1e-15 times the finesse of its sharpest resonance.
inline constexpr double kThicknessMeanError = 1e-12;

/// Mean of values that depend on a layer's thickness d only through its waves, that is through
/// exp(i turn d), and in absorbers through d.
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
