#include "core/engines/series.hpp"

#include <algorithm>
#include <numbers>

#include "core/coherent/fresnel.hpp"
#include "core/engines/gaussian_observer.hpp"

namespace irido {

double smooth_step(double first, double last, double x) {
    const double t = std::clamp((x - first) / (last - first), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

Triple product(const ColorMatrix& rows, const Triple& column) {
    Triple result{};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = rows[i][0] * column[0] + rows[i][1] * column[1] + rows[i][2] * column[2];
    return result;
}

AirySeries::AirySeries(double R12, double R23) : AirySeries(R12, R23, R12 * R23) {}

AirySeries::AirySeries(double R12, double R23, double R123) {
    const double T = 1 - R12;
    const double Rs = T == 0 ? 0 : T * T * R23 / (1 - R123);
    constant = R12 + Rs;
    amplitude = Rs - T;
    step = std::sqrt(std::max(R123, 0.0));
}

Triple shader_series(const std::array<AirySeries, 3>& series, double opd_nm, const Triple& phase) {
    Triple rgb{series[0].constant, series[1].constant, series[2].constant};
    Triple amplitude{series[0].amplitude, series[1].amplitude, series[2].amplitude};
    for (int m = 1; m <= 2; ++m) {
        const Triple xyz = GaussianObserver(m * opd_nm)({m * phase[0], m * phase[1], m * phase[2]});
        const Triple fringes = product(kShaderRgb, xyz);
        for (std::size_t c = 0; c < 3; ++c) {
            amplitude[c] *= series[c].step;
            rgb[c] += amplitude[c] * 2 * fringes[c];
        }
    }
    return rgb;
}

Triple schlick_film(const EngineFilm& film, double film_n, const Triple& base_n,
                    double (*fresnel)(double f0, double cos_theta)) {
    const double outside = film.outside_n, c = film.cos_theta;
    const double cos2 = 1 - square(outside / film_n) * (1 - c * c);
    if (cos2 < 0) return {1, 1, 1};
    const double c2 = std::sqrt(cos2);
    const double R12 = fresnel(normal_reflectance(film_n, outside), c);
    const double phase21 = film_n < outside ? 0 : std::numbers::pi;
    Triple phase{};
    const auto series_of = [&](std::size_t i) {
        const double n3 = base_n[i];
        const double R23 = fresnel(std::isfinite(n3) ? normal_reflectance(n3, film_n) : 1, c2);
        phase[i] = phase21 + (is_below(n3, film_n) ? std::numbers::pi : 0);
        return AirySeries(R12, R23, std::clamp(R12 * R23, 1e-5, 0.9999));
    };
    const std::array series{series_of(0), series_of(1), series_of(2)};
    return shader_series(series, 2 * film_n * film.thickness_nm * c2, phase);
}

double f82_schlick(double f0, double tint, double cos_theta) {
    const double at_f82 = schlick(f0, kF82Cosine);
    const double scale = 7 / sixth_power(6.0 / 7) * at_f82 * (1 - tint);
    return schlick(f0, cos_theta) - scale * cos_theta * sixth_power(1 - cos_theta);
}

}  // namespace irido
