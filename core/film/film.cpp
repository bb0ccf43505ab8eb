#include "core/film/film.hpp"

#include <cmath>

#include "core/coherent/fresnel.hpp"
#include "core/coherent/layer.hpp"

namespace irido {

std::optional<FilmSeries> film_series(const Film& film, IncidentAngle incidence,
                                      Polarization polarization) {
    const double n1 = film.incident, n2 = film.film;
    const Complex n3 = film.base;
    FilmSeries series{1, 0, 0, 0};
    if (incidence.cos == 0 && n1 == n2 && n3 == n1) return FilmSeries{0, 1, 0, 0};
    if (incidence.cos == 0 && n1 == n2) return series;
    const Medium in_film = medium(n2, n1, incidence);
    if (in_film.q2.real() <= 0) return std::nullopt;
    const Ray<double> a{n1 * n1, n1 * incidence.cos}, b = real_ray(n2, in_film);
    const Ray<Complex> c = outgoing_ray(medium(n3, n1, incidence));
    const double from_a = (n1 - n2) * (n1 + n2);
    const Complex from_b = (n2 - n3) * (n2 + n3);
    const double s2 = a.eps * incidence.sin * incidence.sin;
    const bool s = polarization == Polarization::s;
    const auto upper = s ? fresnel_s(a, b, from_a) : fresnel_p(a, b, from_a, s2);
    const auto lower = s ? fresnel_s(b, c, from_b) : fresnel_p(b, c, from_b, s2);
    series.bounce = Complex(0) - upper.r * lower.r;  // adding 0 turns -0 into 0
    series.opd_nm = 2 * film.thickness_nm * b.kz;
    if (upper.T == 0 || lower.T == 0) return series;
    if (!(series.ratio() < 1)) return std::nullopt;
    const double R12 = upper.r * upper.r;
    const double lost = upper.T + R12 * lower.T;  // 1 - R12 R23
    series.R = R12 + upper.T * upper.T * std::norm(lower.r) / lost;
    series.T = upper.T * lower.T / lost;
    return series;
}

double FilmSeries::coefficient(bool transmitted, double order) const {
    if (order == 0) return transmitted ? T : R;
    const double size = T * std::pow(ratio(), order);
    return transmitted ? size : 0 - size;
}

}  // namespace irido
