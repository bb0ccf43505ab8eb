#include "core/engines/materialx_airy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/engines/engine.hpp"
#include "core/engines/gaussian_observer.hpp"
#include "core/engines/series.hpp"

namespace irido {

const ColorMatrix kMaterialXRgb{{{2.3706743, -0.9000405, -0.4706338},
                                 {-0.5138850, 1.4253036, 0.0885814},
                                 {0.0052982, -0.0146949, 1.0093968}}};

FresnelPair materialx_dielectric_fresnel(double cos_theta, double n) {
    if (cos_theta <= 0) return {1, 1};
    const double c2 = square(cos_theta), s2 = 1 - c2, t0 = std::max(n * n - s2, 0.0);
    const double t1 = t0 + c2, t2 = 2 * std::sqrt(t0) * cos_theta;
    const double s = (t1 - t2) / (t1 + t2);
    const double t3 = c2 * t0 + s2 * s2, t4 = t2 * s2;
    return {s, s * ((t3 - t4) / (t3 + t4))};
}

FresnelPair materialx_conductor_fresnel(double cos_theta, double n, double k) {
    const double c2 = square(cos_theta), s2 = 1 - c2;
    const double t0 = n * n - k * k - s2;
    const double ab = std::sqrt(t0 * t0 + 4 * n * n * k * k);
    const double a = std::sqrt(std::max((ab + t0) / 2, 0.0));
    const double t1 = ab + c2, t2 = 2 * a * cos_theta;
    const double s = (t1 - t2) / (t1 + t2);
    const double t3 = c2 * ab + s2 * s2, t4 = t2 * s2;
    return {s, t3 + t4 == 0 ? s : s * ((t3 - t4) / (t3 + t4))};
}

MaterialXAngles::MaterialXAngles(const EngineFilm& film)
    : cos_theta(std::clamp(film.cos_theta, 1e-8, 1.0)),
      film_n(std::max(film.film_n, 1.0)),
      cos_film(std::sqrt(std::max(0.0, 1 - (1 - square(cos_theta)) / square(film_n)))) {}

Triple materialx_airy(double cos_theta, double film_n, double cos_film, double thickness_nm,
                      const std::array<MaterialXBase, 3>& base) {
    constexpr double pi = std::numbers::pi;
    const FresnelPair R12 =
        cos_film <= 0 ? FresnelPair{1, 1} : materialx_dielectric_fresnel(cos_theta, film_n);
    const double brewster = std::cos(std::atan(film_n));
    const FresnelPair phase21{pi, cos_theta < brewster ? 0 : pi};
    const double opd_nm = 2 * film_n * cos_film * thickness_nm;
    const std::array observer{GaussianObserver(opd_nm), GaussianObserver(2 * opd_nm)};
    Triple xyz{};
    for (double FresnelPair::*const side : {&FresnelPair::p, &FresnelPair::s}) {
        Triple phase{};
        std::array<double, 3> amplitude{}, step{};
        for (std::size_t c = 0; c < 3; ++c) {
            const AirySeries series(R12.*side, base[c].R23.*side);
            phase[c] = base[c].phase23.*side + phase21.*side;
            xyz[c] += series.constant;
            amplitude[c] = series.amplitude;
            step[c] = series.step;
        }
        for (std::size_t m = 1; m <= observer.size(); ++m) {
            const auto order = static_cast<double>(m);
            const Triple fringes =
                observer[m - 1]({order * phase[0], order * phase[1], order * phase[2]});
            for (std::size_t c = 0; c < 3; ++c) {
                amplitude[c] *= step[c];
                xyz[c] += amplitude[c] * 2 * fringes[c];
            }
        }
    }
    for (double& component : xyz) component *= 0.5;
    Triple rgb = product(kMaterialXRgb, xyz);
    for (double& component : rgb) component = std::clamp(component, 0.0, 1.0);
    return rgb;
}

Triple materialx_schlick(const EngineFilm& film, const Triple& f82_tint) {
    const MaterialXAngles at(film);
    Triple rgb{};
    std::array<MaterialXBase, 3> base{};
    for (std::size_t c = 0; c < 3; ++c) {
        rgb[c] = f82_schlick(film.base_f0[c], f82_tint[c], at.cos_theta);
        // half the reflectance of the base in air is used under the film
        const double R23 = 0.5 * f82_schlick(film.base_f0[c], f82_tint[c], at.cos_film);
        const double base_n = index_of_f0(std::clamp(film.base_f0[c], 0.01, 0.99));
        const double phase = is_below(base_n, at.film_n) ? std::numbers::pi : 0;
        base[c] = {{R23, R23}, {phase, phase}};
    }
    if (film.thickness_nm <= 0) return rgb;
    return materialx_airy(at.cos_theta, at.film_n, at.cos_film, film.thickness_nm, base);
}

}  // namespace irido
