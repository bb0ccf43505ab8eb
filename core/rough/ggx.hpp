#pragma once

namespace irido {

/// Range of roughness supported by rough layers.
inline constexpr double kSmoothest = 1e-4, kRoughest = 1;

/// The isotropic Trowbridge-Reitz (GGX) distribution of microfacet normals, per steradian:
///     D(m) = alpha^2 / (pi (1 - (1 - alpha^2) cos^2 theta_m)^2)
/// Throws DomainError naming the argument.
///   alpha        roughness, [1e-4, 1]
///   cos_theta_m  cosine between the facet's and the surface's normal, [0, 1]
/// Source: FPB24 eq. 18, after B. Walter et al., EGSR 2007, eq. 33.
double ggx_distribution(double alpha, double cos_theta_m);

/// Smith's masking, the fraction of facets visible from a direction: 2 / (1 + sqrt(1 + alpha^2
/// tan^2 theta)); 0 at grazing, consistent with the integral of F_alpha. alpha in [1e-4, 1],
/// cos_theta in [0, 1], else DomainError.
/// Source: FPB24 eq. 19.
double smith_masking(double alpha, double cos_theta);

/// Smith's height-correlated masking and shadowing, the fraction of facets visible from two
/// directions: 1 / (1 + L_i + L_o) with 1 + L = 1/G1. alpha in [1e-4, 1], cosines in [0, 1], else
/// DomainError; 0 if one of the cosines is 0.
/// Source: E. Heitz, JCGT 3(2), 48 (2014), eq. 99.
double smith_masking_shadowing(double alpha, double cos_theta_i, double cos_theta_o);

}  // namespace irido
