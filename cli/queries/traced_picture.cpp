#include "cli/queries/traced_picture.hpp"

#include <memory>

#include "core/color/held_stack.hpp"
#include "core/error.hpp"
#include "core/render/path_tracer.hpp"

namespace irido::cli {

namespace {

ShownRange range_of(const PictureScene& scene) {
    if (scene.noise) return {0, 1, scene.noise->least_nm, scene.noise->most_nm};
    return {0, 1, scene.thickness_nm, scene.thickness_nm};
}

/// Paints with a surface that `surface_of` makes for the picture's wavelengths.
DrawnPicture trace(PictureScene scene, ColorNodes nodes, const TracedRequest& request,
                   const std::function<TracedSurface(const TablePlan&)>& surface_of) {
    const PictureNodes all(std::move(nodes), request.light->tables.sensitivity().support(),
                           request.others, request.light->transform);
    const TablePlan plan{&all, request.tolerance, request.execution.threads,
                         request.execution.simd};
    scene.alpha.reset();  // the surface has it
    const PathTracer tracer(scene, surface_of(plan), all, range_of(scene), plan);
    const Painter painter(scene);
    DrawnPicture drawn;
    drawn.is_traced = true;
    drawn.survey.range = range_of(scene);
    drawn.survey.points =
        scene.camera.width * scene.camera.height * std::max<std::size_t>(1, scene.samples);
    drawn.picture = painter.paint(tracer, request.execution.threads, request.progress);
    drawn.report = tracer.report();
    return drawn;
}

DrawnPicture trace_layered(const PictureScene& scene, const LayeredSurface& surface,
                           const LayerPlace& varied, const TracedRequest& request) {
    const Sensitivity& sensitivity = request.light->tables.sensitivity();
    const LayeredScattering scattering(held_surface(surface, sensitivity), request.crossings,
                                       request.execution);
    if (request.paths == Paths::all && !scattering.is_closed())
        throw DomainError(
            "--paths all can be drawn for one layer without a coating, and for a base alone: "
            "others have no closed form");
    return trace(
        scene, layered_nodes(scattering, sensitivity, request.light->transform), request,
        [&](const TablePlan& plan) {
            return TracedSurface{
                layered_scatterer(scattering, request.paths, varied, range_of(scene), plan), {}};
        });
}

DrawnPicture trace_scratched(const PictureScene& scene, ScratchedSurface surface,
                             const TracedRequest& request) {
    const Sensitivity& sensitivity = request.light->tables.sensitivity();
    if (surface.fields.empty())
        throw DomainError(
            "scratches are drawn as fields, seen on average over many: single ones are far below "
            "a pixel (irido brdf has them)");
    if (surface.base) surface.base = held_stack(*surface.base, sensitivity);
    DrawnPicture drawn = trace(
        scene,
        scratched_nodes(surface, sensitivity, request.light->transform, request.execution.simd),
        request, [&](const TablePlan& plan) {
            return TracedSurface{scratch_scatterer(surface, plan), {}};
        });
    if (!surface.scratches.empty())
        drawn.skipped.push_back(std::to_string(surface.scratches.size()) + " single scratch" +
                                (surface.scratches.size() > 1 ? "es" : "") +
                                ": fields are seen on average");
    return drawn;
}

void require_opaque_shape(ShapeKind shape) {
    if (!is_opaque(shape))
        throw DomainError(
            "surfaces that scatter are drawn on a sphere, a plane or a ring: what they let "
            "through into a " +
            std::string(shape == ShapeKind::gem ? "gem" : "bubble") +
            " is not known in all directions");
}

}  // namespace

DrawnPicture trace_stack(const PictureScene& scene, const SurfaceStack& stack,
                         const TracedRequest& request) {
    const Sensitivity& sensitivity = request.light->tables.sensitivity();
    if (scene.alpha) {
        require_opaque_shape(scene.shape);
        LayeredSurface surface;
        surface.outside = surface.inside = stack.stack.materials[stack.stack.incident];
        surface.layers.push_back({stack.stack, *scene.alpha, false});
        return trace_layered(scene, surface, stack.varied, request);
    }
    const SurfaceStack held{held_stack(stack.stack, sensitivity), stack.varied};
    return trace(scene,
                 smooth_nodes(held, range_of(scene), sensitivity, request.light->transform,
                              request.execution.simd),
                 request, [&](const TablePlan&) {
                     return TracedSurface{nullptr, held};
                 });
}

DrawnPicture trace_surface(const PictureScene& scene, const schemas::Surface& surface,
                           const TracedRequest& request) {
    require_opaque_shape(scene.shape);
    if (const auto* const layered = std::get_if<LayeredSurface>(&surface))
        return trace_layered(scene, *layered, {}, request);
    return trace_scratched(scene, std::get<ScratchedSurface>(surface), request);
}

}  // namespace irido::cli
