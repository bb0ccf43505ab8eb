#include "core/engines/cycles_airy.hpp"

#include <algorithm>
#include <cmath>

#include "core/engines/cycles_table.hpp"
#include "core/engines/series.hpp"

namespace irido {

namespace {

constexpr std::size_t kCyclesOrders = 3;

Complex unit_phasor(Complex z) {
    const double modulus = std::abs(z);
    return modulus > 0 ? z / modulus : Complex(1);
}

}  // namespace

CyclesFilm::CyclesFilm(const EngineFilm& film)
    : film_n(film.thickness_nm < 1 ? mixed(1, film.film_n, smooth_step(0, 1, film.thickness_nm))
                                   : film.film_n) {
    const double c = film.cos_theta, inside = square(film_n) - (1 - c * c);
    cos_film = inside <= 0 ? 0 : std::sqrt(inside) / film_n;
    opd_nm = 2 * film_n * film.thickness_nm * cos_film;
    if (inside <= 0) return;
    const double rs = (c - film_n * cos_film) / (c + film_n * cos_film);
    const double rp = (film_n * c - cos_film) / (film_n * c + cos_film);
    R12 = {rp * rp, rs * rs};
    sign12 = {rp >= 0 ? 1.0 : -1.0, rs >= 0 ? 1.0 : -1.0};
}

std::array<CyclesFace, 2> cycles_conductor(const CyclesFilm& film, double n, double k) {
    const double n1 = film.film_n, ct = film.cos_film;
    const double t1 = n * n - k * k - n1 * n1 * (1 - ct * ct), t2 = std::hypot(t1, 2 * n * k);
    const double u2 = std::max((t2 + t1) / 2, 0.0), v2 = std::max((t2 - t1) / 2, 0.0);
    const double u = std::sqrt(u2), v = std::sqrt(v2);
    const double Rs = (square(n1 * ct - u) + v2) / (square(n1 * ct + u) + v2);
    const double P = (n * n - k * k) * ct, Q = 2 * n * k * ct;
    const double below = square(P + n1 * u) + square(Q + n1 * v);
    const double Rp = below == 0 ? 0 : (square(P - n1 * u) + square(Q - n1 * v)) / below;
    const Complex s(square(n1 * ct) - u2 - v2, -2 * n1 * ct * v);
    const Complex p(square((n * n + k * k) * ct) - n1 * n1 * (u2 + v2),
                    2 * n1 * ct * (2 * n * k * u - (n * n - k * k) * v));
    return {CyclesFace{Rp, unit_phasor(p)}, CyclesFace{Rs, unit_phasor(s)}};
}

Triple cycles_airy(const CyclesFilm& film, const std::array<std::array<CyclesFace, 2>, 3>& faces) {
    std::array<std::array<Complex, 3>, kCyclesOrders> sensitivity;
    for (std::size_t m = 1; m <= kCyclesOrders; ++m)
        sensitivity[m - 1] = cycles_sensitivity(static_cast<double>(m) * film.opd_nm);
    Triple rgb{};
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t side = 0; side < 2; ++side) {
            const CyclesFace& face = faces[c][side];
            const AirySeries series(film.R12[side], face.R23);
            const Complex z = -face.phasor23 * film.sign12[side];
            Complex power = 1;
            double amplitude = series.amplitude;
            rgb[c] += series.constant;
            for (const std::array<Complex, 3>& order : sensitivity) {
                power *= z;
                amplitude *= series.step;
                const Complex L = order[c];
                rgb[c] += 2 * amplitude * (power.real() * L.real() + power.imag() * L.imag());
            }
        }
        rgb[c] = std::clamp(rgb[c] / 2, 0.0, 1.0);
    }
    return rgb;
}

}  // namespace irido
