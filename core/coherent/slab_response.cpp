#include "core/coherent/slab_response.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/coherent/period.hpp"
#include "core/error.hpp"

namespace irido {

namespace {

/// Below this transmittance an absorbing slab is opaque. Its R then depends on the top layers only,
/// but A on everything multiplied: the fluxes give fewer digits of A, and 1 - R - T more of them
/// where A exceeds kSubtractableIfOpaque.
constexpr double kOpaque = 1e-30, kSubtractableIfOpaque = 1e-4;

Wave wave(const Medium& m, Complex kz, Polarization polarization) {
    if (polarization == Polarization::s) return {1, kz, kz.real()};
    return {kz, m.eps, (std::conj(kz) * m.eps).real()};
}

/// Phase of the damped waves in absorbing layers: sum of Re(delta) b^2/(1 + b^2), b = |Im delta|.
/// It multiplies the denominator by a zero-free factor, so removing it does not move a zero.
double dying_phase(std::span<const Element> elements, std::span<const Medium> media, double k0) {
    double sum = 0;
    for (const Element& element : elements) {
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            const Medium& m = media[layer->material];
            if (!is_lossy(m)) continue;
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

}  // namespace

double times_exp(double x, double exponent) {
    constexpr double kDeepExponent = -400;
    if (exponent > kDeepExponent) return x * std::exp(exponent);
    const double half = std::exp(exponent / 2);
    return x * half * half;
}

Wave outgoing_wave(const Medium& m, Polarization polarization) {
    const Complex kz = square_root(m.q2);
    return wave(m, kz.imag() < 0 ? -kz : kz, polarization);
}

Complex onward_kz(const Medium& m) {
    const Complex kz = square_root(m.q2);
    return m.q2.real() < 0 && kz.imag() < 0 ? -kz : kz;
}

Wave onward_wave(const Medium& m, Polarization polarization) {
    return wave(m, onward_kz(m), polarization);
}

double mixed_power(const Wave& in, Complex r) {
    if (in.flux == 0) return 0;
    const Complex y0 = in.c / in.b;
    return y0.imag() == 0 ? 0 : -2 * (y0.imag() / y0.real()) * r.imag();
}

Complex divisor_of(Complex sum, Complex difference) {
    if (std::norm(sum) > 0) return sum;
    return difference == 0.0 ? 1 : difference;
}

Power balanced(Power power, double mixed, const FluxBalance& flux) {
    power.A += mixed;
    if (flux.at_pole && power.R == 0 && power.T == 0 && power.A == 0) return {1, 0, 0};
    const double sum_of_powers = power.R + power.T + power.A;
    const bool opaque = flux.absorbs && power.T <= kOpaque;
    const bool balances = mixed == 0 && flux.out >= 0 && power.A >= 0 && sum_of_powers > 0;
    if (flux.at_pole ? !balances : !std::isfinite(sum_of_powers))
        throw DomainError("the stack amplifies without bound at this wavelength and angle");
    if (opaque && power.R + power.T <= 1 && power.A > kSubtractableIfOpaque) {
        power.A = 1 - power.R - power.T;
    } else if (balances) {
        power = {power.R / sum_of_powers, power.T / sum_of_powers, power.A / sum_of_powers};
    } else if (std::abs(power.A) > kSubtractable) {
        power.A = 1 - power.R - power.T;
    }
    return power;
}

Response slab_response(const Wave& in, const Slab& slab, const Wave& out) {
    // fields at the top; r = (Y0 b - c)/(Y0 b + c) with Y0 = in.c/in.b, multiplied through by in.b
    const Matrix& m = slab.matrix;
    const Complex b = m.identity() * out.b + (m.a * out.b + m.b * out.c);
    const Complex c = m.identity() * out.c + (m.c * out.b + m.d * out.c);
    const Complex sum = in.c * b + in.b * c, difference = in.c * b - in.b * c;
    Response response{{1, 0, 0}, -1, 0, sum, m.log_scale};
    if (in.flux == 0 && sum == 0.0) return response;
    const Complex divisor = in.flux == 0 ? sum : divisor_of(sum, difference);
    response.denominator = divisor;
    response.r = difference / divisor;
    response.t = 2.0 * in.c * out.b / divisor * m.identity();
    if (in.flux == 0) return response;
    const double unit = 4 * std::norm(in.b) * std::norm(in.c) / (std::norm(divisor) * in.flux);
    Power power{std::norm(difference) / std::norm(divisor),
                times_exp(unit * out.flux, -2 * m.log_scale), 0};
    if (slab.absorbs)
        power.A = times_exp(unit * absorbed_flux(slab.absorbed, out.b, out.c),
                            2 * slab.absorbed.log_scale);
    response.power =
        balanced(power, mixed_power(in, response.r), {slab.absorbs, divisor != sum, out.flux});
    return response;
}

namespace {

/// From wave amplitudes in the medium of `in`; nothing if some layer has none.
std::optional<Response> amplified_response(const Wave& in, std::span<const Element> elements,
                                           const Wave& out, std::span<const Medium> media,
                                           double k0, Polarization polarization) {
    const Matrix m = wave_matrix_of(elements, media, k0, polarization, in.c / in.b);
    const Complex b = out.b / in.b / 2.0, c = out.c / in.c / 2.0, f = b + c, g = b - c;
    const Complex down = m.identity() * f + (m.a * f + m.b * g);
    const Complex up = m.identity() * g + (m.c * f + m.d * g);
    Response response;
    response.r = up / down;
    response.t = out.b / in.b / down * m.identity();
    response.denominator = 2.0 * in.b * in.c * down;
    response.log_scale = m.log_scale;
    response.power.R = std::norm(response.r);
    response.power.T = times_exp(out.flux / (std::norm(down) * in.flux), -2 * m.log_scale);
    response.power.A = 1 - response.power.R - response.power.T;
    if (!std::isfinite(response.power.A)) return std::nullopt;
    return response;
}

}  // namespace

Response coherent_response(const Wave& in, std::span<const Element> elements, const Wave& out,
                           std::span<const Medium> media, double k0, Polarization polarization) {
    const Slab slab = coherent_slab(elements, media, k0, polarization);
    Response response = slab_response(in, slab, out);
    if (slab.absorbs && std::max(response.power.R, response.power.T) > kAmplified) {
        const auto better = amplified_response(in, elements, out, media, k0, polarization);
        if (better) response = *better;
    }
    if (slab.absorbs) response.denominator *= std::polar(1.0, dying_phase(elements, media, k0));
    return response;
}

namespace {

/// exp(log_scale) (b, c)
struct Fields {
    Complex b, c;
    double log_scale = 0;
};

Fields operator*(const Matrix& m, const Fields& v) {
    const double identity = m.identity();
    Fields above{identity * v.b + (m.a * v.b + m.b * v.c), identity * v.c + (m.c * v.b + m.d * v.c),
                 v.log_scale + m.log_scale};
    const double size = std::max(std::abs(above.b), std::abs(above.c));
    if (size > 1e60 || (size < 1e-60 && size > 0)) {
        const int exponent = std::ilogb(size);
        above.b *= std::ldexp(1.0, -exponent);
        above.c *= std::ldexp(1.0, -exponent);
        above.log_scale += exponent * std::log(2.0);
    }
    return above;
}

/// Calls visit(layer) from the last layer to the first, with repetitions expanded.
template <class Visit>
void for_each_layer_upwards(std::span<const Element> elements, const Visit& visit) {
    for (std::size_t i = elements.size(); i-- > 0;) {
        if (const Layer* layer = std::get_if<Layer>(&elements[i].value)) {
            visit(*layer);
            continue;
        }
        const Group& group = std::get<Group>(elements[i].value);
        for (std::uint64_t n = 0; n < group.repeat; ++n)
            for_each_layer_upwards(group.elements, visit);
    }
}

}  // namespace

void coherent_layer_absorption(const Wave& in, std::span<const Element> elements, const Wave& out,
                               std::span<const Medium> media, double k0, Polarization polarization,
                               std::span<double> absorbed) {
    std::ranges::fill(absorbed, 0);
    if (in.flux == 0) return;
    std::vector<double> log_scale(absorbed.size());
    Fields v{out.b, out.c};
    std::size_t at = absorbed.size();
    for_each_layer_upwards(elements, [&](const Layer& layer) {
        const Slab slab = layer_slab(media[layer.material], k0 * layer.thickness_nm, polarization);
        --at;
        if (slab.absorbs) absorbed[at] = absorbed_flux(slab.absorbed, v.b, v.c);
        log_scale[at] = slab.absorbed.log_scale + slab.matrix.log_scale + v.log_scale;
        v = slab.matrix * v;
    });
    const double unit =
        4 * std::norm(in.b) * std::norm(in.c) / (std::norm(in.c * v.b + in.b * v.c) * in.flux);
    for (std::size_t i = 0; i < absorbed.size(); ++i)
        absorbed[i] = times_exp(unit * absorbed[i], 2 * (log_scale[i] - v.log_scale));
}

}  // namespace irido
