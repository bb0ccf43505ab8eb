#include "core/rough/layered/coating.hpp"

#include <algorithm>
#include <cmath>

#include "core/coherent/coherent.hpp"
#include "core/coherent/fresnel.hpp"
#include "core/math/constants.hpp"

namespace irido {

namespace {

/// Light in n1 meeting n2; kz in units of k0.
Coating::Crossing crossing(double n1, double n2, double cos1, double sin1) {
    const double kz1 = n1 * cos1, S = n1 * sin1;
    const double square = (n2 - n1) * (n2 + n1) + kz1 * kz1;  // kz2^2
    if (square <= 0) return {90, 1, 0};
    const Ray<double> a{n1 * n1, kz1}, b{n2 * n2, std::sqrt(square)};
    const double difference = (n1 - n2) * (n1 + n2);
    const FresnelFace<double> s = fresnel_s(a, b, difference);
    const FresnelFace<double> p = fresnel_p(a, b, difference, S * S);
    return {std::atan2(S, b.kz) / kDegree, 0.5 * (s.r * s.r + p.r * p.r), 0.5 * (s.T + p.T)};
}

}  // namespace

Coating::Coating(double n_outside, double n_inside)
    : n_outside_(n_outside), n_inside_(n_inside), ratio_(n_outside / n_inside) {
    top_deg_ = ratio_ < 1 ? std::asin(ratio_) / kDegree : 90;
}

Coating::Crossing Coating::inward(double theta_deg) const {
    if (!is_there()) return {theta_deg, 0, 1};
    const IncidentAngle at = incident_angle(theta_deg);
    Crossing result = crossing(n_outside_, n_inside_, at.cos, at.sin);
    result.theta_deg = std::min(result.theta_deg, ratio_ < 1 ? top_deg_ : 90.0);
    return result;
}

Coating::Crossing Coating::outward(double theta_deg) const {
    if (!is_there()) return {theta_deg, 0, 1};
    const IncidentAngle at = incident_angle(theta_deg);
    return crossing(n_inside_, n_outside_, at.cos, at.sin);
}

double Coating::outward_transmittance(double cos_theta) const {
    if (!is_there()) return 1;
    return crossing(n_inside_, n_outside_, cos_theta, std::sqrt((1 - cos_theta) * (1 + cos_theta)))
        .T;
}

}  // namespace irido
