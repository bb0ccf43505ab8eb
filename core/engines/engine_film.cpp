#include "core/engines/engine_film.hpp"

#include <algorithm>
#include <cmath>

#include "core/coherent/fresnel.hpp"
#include "core/engines/series.hpp"
#include "core/error.hpp"
#include "core/stack/stack.hpp"

namespace irido {

bool EngineFilm::is_conductor() const {
    return std::ranges::any_of(base_k, [](double k) { return k > 0; });
}

double bare_reflectance(double n, double k, double cos_theta) {
    const Medium air = medium(1.0, 1, cos_theta), base = medium(Complex(n, k), 1, cos_theta);
    return (std::norm(face_amplitude(air, base, Polarization::s)) +
            std::norm(face_amplitude(air, base, Polarization::p))) /
           2;
}

double base_f0(double n, double k) {
    return (square(n - 1) + square(k)) / (square(n + 1) + square(k));
}

double f82_tint(double f0, double reflectance_at_f82) {
    return std::min(1.0, reflectance_at_f82 / schlick(f0, kF82Cosine));
}

EngineFilm with_base(EngineFilm film) {
    require_in_range("cos_theta", film.cos_theta, 0, 1);
    require_in_range("film index", film.film_n, 1e-3, 1e4);
    require_in_range("thickness_nm", film.thickness_nm, 0, kLargestThickness_nm);
    for (std::size_t c = 0; c < 3; ++c) {
        const double n = film.base_n[c], k = film.base_k[c];
        require_in_range("base index n", n, 1e-6, 1e4);
        require_in_range("base index k", k, 0, 1e4);
        film.base_f0[c] = base_f0(n, k);
        film.base_f82_tint[c] =
            k > 0 ? f82_tint(film.base_f0[c], bare_reflectance(n, k, kF82Cosine)) : 1;
    }
    return film;
}

}  // namespace irido
