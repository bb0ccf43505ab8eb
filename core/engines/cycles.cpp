#include <cmath>

#include "core/engines/cycles_airy.hpp"
#include "core/engines/engine.hpp"
#include "core/engines/series.hpp"

namespace irido {

namespace {

/// Lower interface to a dielectric base of index n; total reflection has unit R23 and no phase.
std::array<CyclesFace, 2> cycles_dielectric(const CyclesFilm& film, double n) {
    const double eta = n / film.film_n, c = film.cos_film;
    const double inside = square(eta) - (1 - c * c);
    if (inside <= 0) return {CyclesFace{1, 1}, CyclesFace{1, 1}};
    const double ct = std::sqrt(inside) / eta;
    const double rs = (c - eta * ct) / (c + eta * ct), rp = (eta * c - ct) / (eta * c + ct);
    return {CyclesFace{rp * rp, rp >= 0 ? 1 : -1}, CyclesFace{rs * rs, rs >= 0 ? 1 : -1}};
}

}  // namespace

Triple cycles_reflectance(const EngineFilm& film) {
    const bool conducts = film.is_conductor();
    Triple rgb{};
    if (film.thickness_nm <= kCyclesThinnest_nm) {
        for (std::size_t c = 0; c < 3; ++c)
            rgb[c] = bare_reflectance(film.base_n[c], film.base_k[c], film.cos_theta);
        return rgb;
    }
    const CyclesFilm at(film);
    if (at.is_mirror()) return {1, 1, 1};
    std::array<std::array<CyclesFace, 2>, 3> faces;
    for (std::size_t c = 0; c < 3; ++c) {
        faces[c] = conducts ? cycles_conductor(at, film.base_n[c], film.base_k[c])
                            : cycles_dielectric(at, film.base_n[c]);
        if (!conducts && faces[c][0].R23 == 1 && faces[c][1].R23 == 1) return {1, 1, 1};
    }
    return cycles_airy(at, faces);
}

constexpr Engine kCyclesEngine{
    .name = "cycles",
    .title = "Blender Cycles, Glass BSDF or Metallic BSDF (Physical Conductor)",
    .version = "97dbe6f",
    .date = "2026-07",
    .source =
        "https://projects.blender.org/blender/blender, "
        "intern/cycles/kernel/closure/bsdf_util.h",
    .inputs =
        "Thin Film IOR; Thin Film Thickness in nm; IOR of a dielectric, IOR and Extinction "
        "per r, g, b of a conductor (here at 650, 550, 450 nm)",
    .space = "scene linear (Rec.709)",
    .white = "D65",
    .limits =
        "one film of real index in air; three orders, too few over metals with a film of "
        "high index; table ends at an optical path of 9.5 um; clipped to [0, 1]",
    .reflectance = cycles_reflectance};

}  // namespace irido
