#pragma once

namespace irido {

/// Roughness that the functions of rough layers take.
inline constexpr double kSmoothest = 1e-4, kRoughest = 1;

/// The isotropic Trowbridge-Reitz (GGX) distribution of microfacet normals, per steradian:
///     D(m) = alpha^2 / (pi (1 - (1 - alpha^2) cos^2 theta_m)^2)
/// alpha  [1e-4, 1];  cos_theta_m  of the facet's normal against the surface's, [0, 1]
/// Throws DomainError naming the argument.
/// Source: FPB24 eq. 18, after B. Walter et al., EGSR 2007, eq. 33.
double ggx_distribution(double alpha, double cos_theta_m);

/// Smith's share of facets that a direction sees: 2 / (1 + sqrt(1 + alpha^2 tan^2 theta)); 0 at
/// grazing, where F_alpha integrates to it. alpha [1e-4, 1];  cos_theta [0, 1], else DomainError.
/// Source: FPB24 eq. 19.
double smith_masking(double alpha, double cos_theta);

/// Share of facets that two directions see, their heights being one: 1 / (1 + L_i + L_o) with
/// 1 + L = 1/G1. alpha [1e-4, 1];  cosines [0, 1], else DomainError; 0 where one of them is 0.
/// Source: E. Heitz, JCGT 3(2), 48 (2014), eq. 99.
double smith_masking_shadowing(double alpha, double cos_theta_i, double cos_theta_o);

}  // namespace irido
