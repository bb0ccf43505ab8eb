#include <algorithm>

#include "core/coherent/fresnel.hpp"
#include "core/engines/engine.hpp"
#include "core/engines/series.hpp"

namespace irido {

namespace {

/// Added to F0 before it is converted to an index.
constexpr double kGltfF0Guard = 1e-4;

}  // namespace

Triple gltf_reflectance(const EngineFilm& film) {
    Triple base_n{};
    for (std::size_t c = 0; c < 3; ++c) base_n[c] = index_of_f0(film.base_f0[c] + kGltfF0Guard);
    Triple rgb = schlick_film(film, film.film_n, base_n, schlick);
    for (double& component : rgb) component = std::max(component, 0.0);
    return rgb;
}

Triple gltf_reflectance(const EngineFilm& film, double factor) {
    Triple rgb = gltf_reflectance(film);
    for (std::size_t c = 0; c < 3; ++c)
        rgb[c] = mixed(schlick(film.base_f0[c], film.cos_theta), rgb[c], factor);
    return rgb;
}

constexpr Engine kGltfEngine{
    .name = "gltf",
    .title = "glTF 2.0, KHR_materials_iridescence",
    .version = "README at 77b44be",
    .date = "2026-07",
    .source =
        "https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos/"
        "KHR_materials_iridescence",
    .inputs =
        "iridescenceIor >= 1; iridescenceThickness in nm; base F0 as linear Rec.709 "
        "(baseColor of a metal, ((ior - 1)/(ior + 1))^2 of a dielectric); factor [0, 1]",
    .space = "linear Rec.709",
    .white = "D65",
    .limits =
        "one film of real constant index; the base is an F0, its phase 0 or pi; Schlick "
        "instead of Fresnel; fringes of at least 1e-5 even where there is no interface; no "
        "rule for thickness 0",
    .reflectance = [](const EngineFilm& film) { return gltf_reflectance(film); }};

}  // namespace irido
