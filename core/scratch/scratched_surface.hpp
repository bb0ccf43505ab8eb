#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/scratch/field.hpp"
#include "core/scratch/scratch.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// Scratches in a surface.
struct ScratchedSurface {
    std::optional<Stack> base;    ///< what is scratched; none: a perfect mirror, itself left out
    std::optional<double> alpha;  ///< of GGX, [1e-4, 1], where the base is rough; none: its mirror
                                  ///< direction is no part of a BRDF
    ScratchOptics optics;
    std::uint64_t seed = 1;  ///< of the fields
    std::vector<Scratch> scratches;
    std::vector<ScratchField> fields;
};

}  // namespace irido
