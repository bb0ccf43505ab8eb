#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/coherent/fresnel.hpp"
#include "core/engines/engine.hpp"
#include "core/engines/series.hpp"

namespace irido {

namespace {

/// Optical path difference at the slider's upper end, nm.
constexpr double kUnityPath_nm = 3000;

}  // namespace

double unity_slider(const EngineFilm& film) {
    return std::clamp(2 * film.film_n * film.thickness_nm / kUnityPath_nm, 0.0, 1.0);
}

Triple unity_reflectance(const EngineFilm& film) {
    const double n0 = film.outside_n, t = unity_slider(film), c = film.cos_theta;
    const double n1 = mixed(2, 1, t);
    const double sine2 = square(n0 / n1) * (1 - c * c);
    if (sine2 > 1) return {1, 1, 1};
    const double c2 = std::sqrt(1 - sine2);
    const double R12 = schlick(normal_reflectance(n1, n0), c), pi = std::numbers::pi;
    const auto series_of = [&](double f0) { return AirySeries(R12, schlick(f0, c2)); };
    const std::array series{series_of(film.base_f0[0]), series_of(film.base_f0[1]),
                            series_of(film.base_f0[2])};
    return shader_series(series, kUnityPath_nm * t * c2, {pi, pi, pi});
}

constexpr Engine kUnityEngine{
    .name = "unity",
    .title = "Unity HDRP, EvalIridescence",
    .version = "core BSDF.hlsl with the colour matrix of SRP pull request 5691",
    .date = "read in 2026",
    .source =
        "https://github.com/Unity-Technologies/Graphics, "
        "com.unity.render-pipelines.core/ShaderLibrary/BSDF.hlsl",
    .inputs =
        "one slider t [0, 1]: film index 2 - t, optical path 3 um t; base F0 as linear "
        "Rec.709. Here t = 2 n d / 3 um, at most 1",
    .space = "linear Rec.709",
    .white = "D65",
    .limits =
        "index and thickness are one slider, the index is left out of the path and of the "
        "base's reflectance; no clipping: results below 0 and above 1 occur",
    .reflectance = unity_reflectance};

}  // namespace irido
