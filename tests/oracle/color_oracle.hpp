#pragma once

#include <functional>
#include <vector>

#include "core/colorimetry/observer.hpp"
#include "core/colorimetry/space.hpp"
#include "core/material/material.hpp"
#include "core/stack/stack.hpp"

namespace irido::oracle {

/// X, Y, Z of a spectrum under an observer and an illuminant, both linear between their rows and
/// zero outside them, Y = 1 for a spectrum of 1. Between every two rows or breaks, on pieces no
/// longer than `longest_nm`, Gauss-Legendre of order 6, halved until it changes by less than
/// `tolerance` shared out by width.
///   breaks  wavelengths where the spectrum has a kink or needs a closer look
Triple integrate(const std::function<double(double wavelength_nm)>& spectrum,
                 const Observer& observer, const Table& illuminant,
                 const std::vector<double>& breaks, double tolerance, double longest_nm = 1);

/// Colour of unpolarized light that a coherent stack reflects (or transmits), its materials holding
/// their end values, with breaks at their kinks and at `more_breaks`.
Triple stack_xyz(const Stack& stack, const Observer& observer, const Table& illuminant,
                 double angle_deg, bool transmitted, double tolerance,
                 const std::vector<double>& more_breaks = {}, double longest_nm = 1);

}  // namespace irido::oracle
