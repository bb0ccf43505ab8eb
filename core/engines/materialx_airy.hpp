#pragma once

#include <array>

#include "core/engines/engine_film.hpp"

namespace irido {

/// Reflectances of s and p; names as in MaterialX's mx_microfacet_specular.glsl.
struct FresnelPair {
    double s, p;
};

/// A dielectric interface of relative index n.
FresnelPair materialx_dielectric_fresnel(double cos_theta, double n);
/// A conducting interface of relative n, k.
FresnelPair materialx_conductor_fresnel(double cos_theta, double n, double k);

/// The lower interface of a film for one channel: reflectances and phases of s and p.
struct MaterialXBase {
    FresnelPair R23, phase23;
};

/// mx_fresnel_airy: XYZ from the series to order 2, converted to CIE RGB and clipped to [0, 1].
///   cos_theta     cosine of incidence, [0, 1]
///   film_n        index of the film, >= 1
///   cos_film      cosine inside the film
///   thickness_nm  [0, 1e9]
///   base          lower interface, one per channel
Triple materialx_airy(double cos_theta, double film_n, double cos_film, double thickness_nm,
                      const std::array<MaterialXBase, 3>& base);

/// MaterialX's cosine of incidence (at least 1e-8), film index (at least 1) and cosine in the film.
struct MaterialXAngles {
    explicit MaterialXAngles(const EngineFilm& film);
    double cos_theta, film_n, cos_film;
};

/// generalized_schlick_bsdf with a film, F90 = 1 and exponent 5.
Triple materialx_schlick(const EngineFilm& film, const Triple& f82_tint);

}  // namespace irido
