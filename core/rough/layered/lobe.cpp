#include "core/rough/layered/lobe.hpp"

#include <cmath>

#include "core/coherent/coherent.hpp"
#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"

namespace irido {

MirrorFacets::MirrorFacets(double theta_i_deg, double theta_o_deg) {
    const IncidentAngle i = incident_angle(theta_i_deg), o = incident_angle(theta_o_deg);
    const double mean = 0.5 * (theta_i_deg + theta_o_deg);
    const double half = 0.5 * (theta_i_deg - theta_o_deg);
    const double sines = 2 * sin_deg(90 - mean) * sin_deg(half);  // sin i - sin o
    const double cosines = -2 * sin_deg(mean) * sin_deg(half);    // cos i - cos o
    sines2_ = sines * sines;
    cosines2_ = cosines * cosines;
    upward2_ = (i.cos + o.cos) * (i.cos + o.cos);
    both_ = 4 * i.sin * o.sin;
    facet_.sin_i = i.sin;
    facet_.cos_i = i.cos;
    facet_.sin_o = o.sin;
    facet_.cos_o = o.cos;
}

MirrorFacet MirrorFacets::operator()(double near, double far) const {
    MirrorFacet facet = facet_;
    const double across = sines2_ + both_ * near * near;
    const double sum2 = across + upward2_;  // |i + o|^2
    const double difference2 = cosines2_ + sines2_ + both_ * far * far;
    facet.theta_d_deg =
        std::fmin(90, std::atan2(std::sqrt(difference2), std::sqrt(sum2)) / kDegree);
    // opposite grazing directions are mirrored by many facets: take the upright one
    facet.sin2 = sum2 > 0 ? across / sum2 : 0;
    facet.cos2 = sum2 > 0 ? upward2_ / sum2 : 1;
    return facet;
}

MirrorFacet mirror_facet(double theta_i_deg, double theta_o_deg, double phi_deg) {
    return MirrorFacets(theta_i_deg, theta_o_deg)(sin_deg(90 - 0.5 * phi_deg),
                                                  sin_deg(0.5 * phi_deg));
}

double visibility(double alpha, double cos_theta, double sin_theta) {
    return 2 /
           (cos_theta + std::sqrt(alpha * alpha * sin_theta * sin_theta + cos_theta * cos_theta));
}

double lobe(double alpha, const MirrorFacet& facet) {
    const double spread = alpha * alpha * facet.cos2 + facet.sin2;
    const double D = alpha * alpha / (kPi * spread * spread);
    return 0.25 * D * visibility(alpha, facet.cos_i, facet.sin_i) *
           visibility(alpha, facet.cos_o, facet.sin_o);
}

}  // namespace irido
