#pragma once

#include <cstdint>
#include <vector>

#include "tables/lut/lut_maker.hpp"
#include "tables/shaders/scene/scene_plan.hpp"

namespace irido::tables {

/// All channels of a table at a point with one coordinate per axis of the level; interpolated
/// linearly, clamped to the end samples.
std::vector<double> sampled(const Lut& lut, std::size_t level, const std::vector<double>& place);

/// Random points for comparing tables with their functions; point i depends only on seed + i.
struct RandomPoints {
    std::size_t count = 10000;
    std::uint64_t seed = 1;
    unsigned threads = 0;
    bool all_levels = true;  ///< false: only the first level
};

/// Largest difference, in the plan's measure, between a table and its function at random points of
/// the plan's domain.
double worst_difference(const LutPlan& plan, const Lut& lut, const RandomPoints& points);

/// Largest Delta E 2000 between the shading fourier and the exact colours, at random angles and
/// varied values of a material; for a single thickness, for the material's thickness_spread_nm and
/// for a third of it.
/// scene        the scene
/// material     one of its materials, shaded by fourier
/// plan         the material's plan, for the shader's constants
/// sensitivity  its sensitivity table; nullptr if it has none
/// execution    threads and SIMD level for the exact colours
/// points       number and seed of the points
double worst_fourier_difference(const schemas::Scene& scene, const schemas::SceneMaterial& material,
                                const MaterialPlan& plan, const Lut* sensitivity,
                                const Execution& execution, const RandomPoints& points);

/// Largest Delta E 2000 of a material's reflected light from replacing all indices by those at
/// kShaderIndices_nm, over up to nine angles and nine values of each varied quantity.
double dispersion_difference(const schemas::Scene& scene, const schemas::SceneMaterial& material,
                             const Execution& execution);

}  // namespace irido::tables
