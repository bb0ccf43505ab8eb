#include <algorithm>

#include "core/coherent/fresnel.hpp"
#include "core/engines/engine.hpp"
#include "core/engines/series.hpp"

namespace irido {

Triple babylon_reflectance(const EngineFilm& film) {
    const double film_n =
        mixed(film.outside_n, film.film_n, smooth_step(0, 0.03, film.thickness_nm));
    Triple base_n{};
    for (std::size_t c = 0; c < 3; ++c)
        base_n[c] = index_of_f0(std::clamp(film.base_f0[c], 0.0, 0.9999));
    Triple rgb = schlick_film(film, film_n, base_n, schlick);
    for (double& component : rgb) component = std::max(component, 0.0);
    return rgb;
}

constexpr Engine kBabylonEngine{
    .name = "babylon",
    .title = "Babylon.js, PBRMaterial.iridescence",
    .version = "pbrBRDFFunctions at 00e0487, pbrBlockIridescence at 2851755",
    .date = "read in 2026",
    .source =
        "https://github.com/BabylonJS/Babylon.js, packages/dev/core/src/Shaders/"
        "ShadersInclude/pbrBRDFFunctions.fx",
    .inputs =
        "indexOfRefraction; minimumThickness and maximumThickness in nm; base F0 as linear "
        "Rec.709; intensity [0, 1]",
    .space = "linear Rec.709",
    .white = "D65",
    .limits =
        "as gltf; a film that fades out below 0.03 nm; the material then applies Schlick's "
        "formula to the result a second time, which is left out here",
    .reflectance = babylon_reflectance};

}  // namespace irido
