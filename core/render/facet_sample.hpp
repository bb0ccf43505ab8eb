#pragma once

#include "core/render/vector3.hpp"

namespace irido {

/// Light that a rough surface sends towards a direction by one facet, its normal drawn among those
/// which the direction sees.
struct FacetSample {
    Vector3 direction;        ///< where that light comes from; may lie below the surface
    double cosine = 1;        ///< of the angle of incidence on the facet
    double visible_part = 0;  ///< G1 of `direction`, 0 below the surface
};

/// A GGX surface of separable masking: the mean of visible_part R(cosine) L(direction) over u and v
/// is the radiance that its BRDF D G1 G1 R / (4 cos cos) reflects.
///   normal  of the surface, towards `to`'s side;  to  the direction, both of unit length
///   alpha   [1e-4, 1];  u, v  in (0, 1)
/// Source: E. Heitz, Sampling the GGX distribution of visible normals, JCGT 7(4), 1 (2018).
FacetSample facet_sample(const Vector3& normal, const Vector3& to, double alpha, double u,
                         double v);

}  // namespace irido
