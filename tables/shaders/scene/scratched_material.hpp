#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/colorimetry/sensitivity.hpp"
#include "core/math/simd_level.hpp"
#include "schemas/documents/scene_document.hpp"
#include "tables/lut/lut_kind.hpp"
#include "tables/scratch/grid_file.hpp"

namespace irido::tables {

/// A table that a scratched material needs, or does not.
struct ScratchNeed {
    std::string role, kind;  ///< wide, narrow, points, footprint
    LutOptions options{};
    bool is_needed = false;
    bool is_single = false;  ///< in f32 whatever the scene's type
    bool is_color = false;   ///< whether the tolerance is that of colours
    std::string why;         ///< it is needed, or not
};

/// What an engine needs for a scratched material, but for the colour of its base.
struct ScratchNeeds {
    std::vector<ScratchNeed> tables;
    std::vector<Scratch> scratches;  ///< for the grid
    GridExtent extent;
    nlohmann::json constants;
    std::vector<std::string> snippets;
};

/// Decides by the lights of a scene. In x = u/(u + C), u = W q, a light of d degrees covers at most
/// 2 h/(h + C), h = W sin(d/2), where it lies about the mirror direction, and least at q = 2.
/// Lights from kNarrowLight in x on are differences of T (wide), narrower ones its derivative, and
/// points have nodes of the spectrum.
/// Throws DomainError for a field with too many scratches.
ScratchNeeds needs_of_scratches(const schemas::Scene& scene,
                                const schemas::SceneScratches& scratches);
inline constexpr double kNarrowLight = 0.05;

/// Largest CIEDE2000 that a shader's product of two colours, that of the scratches in a perfect
/// mirror and that of their base, is off the colour of the product of spectra: for random scratches
/// and lights of the scene, at three angles theta_d, exposed to Y = 0.5 but for those darker than
/// 0.01.
///   request  for a table of the base's colours
double product_difference(const schemas::Scene& scene, const schemas::SceneScratches& scratches,
                          const LutRequest& request);

}  // namespace irido::tables
