#include "core/engines/engine.hpp"
#include "core/engines/materialx_airy.hpp"

namespace irido {

Triple openpbr_reflectance(const EngineFilm& film) {
    return film.is_conductor() ? materialx_schlick(film, film.base_f82_tint)
                               : materialx_reflectance(film);
}

constexpr Engine kOpenPbrEngine{
    .name = "openpbr",
    .title = "OpenPBR 1.1.1, MaterialX's open_pbr_surface",
    .version = "MaterialX 4177b2c",
    .date = "2026-07",
    .source =
        "https://github.com/AcademySoftwareFoundation/MaterialX, "
        "libraries/bxdf/open_pbr_surface.mtlx",
    .inputs =
        "thin_film_ior; thin_film_thickness in um; specular_ior of a dielectric; base_color "
        "(F0) and specular_color (F82 tint) of a metal",
    .space = "CIE RGB, shown as linear Rec.709",
    .white = "E",
    .limits = "dielectrics as materialx, metals as materialx-gltf with an F82 tint",
    .reflectance = openpbr_reflectance};

}  // namespace irido
