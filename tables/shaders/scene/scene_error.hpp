#pragma once

#include <cstdint>
#include <vector>

#include "tables/lut/lut_maker.hpp"
#include "tables/shaders/scene/scene_plan.hpp"

namespace irido::tables {

/// All channels of a table at one place: one number for each axis that the level has, linear
/// between samples, the end samples outside of them.
std::vector<double> sampled(const Lut& lut, std::size_t level, const std::vector<double>& place);

/// Points at which tables are compared with their functions: point i depends on seed + i only.
struct RandomPoints {
    std::size_t count = 10000;
    std::uint64_t seed = 1;
    unsigned threads = 0;
    bool all_levels = true;  ///< or without a spread alone
};

/// Largest difference, in the plan's measure, of a table from its function at random points of all
/// that the plan was asked for.
double worst_difference(const LutPlan& plan, const Lut& lut, const RandomPoints& points);

/// The same of what a shader computes from a table of the sensitivity, with the constants of the
/// plan, as Delta E 2000 from the exact colours: at the material's angles and values, without a
/// spread of the thickness and with the one that it has, and with a third of that.
double worst_fourier_difference(const schemas::Scene& scene, const schemas::SceneMaterial& material,
                                const MaterialPlan& plan, const Lut* sensitivity,
                                const Execution& execution, const RandomPoints& points);

/// Largest Delta E 2000 of a material's reflected light that comes from taking all indices where
/// shaders take them, at places of its angles and of what varies, up to nine of each.
double dispersion_difference(const schemas::Scene& scene, const schemas::SceneMaterial& material,
                             const Execution& execution);

}  // namespace irido::tables
