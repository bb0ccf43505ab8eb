#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/coherent/fringe_mean.hpp"
#include "core/color/color_request.hpp"
#include "core/colorimetry/sensitivity.hpp"

namespace irido {

/// What fringes add to X, Y, Z whose spectra were replaced by fringe means.
struct FringeSum {
    Triple xyz{};
    double error = 0;  ///< estimated largest error of X, Y, Z
};

/// Forms at several wavelengths, for one polarization.
using FringeForms =
    std::function<void(std::span<const double> wavelength_nm, std::span<FringeForm> forms)>;

struct FringeLimits {
    double tolerance = 1e-6;
    std::size_t evaluations = 1U << 16;  ///< past it the error grows
};

/// Integrals of the weighted colour-matching functions times each wave of FringeHarmonics. A
/// spectrum's panels are halved until polynomials in the wavelength follow the amplitudes and
/// phases. From row to row of the sensitivity, where it is quadratic too, a wave a exp(i psi) is
/// integrated by Levin's method: p' + i psi' p = a is solved by a polynomial that does not turn
/// with psi, and p exp(i psi) at both ends is the integral. Where two elements turn against each
/// other psi' has zeros; there the panels are halved until the phase stands still. Waves too fast
/// to matter are left out, with the error 4 |a| / |psi'| of their ends. Those beyond kMost count as
/// errors, as much as the last ones have.
/// Source: D. Levin, Math. Comp. 38, 531 (1982); S. Chen, K. Serkh and J. Bremer, "The adaptive
/// Levin method" (2022).
///   sensitivity  weighted colour-matching functions
///   ends         of ranges over which the indices are smooth, ascending, that cover the support
///   elements     1 or 2, of the forms
///   sides        of the sums
///   forms        evaluates the stack
///   limits       tolerance and effort
std::vector<FringeSum> fringe_sums(const Sensitivity& sensitivity, std::span<const double> ends,
                                   std::size_t elements, std::span<const Side> sides,
                                   const FringeForms& forms, const FringeLimits& limits);

}  // namespace irido
