#include "core/engines/engine.hpp"
#include "core/engines/materialx_airy.hpp"

namespace irido {

Triple materialx_gltf_reflectance(const EngineFilm& film) {
    return materialx_schlick(film, {1, 1, 1});
}

constexpr Engine kMaterialXGltfEngine{
    .name = "materialx-gltf",
    .title = "MaterialX, gltf_pbr (generalized_schlick_bsdf)",
    .version = "4177b2c",
    .date = "2026-07",
    .source =
        "https://github.com/AcademySoftwareFoundation/MaterialX, "
        "libraries/bxdf/gltf_pbr.mtlx",
    .inputs = "iridescence_ior; iridescence_thickness in nm; base F0 as linear RGB",
    .space = "CIE RGB, shown as linear Rec.709",
    .white = "E",
    .limits =
        "one film of real index >= 1 in air; two orders; half of the base's reflectance "
        "in air stands for that under the film; F0 of r, g, b is used as if it were that "
        "of X, Y, Z; clipped to [0, 1]",
    .reflectance = materialx_gltf_reflectance};

}  // namespace irido
