#include "core/coherent/coherent.hpp"

#include <cmath>
#include <numbers>

#include "core/coherent/slab_response.hpp"
#include "core/error.hpp"
#include "core/math/degrees.hpp"

namespace irido {

namespace {

bool same_medium(const Medium& a, const Medium& b) {
    return a.eps == b.eps && a.q2 == b.q2;
}

bool all_same(const Medium& above, std::span<const Element> elements,
              std::span<const Medium> media) {
    for (const Element& element : elements) {
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            if (layer->thickness_nm > 0 && !same_medium(media[layer->material], above))
                return false;
        } else if (!all_same(above, std::get<Group>(element.value).elements, media)) {
            return false;
        }
    }
    return true;
}

}  // namespace

IncidentAngle::IncidentAngle(double cos_theta)
    : cos(cos_theta), sin(std::sqrt((1 - cos_theta) * (1 + cos_theta))) {}

IncidentAngle incident_angle(double angle_deg) {
    const double cosine = cos_of_incidence(angle_deg);
    const long double degree = std::numbers::pi_v<long double> / 180;
    return {cosine, static_cast<double>(std::sin(angle_deg * degree))};
}

Medium medium(Complex index, double n0, IncidentAngle at) {
    const double n = index.real(), k = index.imag();
    const double along = n0 * at.cos, across = n0 * at.sin;
    const Complex eps{(n - k) * (n + k), 2 * n * k};
    if (at.cos * at.cos > 0.5) return {eps, {eps.real() - across * across, eps.imag()}, eps};
    return {eps, {(n - n0) * (n + n0) - k * k + along * along, eps.imag()}, eps};
}

Medium extraordinary_medium(Complex ordinary, Complex extraordinary, double n0, IncidentAngle at) {
    const Medium o = medium(ordinary, n0, at), e = medium(extraordinary, n0, at);
    const bool is_real = o.eps.imag() == 0 && e.eps.imag() == 0;
    const Complex ratio = is_real ? o.eps.real() / e.eps.real() : o.eps / e.eps;
    return {o.eps, ratio * e.q2, e.eps};
}

double cos_of_incidence(double angle_deg) {
    require_in_range("angle_deg", angle_deg, 0, kLargestAngle_deg);
    return sin_deg(90 - angle_deg);
}

Response coherent_response(const Medium& above, std::span<const Element> elements,
                           const Medium& below, std::span<const Medium> media, double k0,
                           Polarization polarization) {
    const Wave in = outgoing_wave(above, polarization), out = outgoing_wave(below, polarization);
    const bool nothing =
        in.flux == 0 && same_medium(above, below) && all_same(above, elements, media);
    if (nothing) return {{0, 1, 0}, 0, 1};
    return coherent_response(in, elements, out, media, k0, polarization);
}

}  // namespace irido
