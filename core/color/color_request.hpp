#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/colorimetry/space.hpp"
#include "core/math/simd_level.hpp"
#include "core/spectrum/spectrum.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// Of X, Y, Z where the white has Y = 1.
inline constexpr double kDefaultTolerance = 1e-6, kSmallestTolerance = 1e-12;

enum class Side { reflected, transmitted };

/// The light that falls on the stack.
enum class Light { s, p, unpolarized };

/// A way to compute the colour of a stack. Those after `bloch` are there to be compared with.
struct ColorMethod {
    enum class Kind {
        automatic,         ///< the cheapest of the exact ones for the tolerance asked
        quadrature,        ///< product quadrature; any stack
        fourier,           ///< BB17's series with exact transforms; one real film over any base
        bloch,             ///< Bloch waves between band edges; periods of two transparent layers
        fourier_constant,  ///< the same with BB17's constant indices where media have dispersion
        naive,             ///< three wavelengths taken for R, G and B
        equal,             ///< equally spaced wavelengths
        gaussian,          ///< BB17's series with their Gaussian fits of the observer
        gltf,              ///< the same with Schlick's Fresnel terms, as glTF has it
        smits,             ///< a single bounce
        landmarks,         ///< FPB24's boxes between the landmarks of a mirror
    };
    Kind kind = Kind::automatic;
    /// equal: wavelengths, [2, 1e6]. fourier: the last order of the series, 0: as many as the
    /// tolerance needs. bloch: the last harmonic + 1, 0: as many as the tolerance needs. landmarks:
    /// their parameter s of subdivision, [1, 1000].
    std::size_t count = 0;
};

/// What is asked of a stack besides its angles.
struct ColorRequest {
    std::vector<Side> sides{Side::reflected};
    Light light = Light::unpolarized;
    /// Largest error of X, Y, Z, [kSmallestTolerance, 1].
    double tolerance = kDefaultTolerance;
    std::size_t evaluations = 1U << 20;  ///< a colour; past it the best value is returned
    std::size_t colors = 1;  ///< about as many will be asked for: it decides what to prepare
    /// Layers of the stack, if these are the only ones whose thickness will differ: what the others
    /// do is then computed once for all colours, which differ in roundings from those without.
    std::vector<LayerPlace> varied{};
    /// Numbers that may be kept of these other layers: memory for speed, the colours are the same.
    std::size_t kept_numbers = 1U << 23;
    SimdLevel simd = best_simd_level();
};

/// What a kernel computes for it; at normal incidence s stands for p.
inline Needs needs_of(const ColorRequest& request) {
    const auto wants = [&](Side side) {
        return std::ranges::find(request.sides, side) != request.sides.end();
    };
    return {.s = request.light != Light::p,
            .p = request.light != Light::s,
            .p_at_normal = false,
            .R = wants(Side::reflected),
            .T = wants(Side::transmitted),
            .A = false};
}

struct StackColor {
    Triple xyz{};
    /// Bound or honest estimate of the largest error of X, Y, Z; infinite where a method has none.
    double error = std::numeric_limits<double>::infinity();
    std::size_t evaluations = 0;  ///< wavelengths at which the stack was computed
    ColorMethod::Kind method = ColorMethod::Kind::quadrature;
};

/// One method made ready for stacks of the same materials and structure that may differ in their
/// thicknesses, those of ColorRequest::varied if there are any. Safe from many threads.
class ColorAlgorithm {
public:
    virtual ~ColorAlgorithm() = default;

    /// Colours [angle][side] of one such stack; angles in [0, 90] degrees. A colour depends on its
    /// stack and angle only, not on what was computed before.
    virtual void operator()(const Stack& stack, std::span<const double> angles_deg,
                            std::span<StackColor> colors) const = 0;
};

}  // namespace irido
