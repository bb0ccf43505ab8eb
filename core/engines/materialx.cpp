#include <cmath>

#include "core/engines/engine.hpp"
#include "core/engines/materialx_airy.hpp"
#include "core/engines/series.hpp"

namespace irido {

namespace {

/// Phases of reflection at the interface between the film and a base n3 + i k3.
FresnelPair materialx_phase23(double c, double n1, double n3, double k3) {
    const double K = k3 / n3, s2 = 1 - c * c;
    const double A = n3 * n3 * (1 - K * K) - n1 * n1 * s2;
    const double B = std::sqrt(A * A + square(2 * n3 * n3 * K));
    const double U = std::sqrt((A + B) / 2), V = std::sqrt(std::max(0.0, (B - A) / 2));
    const double s = std::atan2(2 * n1 * V * c, U * U + V * V - square(n1 * c));
    const double p = std::atan2(2 * n1 * n3 * n3 * c * (2 * K * U - (1 - K * K) * V),
                                square(n3 * n3 * (1 + K * K) * c) - n1 * n1 * (U * U + V * V));
    return {s, p};
}

}  // namespace

Triple materialx_reflectance(const EngineFilm& film) {
    const bool conducts = film.is_conductor();
    const MaterialXAngles at(film);
    Triple rgb{};
    std::array<MaterialXBase, 3> base{};
    for (std::size_t c = 0; c < 3; ++c) {
        const double n = film.base_n[c], k = film.base_k[c];
        const FresnelPair bare = conducts ? materialx_conductor_fresnel(at.cos_theta, n, k)
                                          : materialx_dielectric_fresnel(at.cos_theta, n);
        rgb[c] = (bare.s + bare.p) / 2;
        base[c] = {materialx_conductor_fresnel(at.cos_film, n / at.film_n, k / at.film_n),
                   materialx_phase23(at.cos_film, at.film_n, n, k)};
    }
    if (film.thickness_nm <= 0) return rgb;
    return materialx_airy(at.cos_theta, at.film_n, at.cos_film, film.thickness_nm, base);
}

constexpr Engine kMaterialXEngine{
    .name = "materialx",
    .title = "MaterialX, dielectric_bsdf or conductor_bsdf (GLSL)",
    .version = "4177b2c",
    .date = "2026-07",
    .source =
        "https://github.com/AcademySoftwareFoundation/MaterialX, "
        "libraries/pbrlib/genglsl/lib/mx_microfacet_specular.glsl",
    .inputs =
        "thinfilm_ior; thinfilm_thickness in nm; ior of a dielectric, ior and extinction "
        "per r, g, b of a conductor (here at 650, 550, 450 nm). standard_surface makes n and k "
        "from its base color",
    .space = "CIE RGB, shown as linear Rec.709",
    .white = "E",
    .limits =
        "one film of real index >= 1 in air; two orders; n and k of r, g, b are used as if "
        "they were those of X, Y, Z, which turns a gray film over a coloured base wrong; "
        "clipped to [0, 1]",
    .reflectance = materialx_reflectance};

}  // namespace irido
