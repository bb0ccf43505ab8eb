#include <algorithm>
#include <cmath>

#include "core/engines/engine.hpp"
#include "core/engines/series.hpp"

namespace irido {

namespace {

/// Schlick's formula with the fifth power approximated by exp2.
double schlick_exp2(double f0, double cos_theta) {
    const double weight = std::exp2((-5.55473 * cos_theta - 6.98316) * cos_theta);
    return f0 * (1 - weight) + weight;
}

}  // namespace

Triple three_reflectance(const EngineFilm& film) {
    const double film_n =
        mixed(film.outside_n, film.film_n, smooth_step(0, 0.03, film.thickness_nm));
    Triple rgb{}, base_n{};
    for (std::size_t c = 0; c < 3; ++c) {
        base_n[c] = index_of_f0(std::clamp(film.base_f0[c], 0.0, 0.9999));
        rgb[c] = schlick_exp2(film.base_f0[c], film.cos_theta);
    }
    if (film.thickness_nm > 0) rgb = schlick_film(film, film_n, base_n, schlick_exp2);
    for (double& component : rgb) component = std::clamp(component, 0.0, 1.0);
    return rgb;
}

constexpr Engine kThreeEngine{
    .name = "three",
    .title = "three.js, MeshPhysicalMaterial (WebGL)",
    .version = "0.187.0",
    .date = "2026-10",
    .source =
        "https://www.npmjs.com/package/three, src/renderers/shaders/ShaderChunk/"
        "iridescence_fragment.glsl.js",
    .inputs =
        "iridescenceIOR; iridescenceThicknessRange in nm; base F0 as linear Rec.709; "
        "iridescence [0, 1]",
    .space = "linear Rec.709",
    .white = "D65",
    .limits =
        "as gltf, with Schlick's power as exp2, results clipped to [0, 1] and a film that "
        "fades out below 0.03 nm; takes the angle to the normal, not to the half vector",
    .reflectance = three_reflectance};

}  // namespace irido
