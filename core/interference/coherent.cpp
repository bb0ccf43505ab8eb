#include "core/interference/coherent.hpp"

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
    Complex kz = m.q2.imag() != 0   ? std::sqrt(m.q2)
                 : m.q2.real() >= 0 ? Complex(std::sqrt(m.q2.real()), 0)
                                    : Complex(0, std::sqrt(-m.q2.real()));
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

Power coherent_power(const Medium& above, std::span<const Element> elements, const Medium& below,
                     std::span<const Medium> media, double k0, Polarization polarization) {
    const Wave in = outgoing_wave(above, polarization);
    const Wave out = outgoing_wave(below, polarization);
    if (in.flux == 0) {
        const bool nothing = same_medium(above, below) && all_same(above, elements, media);
        return nothing ? Power{0, 1, 0} : Power{1, 0, 0};
    }
    Slab slab;
    if (absorbs(elements, media)) {
        slab = slab_of(elements, media, k0, polarization);
    } else {
        slab.matrix = matrix_of(elements, media, k0, polarization);
    }
    // fields at the top, then the incident wave with its Y0 = c/b multiplied through by b
    const Matrix& m = slab.matrix;
    const Complex b = m.a * out.b + m.b * out.c, c = m.c * out.b + m.d * out.c;
    const Complex sum = in.c * b + in.b * c, difference = in.c * b - in.b * c;
    const double incident = std::norm(sum) * in.flux;  // |sum|^2 / (4 |in.b in.c|^2) of its flux
    const double unit = 4 * std::norm(in.b) * std::norm(in.c) / incident;
    Power power;
    power.R = std::norm(difference) / std::norm(sum);
    power.T = unit * out.flux * std::exp(-2 * m.log_scale);
    if (!slab.absorbs) return power;
    power.A = unit * absorbed_flux(slab.absorbed, out) * std::exp(2 * slab.absorbed.log_scale);
    if (std::abs(power.A) > kSubtractable) power.A = 1 - power.R - power.T;
    return power;
}

}  // namespace irido
