#pragma once

#include <array>

#include "core/scratch/cosine_series.hpp"
#include "core/scratch/light.hpp"

namespace irido {

/// D G1 G1/(4 cos theta_i cos theta_o) of GGX facets, per steradian: their BRDF but for the
/// reflectance; 0 at and below the horizon. alpha [1e-4, 1], else DomainError.
double facet_brdf(double alpha, const UnitVector& light, const UnitVector& view);

/// Cosines of theta_d that a view and the directions of a light have.
CosineRange half_cosines(const LightCone& light, const UnitVector& view);

/// What facets of any reflectance R(cos theta_d) reflect of an area light, over its radiance,
///     int facet_brdf R cos theta_i dw = sum over CosineSeries::nodes(range) of weight R(node),
/// to 1e-7 of the sum of weights for an R that the series holds. Over the light, w = (tau, r sin
/// psi, r cos psi) with tau across the plane of incidence, dw = dtau dpsi, in panels that grow with
/// their distance from the mirror direction, halved along tau until they agree.
///   alpha  [1e-4, 1], else DomainError;  range  half_cosines() of both
using FacetWeights = std::array<double, CosineSeries::kCount>;
FacetWeights facet_weights(double alpha, const LightCone& light, const UnitVector& view,
                           const CosineRange& range);

}  // namespace irido
