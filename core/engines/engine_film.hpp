#pragma once

#include "core/colorimetry/space.hpp"

namespace irido {

/// A film on a base as renderers take it: one index, one thickness, and a base that is three
/// numbers instead of a spectrum. Each engine reads the fields that it has inputs for.
struct EngineFilm {
    double cos_theta = 1;     ///< of incidence, [0, 1]
    double outside_n = 1;     ///< of the incident medium; only gltf takes one other than 1
    double film_n = 1;        ///< (0, 1e4]
    double thickness_nm = 0;  ///< [0, 1e9]
    Triple base_n{1, 1, 1};   ///< of r, g, b
    Triple base_k{};
    Triple base_f0{};               ///< reflectance of the base in air at normal incidence, [0, 1]
    Triple base_f82_tint{1, 1, 1};  ///< of F82-Schlick, [0, 1]

    /// Whether any k is above 0.
    bool is_conductor() const;
};

/// The angle at which F82-Schlick has its tint.
inline constexpr double kF82Cosine = 1.0 / 7;

/// Reflectance of unpolarized light by a bare base in air, exact. n + ik not 0; cos_theta in [0,
/// 1].
double bare_reflectance(double n, double k, double cos_theta);

/// ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2).
double base_f0(double n, double k);

/// min(1, R(1/7) / (F0 + (1 - F0)(6/7)^5)), R(1/7) the base's reflectance at that cosine.
double f82_tint(double f0, double reflectance_at_f82);

/// The film with base_f0 and base_f82_tint that follow from n and k, channel by channel. A base
/// that is no conductor has the tint 1. Throws DomainError unless cos_theta is in [0, 1], film_n in
/// [1e-3, 1e4], thickness_nm in [0, 1e9], base n in [1e-6, 1e4] and k in [0, 1e4].
EngineFilm with_base(EngineFilm film);

}  // namespace irido
