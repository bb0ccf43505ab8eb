#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "core/colorimetry/space.hpp"
#include "core/math/simd_level.hpp"
#include "core/spectrum/spectrum.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// Tolerance of X, Y, Z for a white of Y = 1.
inline constexpr double kDefaultTolerance = 1e-6, kSmallestTolerance = 1e-12;

enum class Side { reflected, transmitted };

/// Polarization of the incident light.
enum class Light { s, p, unpolarized };

/// Options of a colour computation, apart from the stack and its angles.
struct ColorRequest {
    std::vector<Side> sides{Side::reflected};
    Light light = Light::unpolarized;
    /// Largest error of X, Y, Z, [kSmallestTolerance, 1].
    double tolerance = kDefaultTolerance;
    std::size_t evaluations = 1U << 20;  ///< limit per colour; past it the best value is returned
    std::size_t colors = 1;  ///< approximate number of colours to come: decides what to precompute
    std::size_t structures = 1;  ///< stacks of other materials or structure that share these
    /// Layers of the stack whose thickness will vary, if no others do: the rest of the stack is
    /// then computed once for all colours, which changes them within rounding.
    std::vector<LayerPlace> varied{};
    /// Needs::spread_error and spread_reach, which quadrature does not add to the errors.
    double spread_error = 0, spread_reach = 0;
    /// Numbers that may be cached for the rest of the stack: trades memory for speed, not accuracy.
    std::size_t kept_numbers = 1U << 23;
    SimdLevel simd = best_simd_level();
};

/// Outputs requested from a kernel; at normal incidence s stands for p.
inline Needs needs_of(const ColorRequest& request) {
    const auto wants = [&](Side side) {
        return std::ranges::find(request.sides, side) != request.sides.end();
    };
    return {.s = request.light != Light::p,
            .p = request.light != Light::s,
            .p_at_normal = false,
            .R = wants(Side::reflected),
            .T = wants(Side::transmitted),
            .A = false,
            .spread_error = request.spread_error,
            .spread_reach = request.spread_reach};
}

struct StackColor {
    Triple xyz{};
    /// Bound or reliable estimate of the largest error of X, Y, Z; infinite if the method has none.
    double error = std::numeric_limits<double>::infinity();
    std::size_t evaluations = 0;  ///< wavelengths at which the stack was computed
    std::string_view method;      ///< name of the method that computed it
};

/// One method prepared for stacks of the same materials and structure, whose thicknesses (only
/// those of ColorRequest::varied, if any) may differ. Thread-safe.
class ColorAlgorithm {
public:
    virtual ~ColorAlgorithm() = default;

    /// Colours [angle][side] of one such stack; angles in [0, 90] degrees. A colour depends on its
    /// stack and angle only, not on what was computed before.
    virtual void operator()(const Stack& stack, std::span<const double> angles_deg,
                            std::span<StackColor> colors) const = 0;
};

}  // namespace irido
