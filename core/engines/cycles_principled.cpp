#include <algorithm>
#include <cmath>

#include "core/coherent/fresnel.hpp"
#include "core/engines/cycles_airy.hpp"
#include "core/engines/engine.hpp"
#include "core/engines/series.hpp"

namespace irido {

namespace {

/// n + ik with reflectance f0 and, approximately, g at cosine 1/7.
Complex index_of_f82(double f0, double g) {
    const double r = std::min(f0, 0.999);
    const double n = mixed(index_of_f0(r), (1 - r) / (1 + r), g);
    return {n, std::sqrt(std::max((r * square(n + 1) - square(n - 1)) / (1 - r), 0.0))};
}

double clipped(double x) {
    return std::clamp(x, 0.0, 1.0);
}

/// F82-Schlick of the interface below the film; g is the base's reflectance in air at cosine 1/7.
double f82_below(const Complex& index, double film_n, double g, double cos_film) {
    const double n = index.real() / film_n, k = index.imag() / film_n;
    const double f0 = base_f0(n, k);
    const double scale = 7 / sixth_power(6.0 / 7) * (schlick(f0, kF82Cosine) - g);
    return clipped(schlick(f0, cos_film) - scale * cos_film * sixth_power(1 - cos_film));
}

}  // namespace

Triple cycles_principled_reflectance(const EngineFilm& film) {
    if (!film.is_conductor()) return cycles_reflectance(film);
    const CyclesFilm at(film);
    Triple rgb{};
    std::array<std::array<CyclesFace, 2>, 3> faces;
    for (std::size_t c = 0; c < 3; ++c) {
        const double f0 = film.base_f0[c], tint = film.base_f82_tint[c];
        rgb[c] = clipped(f82_schlick(f0, tint, film.cos_theta));
        const double g = clipped(f82_schlick(f0, tint, kF82Cosine));
        const Complex index = index_of_f82(f0, g);
        faces[c] = cycles_conductor(at, index.real(), index.imag());
        const double R23 = f82_below(index, at.film_n, g, at.cos_film);
        for (CyclesFace& face : faces[c]) face.R23 = R23;
    }
    if (film.thickness_nm <= kCyclesThinnest_nm) return rgb;
    if (at.is_mirror()) return {1, 1, 1};
    return cycles_airy(at, faces);
}

constexpr Engine kCyclesPrincipledEngine{
    .name = "cycles-principled",
    .title = "Blender Cycles, Principled BSDF",
    .version = "97dbe6f",
    .date = "2026-07",
    .source =
        "https://projects.blender.org/blender/blender, "
        "intern/cycles/kernel/closure/bsdf_util.h",
    .inputs =
        "Thin Film IOR; Thin Film Thickness in nm; IOR of a dielectric; Base Color (F0) and "
        "Specular Tint (F82) of a metal",
    .space = "scene linear (Rec.709)",
    .white = "D65",
    .limits =
        "dielectrics as cycles; a metal is an F82-Schlick curve whose value at 82 degrees, "
        "that of the base in air, is also used under the film",
    .reflectance = cycles_principled_reflectance};

}  // namespace irido
