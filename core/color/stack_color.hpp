#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/color/color_request.hpp"
#include "core/color/integration.hpp"
#include "core/math/simd_level.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// A material that is not known over the whole visible range and holds its end values there.
struct HeldRange {
    std::size_t material = 0;  ///< index into Stack::materials
    WavelengthRange range;     ///< where it is known
    bool usable = true;        ///< false if it is not known over 400 to 700 nm, which colour needs
    Triple weight{};           ///< fraction of the X, Y, Z weight outside its range
};

/// Materials of the stack that are not known over the sensitivity's support and do not say clamp.
std::vector<HeldRange> held_ranges(const Stack& stack, const Sensitivity& sensitivity);

/// X, Y, Z of light reflected or transmitted by a stack, for every angle and side
/// ([angle][side]). Materials hold their end values outside their range.
///   angles_deg  [0, 90]
///   limits      stacks of many layers are given up earlier, after about 2e7 layers' worth of work
/// Throws DomainError if a held range is not usable, and as StackPower, IndexTable and
/// integrate_color do.
std::vector<ColorIntegral> stack_color(const Stack& stack, const Sensitivity& sensitivity,
                                       std::span<const double> angles_deg,
                                       std::span<const Side> sides, const IntegrationLimits& limits,
                                       const Execution& execution = {},
                                       Light light = Light::unpolarized);

}  // namespace irido
