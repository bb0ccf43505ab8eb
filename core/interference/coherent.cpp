#include "core/interference/coherent.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/interference/period.hpp"

namespace irido {

namespace {

/// Amplitudes of a medium's one wave, B : C, up to a common factor, and its flux Re(conj(B) C).
struct Wave {
    Complex b, c;
    double flux;
};

/// The wave that travels or decays away from the stack: Im(kz) > 0, or Re(kz) > 0 where it is real.
Wave outgoing_wave(const Medium& m, Polarization polarization) {
    Complex kz = square_root(m.q2);
    if (kz.imag() < 0) kz = -kz;
    if (polarization == Polarization::s) return {1, kz, kz.real()};
    return {kz, m.eps, (std::conj(kz) * m.eps).real()};
}

bool same_medium(const Medium& a, const Medium& b) {
    return a.eps == b.eps;
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

bool absorbs(std::span<const Element> elements, std::span<const Medium> media) {
    for (const Element& element : elements) {
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            if (media[layer->material].eps.imag() != 0) return true;
        } else if (absorbs(std::get<Group>(element.value).elements, media)) {
            return true;
        }
    }
    return false;
}

/// Phase of the waves that absorbing layers let die away, sum of Re(delta) b^2/(1 + b^2), b = |Im
/// delta|: what it turns in the denominator has no zeros and reaches nobody.
double dying_phase(std::span<const Element> elements, std::span<const Medium> media, double k0) {
    double sum = 0;
    for (const Element& element : elements) {
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            const Medium& m = media[layer->material];
            if (m.eps.imag() == 0) continue;
            const Complex delta = k0 * layer->thickness_nm * std::sqrt(m.q2);
            const double b2 = delta.imag() * delta.imag();
            sum += std::copysign(delta.real(), delta.imag() * delta.real()) * b2 / (1 + b2);
        } else {
            const Group& group = std::get<Group>(element.value);
            sum += static_cast<double>(group.repeat) * dying_phase(group.elements, media, k0);
        }
    }
    return sum;
}

/// An absorption above this loses nothing as 1 - R - T.
constexpr double kSubtractable = 0.01;

double absorbed_flux(const AbsorbedPower& q, const Wave& v) {
    return q.bb * std::norm(v.b) + q.cc * std::norm(v.c) + 2 * (std::conj(v.b) * q.bc * v.c).real();
}

}  // namespace

Medium medium(Complex index, double n0, double cos_theta) {
    const double n = index.real(), k = index.imag();
    const double along = n0 * cos_theta;
    return {{(n - k) * (n + k), 2 * n * k},
            {(n - n0) * (n + n0) - k * k + along * along, 2 * n * k}};
}

double cos_of_incidence(double angle_deg) {
    require_in_range("angle_deg", angle_deg, 0, kLargestAngle_deg);
    return std::sin((90 - angle_deg) * (std::numbers::pi / 180));
}

Response coherent_response(const Medium& above, std::span<const Element> elements,
                           const Medium& below, std::span<const Medium> media, double k0,
                           Polarization polarization) {
    const Wave in = outgoing_wave(above, polarization);
    const Wave out = outgoing_wave(below, polarization);
    if (in.flux == 0) {
        const bool nothing = same_medium(above, below) && all_same(above, elements, media);
        return {nothing ? Power{0, 1, 0} : Power{1, 0, 0}};
    }
    Slab slab;
    if (absorbs(elements, media)) {
        slab = slab_of(elements, media, k0, polarization);
    } else {
        slab.matrix = matrix_of(elements, media, k0, polarization);
    }
    // fields at the top; r = (Y0 b - c)/(Y0 b + c) with Y0 = in.c/in.b multiplied through
    const Matrix& m = slab.matrix;
    const Complex b = m.identity() * out.b + (m.a * out.b + m.b * out.c);
    const Complex c = m.identity() * out.c + (m.c * out.b + m.d * out.c);
    const Complex sum = in.c * b + in.b * c, difference = in.c * b - in.b * c;
    const double unit = 4 * std::norm(in.b) * std::norm(in.c) / (std::norm(sum) * in.flux);
    Response response{{}, sum, m.log_scale};
    Power& power = response.power;
    power.R = std::norm(difference) / std::norm(sum);
    power.T = unit * out.flux * std::exp(-2 * m.log_scale);
    if (!slab.absorbs && out.flux >= 0) power.R = std::min(power.R, 1.0);  // 1 + a rounding
    if (slab.absorbs) {
        response.denominator *= std::polar(1.0, dying_phase(elements, media, k0));
        power.A = unit * absorbed_flux(slab.absorbed, out) * std::exp(2 * slab.absorbed.log_scale);
    }
    // an absorbing medium above mixes the incident and the reflected wave's power
    if (const Complex y0 = in.c / in.b; y0.imag() != 0)
        power.A -= 2 * (y0.imag() / y0.real()) * (difference / sum).imag();
    if (std::abs(power.A) > kSubtractable) power.A = 1 - power.R - power.T;
    if (!std::isfinite(power.R + power.T + power.A))
        throw DomainError("the stack amplifies without bound at this wavelength and angle");
    return response;
}

}  // namespace irido
