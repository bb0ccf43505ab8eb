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

/// Its single scratches and those of its fields whose axis comes nearer than `radius_um` to a
/// point; see scratches_near() of a field, whose ranges these are.
std::vector<Scratch> scratches_near(const ScratchedSurface& surface, SurfacePoint at,
                                    double radius_um);

/// Share of the area that a field's scratches cover on average, each counted.
double expected_density(const ScratchField& field);

}  // namespace irido
