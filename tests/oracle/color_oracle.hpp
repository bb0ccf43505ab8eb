#pragma once

#include <functional>
#include <vector>

#include "core/colorimetry/observer.hpp"
#include "core/colorimetry/space.hpp"
#include "core/material/material.hpp"
#include "core/stack/stack.hpp"

namespace irido::oracle {

/// X, Y, Z of a spectrum for an observer and an illuminant, both linear between their rows and zero
/// outside them, with Y = 1 for a spectrum of 1. Between consecutive rows or breaks, on pieces no
/// longer than `longest_nm`, uses Gauss-Legendre of order 6, halving until the change is below the
/// piece's share of `tolerance` by width.
///   spectrum    as a function of the wavelength in nm
///   observer    the observer
///   illuminant  the illuminant
///   breaks      wavelengths where the spectrum has a kink or needs a closer look
///   tolerance   of X, Y, Z
///   longest_nm  longest piece
Triple integrate(const std::function<double(double wavelength_nm)>& spectrum,
                 const Observer& observer, const Table& illuminant,
                 const std::vector<double>& breaks, double tolerance, double longest_nm = 1);

/// Colour of unpolarized light reflected (or transmitted) by a coherent stack, with its materials
/// clamped to their end values, and breaks at their kinks and at `more_breaks`.
///   stack        the stack
///   observer     the observer
///   illuminant   the illuminant
///   angle_deg    angle of incidence, degrees
///   transmitted  the transmitted instead of the reflected light
///   tolerance    of X, Y, Z
///   more_breaks  further wavelengths for breaks, nm
///   longest_nm   longest piece
Triple stack_xyz(const Stack& stack, const Observer& observer, const Table& illuminant,
                 double angle_deg, bool transmitted, double tolerance,
                 const std::vector<double>& more_breaks = {}, double longest_nm = 1);

}  // namespace irido::oracle
