#pragma once

#include <array>

#include "core/engines/engine_film.hpp"

namespace irido {

/// Reflectances of s and p; names as in MaterialX's mx_microfacet_specular.glsl.
struct FresnelPair {
    double s, p;
};

/// A dielectric face of relative index n.
FresnelPair materialx_dielectric_fresnel(double cos_theta, double n);
/// A conducting face of relative n, k.
FresnelPair materialx_conductor_fresnel(double cos_theta, double n, double k);

/// The lower face of a film for one channel: reflectances and phases of s and p.
struct MaterialXBase {
    FresnelPair R23, phase23;
};

/// mx_fresnel_airy: XYZ by the series to order 2, turned into CIE RGB and clipped to [0, 1].
/// `cos_film` is the cosine inside the film of index `film_n` >= 1.
Triple materialx_airy(double cos_theta, double film_n, double cos_film, double thickness_nm,
                      const std::array<MaterialXBase, 3>& base);

/// The cosine that MaterialX uses, at least 1e-8, the film's index, at least 1, and the cosine
/// inside it.
struct MaterialXAngles {
    explicit MaterialXAngles(const EngineFilm& film);
    double cos_theta, film_n, cos_film;
};

/// generalized_schlick_bsdf with a film, F90 = 1 and exponent 5.
Triple materialx_schlick(const EngineFilm& film, const Triple& f82_tint);

}  // namespace irido
