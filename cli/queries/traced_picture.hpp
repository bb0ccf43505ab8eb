#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "cli/queries/color_query.hpp"
#include "core/render/picture.hpp"
#include "core/rough/layered/layered_scattering.hpp"
#include "schemas/documents/surface_document.hpp"

namespace irido::cli {

/// A picture, and how its colours were computed.
struct DrawnPicture {
    Picture picture;
    Painter::Survey survey;
    ColorReport report;
    std::vector<std::string> notes;    ///< what is to be said of it
    std::vector<std::string> skipped;  ///< what was not computed, and why
    bool is_traced = false;
};

/// How pictures along paths are drawn.
struct TracedRequest {
    const Illumination* light = nullptr;
    std::vector<const Sensitivity*> others;  ///< of the lamps' own illuminants, numbers from 1 on
    Paths paths = Paths::single;
    Crossings crossings = Crossings::single;
    double tolerance = 0.1;  ///< of tables, CIEDE2000
    Execution execution;
    std::function<void(double)> progress;
};

/// Of a stack, smooth or of the scene's roughness; layer `varied` has the scene's noise.
/// Throws DomainError.
DrawnPicture trace_stack(const PictureScene& scene, const SurfaceStack& stack,
                         const TracedRequest& request);

/// Of a surface document. Throws DomainError.
DrawnPicture trace_surface(const PictureScene& scene, const schemas::Surface& surface,
                           const TracedRequest& request);

}  // namespace irido::cli
