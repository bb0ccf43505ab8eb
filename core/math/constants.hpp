#pragma once

#include <limits>
#include <numbers>

namespace irido {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTwoPi = 2 * kPi;
inline constexpr double kDegree = kPi / 180;  // in radians
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Photon energy times vacuum wavelength, h c / e from the exact SI constants, eV nm.
inline constexpr double kPhotonEnergy_eVnm = 6.62607015e-34 * 299792458.0 / 1.602176634e-19 * 1e9;

}  // namespace irido
