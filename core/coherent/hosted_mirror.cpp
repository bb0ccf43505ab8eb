#include "core/coherent/hosted_mirror.hpp"

#include <algorithm>
#include <cmath>

namespace irido {

namespace {

/// Half of |b| beyond which an evanescent layer is left to the general kernel and its logarithms.
constexpr double kLargestHalfExponent = 150;

/// Stands in for an exact zero of kz, so that sin(k0 d kz)/kz becomes k0 d.
constexpr double kTinyIndex = 1e-140;

/// The element as a layer of that material, or null.
const Layer* layer_of(const Element& element, std::size_t material) {
    const Layer* layer = std::get_if<Layer>(&element.value);
    return layer && layer->material == material ? layer : nullptr;
}

/// Recognizes the periods themselves.
std::optional<HostedMirror> mirror_of(const Group& group, std::size_t host) {
    if (group.elements.size() != 2) return std::nullopt;
    for (const std::size_t place : {0U, 1U}) {
        const Layer* of_host = layer_of(group.elements[place], host);
        const Layer* other = std::get_if<Layer>(&group.elements[1 - place].value);
        if (of_host && other && other->material != host)
            return HostedMirror{host, other->material, of_host->thickness_nm, other->thickness_nm,
                                group.repeat};
    }
    return std::nullopt;
}

std::span<const Element> without_ends_of(std::size_t host, std::span<const Element> elements) {
    while (!elements.empty() && layer_of(elements.front(), host)) elements = elements.subspan(1);
    while (!elements.empty() && layer_of(elements.back(), host))
        elements = elements.first(elements.size() - 1);
    return elements;
}

/// 1/q, q and q - 1/q of the other layer, without the i of evanescent ones.
struct Admittances {
    double inverse, ratio, contrast;
};
Admittances admittances(double eps1, double q2_1, double eps2, double q2_2, Polarization p) {
    const double kz1 = std::sqrt(q2_1);
    const double kz2 = std::max(std::sqrt(std::abs(q2_2)), kTinyIndex);
    const double signed_kz2 = std::copysign(kz2, q2_2);
    // q - 1/q, from differences that do not cancel at any angle
    const double s = (eps2 - eps1) / (kz1 * kz2);
    if (p == Polarization::s) return {kz1 / kz2, signed_kz2 / kz1, s};
    const double ratio = eps2 * kz1 / eps1;
    const double brewster = q2_1 + q2_1 * eps2 / eps1 - eps1;
    return {signed_kz2 / ratio, ratio / kz2, s * brewster / eps2};
}

}  // namespace

std::optional<HostedMirror> hosted_mirror(std::span<const Element> elements, std::size_t incident,
                                          std::size_t substrate) {
    if (incident != substrate) return std::nullopt;
    const std::span<const Element> inside = without_ends_of(incident, elements);
    const auto place = std::ranges::find_if(inside, [](const Element& element) {
        return std::holds_alternative<Group>(element.value);
    });
    if (place == inside.end() || inside.size() > 2) return std::nullopt;
    const Group& group = std::get<Group>(place->value);
    std::optional<HostedMirror> mirror = mirror_of(group, incident);
    if (!mirror) return std::nullopt;
    mirror->is_whole = elements.size() == 1;
    if (inside.size() == 1) return mirror;
    // the one extra layer must be on the side where the group starts with the host
    const bool above = place != inside.begin();
    const Layer* more = layer_of(above ? inside.front() : inside.back(), mirror->other);
    const Element& end = above ? group.elements.front() : group.elements.back();
    if (!more || more->thickness_nm != mirror->other_nm || !layer_of(end, incident))
        return std::nullopt;
    ++mirror->repeat;
    return mirror;
}

std::optional<Power> mirror_power(const HostedMirror& mirror, const Medium& host,
                                  const Medium& other, double k0, Polarization polarization) {
    const double q2_1 = host.q2.real(), q2_2 = other.q2.real();
    if (host.eps.imag() != 0 || other.eps.imag() != 0 || !(q2_1 > 0)) return std::nullopt;
    const Admittances m = admittances(host.eps.real(), q2_1, other.eps.real(), q2_2, polarization);
    const double half_a = k0 * mirror.host_nm * std::sqrt(q2_1) / 2;
    const double kz2 = std::max(std::sqrt(std::abs(q2_2)), kTinyIndex);
    const double half_b = k0 * mirror.other_nm * kz2 / 2;
    if (q2_2 < 0 && half_b > kLargestHalfExponent) return std::nullopt;
    const double sin_a = std::sin(half_a), cos_a = std::cos(half_a);
    const double sin_b = q2_2 < 0 ? std::sinh(half_b) : std::sin(half_b);
    const double cos_b = q2_2 < 0 ? std::cosh(half_b) : std::cos(half_b);

    const double straight = sin_a * cos_b, crossed = cos_a * sin_b;
    const double both_cos = cos_a * cos_b, both_sin = sin_a * sin_b;
    const double sin2 = (m.ratio * crossed + straight) * (m.inverse * crossed + straight);
    const double cos2 = (both_cos - m.ratio * both_sin) * (both_cos - m.inverse * both_sin);
    const double small = std::min(sin2, cos2);  // negative in gaps
    const bool band = small >= 0;
    const double root = std::sqrt(std::abs(small));
    const double sine = 2 * root * std::sqrt(1 - small);
    const auto n = static_cast<double>(mirror.repeat);
    const double nk = n * 2 * (band ? std::asin(root) : std::asinh(root));
    const double e = band ? 1 : std::exp(-2 * nk);
    const double wave = band ? std::sin(nk) : -std::expm1(-2 * nk) / 2;  // sqrt(e) sin(NK)
    const double U = nk < 1e-9 ? n : wave / sine;
    const double Z = std::pow(m.contrast * sin_b * cos_b * U, 2);
    if (!std::isfinite(Z) || e + Z == 0) return std::nullopt;
    return Power{Z / (e + Z), e / (e + Z), 0};
}

}  // namespace irido
