#pragma once

#include "core/render/vector3.hpp"

namespace irido {

/// Reflection by a rough surface from one direction towards another: GGX facets with separable
/// masking, BRDF D G1 G1 R / (4 cos cos).
struct FacetLight {
    double cosine = 1;        ///< of the angle of incidence on the facets concerned
    double density = 0;       ///< of facet_direction(), per steradian: D G1 / (4 cos)
    double visible_part = 0;  ///< G1 of the light, 0 below the surface; times density and R the
                              ///< BRDF times the light's cosine
};

///   normal  of the surface;  to  where the light goes, above the surface;  from  where it comes
///           from, all of unit length
///   alpha   [1e-4, 1]
FacetLight facet_light(const Vector3& normal, const Vector3& to, const Vector3& from, double alpha);

/// Direction of incidence mirrored by a random facet visible from `to`; it may lie below the
/// surface.
///   normal  of the surface, of unit length
///   to      where the light goes, of unit length, above the surface
///   alpha   roughness, [1e-4, 1]
///   u, v    random numbers in (0, 1)
/// Source: E. Heitz, Sampling the GGX distribution of visible normals, JCGT 7(4), 1 (2018).
Vector3 facet_direction(const Vector3& normal, const Vector3& to, double alpha, double u, double v);

}  // namespace irido
