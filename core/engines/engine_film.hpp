#pragma once

#include "core/colorimetry/space.hpp"

namespace irido {

/// A film on a base as renderers describe it: one index, one thickness, and three numbers per
/// property of the base instead of a spectrum. Each engine reads the fields it has inputs for.
struct EngineFilm {
    double cos_theta = 1;     ///< of the angle of incidence, [0, 1]
    double outside_n = 1;     ///< of the incident medium; only gltf supports other values than 1
    double film_n = 1;        ///< (0, 1e4]
    double thickness_nm = 0;  ///< [0, 1e9]
    Triple base_n{1, 1, 1};   ///< per channel r, g, b
    Triple base_k{};
    Triple base_f0{};               ///< reflectance of the base in air at normal incidence, [0, 1]
    Triple base_f82_tint{1, 1, 1};  ///< F82-Schlick tint, [0, 1]

    /// Whether any k is positive.
    bool is_conductor() const;
};

/// Cosine of the angle at which F82-Schlick applies its tint.
inline constexpr double kF82Cosine = 1.0 / 7;

/// Exact reflectance of a bare base in air for unpolarized light. n + ik is not 0; cos_theta in [0,
/// 1].
double bare_reflectance(double n, double k, double cos_theta);

/// ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2).
double base_f0(double n, double k);

/// min(1, R(1/7) / (F0 + (1 - F0)(6/7)^5)), with R(1/7) the base's reflectance at cosine 1/7.
double f82_tint(double f0, double reflectance_at_f82);

/// Fills in base_f0 and base_f82_tint from n and k, channel by channel; the tint of a non-conductor
/// is 1. Throws DomainError unless cos_theta is in [0, 1], film_n in [1e-3, 1e4], thickness_nm in
/// [0, 1e9], base n in [1e-6, 1e4] and k in [0, 1e4].
EngineFilm with_base(EngineFilm film);

}  // namespace irido
