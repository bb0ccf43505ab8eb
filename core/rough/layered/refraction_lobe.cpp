#include "core/rough/layered/refraction_lobe.hpp"

#include <algorithm>
#include <cmath>

#include "core/coherent/coherent.hpp"
#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"
#include "core/rough/layered/lobe.hpp"

namespace irido {

RefractingFacet refracting_facet(double n_i, double n_o, double theta_i_deg, double theta_o_deg,
                                 double phi_deg) {
    const IncidentAngle i = incident_angle(theta_i_deg), o = incident_angle(theta_o_deg);
    const double near = sin_deg(90 - 0.5 * phi_deg), far = sin_deg(0.5 * phi_deg);
    const double between = i.sin * o.sin * (near * near - far * far) - i.cos * o.cos;  // i.o
    const double across = n_i * i.sin - n_o * o.sin;
    const double flat2 = across * across + 4 * n_i * n_o * i.sin * o.sin * near * near;
    const double up = n_o * o.cos - n_i * i.cos;
    RefractingFacet facet;
    facet.length2 = flat2 + up * up;
    if (!(facet.length2 > 0)) return facet;
    const double length = (up < 0 ? -1 : 1) * std::sqrt(facet.length2);
    facet.cos_i = -(n_i + n_o * between) / length;
    facet.cos_o = (n_o + n_i * between) / length;
    facet.sin2 = flat2 / facet.length2;
    facet.cos2 = up * up / facet.length2;
    facet.is_there = up != 0 && facet.cos_i > 0 && facet.cos_o > 0;
    facet.theta_deg = std::acos(std::clamp(facet.cos_i, 0.0, 1.0)) / kDegree;
    return facet;
}

double refraction_lobe(double alpha, double n_o, double theta_i_deg, double theta_o_deg,
                       const RefractingFacet& facet) {
    if (!facet.is_there) return 0;
    const IncidentAngle i = incident_angle(theta_i_deg), o = incident_angle(theta_o_deg);
    const double spread = alpha * alpha * facet.cos2 + facet.sin2;
    const double D = alpha * alpha / (kPi * spread * spread);
    return facet.cos_i * facet.cos_o * n_o * n_o * D * visibility(alpha, i.cos, i.sin) *
           visibility(alpha, o.cos, o.sin) / facet.length2;
}

}  // namespace irido
