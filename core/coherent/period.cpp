#include "core/coherent/period.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace irido {

namespace {

/// Once exp(2 |Im K|) exceeds the precision of a double, only one Bloch wave is left.
constexpr double kLargestLogTrace = 40;

/// Beyond this N Im K, the smaller diagonal entry of M^N is computed separately.
constexpr double kAttenuated = 1;

/// (sign cos(z) - 1) exp(-log_scale) with log_scale = Im z + rest, rest >= 0; cos_z is cos(z)
/// exp(-Im z). The rest is given because a large Im z would leave few digits of the difference.
Complex without_identity(double sign, Complex z, Complex cos_z, double rest) {
    const double identity = std::exp(-z.imag() - rest);
    if (sign > 0 && z.imag() < 1) {
        const Complex half = std::sin(z / 2.0);
        return -2.0 * half * half * identity;
    }
    return sign * cos_z * std::exp(-rest) - identity;
}

/// The traceless part [[t, b], [c, -t]] of a period: without cos(K) I.
struct Traceless {
    Complex t, b, c;
};

/// The traceless part of a matrix, adjusted so that t^2 + b c equals -sin(K)^2 to the last digit:
/// the power then has determinant 1 and energy balances. The entry adjusted is the one that changes
/// least: t where t^2 is the larger term, else the smaller of b and c.
///   sine2  sin(K)^2 without the matrix's factor exp(2 log_scale)
Traceless traceless_of(const Matrix& m, Complex sine2) {
    Traceless of{(m.a - m.d) / 2.0, m.b, m.c};
    const Complex square = of.t * of.t, product = of.b * of.c;
    const bool upper = std::abs(of.c) > std::abs(of.b);
    const Complex larger = upper ? of.c : of.b;
    if (std::abs(square) > std::abs(product)) {
        const Complex root = std::sqrt(-(sine2 + product));
        of.t = std::real(root * std::conj(of.t)) < 0 ? -root : root;
    } else if (larger != 0.0) {
        (upper ? of.b : of.c) = -(sine2 + square) / larger;
    }
    return of;
}

/// Beyond this exponent a trace overflows; power() switches to another formula long before.
constexpr double kLargestExponent = 700;

/// [[cos, -i beta], [-i gamma, cos]] exp(log_scale)
struct HalfLayer {
    Complex cos, beta, gamma;
    double log_scale;
};

/// Bloch phase of a two-layer period in Yeh's factored form. With P the product of the two
/// half-layer matrices, sin(K/2)^2 = -P12 P21 and cos(K/2)^2 = P11 P22: up to factors that cancel,
/// the four entries of P are F(q), F(1/q), G(q) and G(1/q), whose zeros are the band edges. Nothing
/// cancels near an edge, and nothing is divided by zero at a layer's critical angle.
/// Source: FPB24 (CGF 43(2), 2024), eqs. 5 to 9.
BlochPhase bloch_phase_of_pair(const Layer& upper, const Layer& lower,
                               std::span<const Medium> media, double k0,
                               Polarization polarization) {
    const auto half_of = [&](const Layer& layer) {
        const Medium& m = media[layer.material];
        const LayerTurn turn = layer_turn(m.q2, k0 * layer.thickness_nm / 2);
        const Coupling by = coupling(m, polarization);
        return HalfLayer{turn.cos, by.w * turn.sd, by.v * turn.sd, turn.log_scale};
    };
    const HalfLayer u = half_of(upper), l = half_of(lower);
    const double scale = std::exp(std::min(2 * (u.log_scale + l.log_scale), kLargestExponent));
    const Complex beta = u.cos * l.beta + u.beta * l.cos;
    const Complex gamma = u.cos * l.gamma + u.gamma * l.cos;
    const Complex cosines = u.cos * l.cos;
    return {scale * beta * gamma,
            scale * (cosines - u.beta * l.gamma) * (cosines - u.gamma * l.beta)};
}

/// Bloch phase of any period. Where its matrix is nearly I or -I, sin(K)^2 = -(traceless^2 + b c)
/// retains the digits of K that the trace loses.
BlochPhase bloch_phase_of_matrix(const Matrix& m) {
    const double scale = std::exp(std::min(m.log_scale, kLargestExponent));
    const Complex sin2 = -scale * (m.a + m.d) / 4.0, cos2 = 1.0 - sin2;
    const Complex traceless = scale * (m.a - m.d) / 2.0, b = scale * m.b, c = scale * m.c;
    if (!(std::abs(traceless) + std::abs(b) + std::abs(c) < kNearlyIdentity)) return {sin2, cos2};
    const Complex product = -(traceless * traceless + b * c) / 4.0;
    if (std::norm(cos2) < std::norm(sin2)) return {sin2, product / sin2};
    return {product / cos2, cos2};
}

/// The layer of a group that repeats a single layer: equivalent to one thicker layer.
const Layer* only_layer(const Group& group) {
    return group.elements.size() == 1 ? std::get_if<Layer>(&group.elements[0].value) : nullptr;
}

/// Matrices of the fields (B, C), or of the wave amplitudes in a medium of admittance y0.
struct Matrices {
    std::span<const Medium> media;
    double k0;
    Polarization polarization;
    std::optional<Complex> y0 = std::nullopt;

    Matrix of(const Layer& layer, double thickness_nm) const {
        const Medium& m = media[layer.material];
        return y0 ? wave_matrix(m, k0 * thickness_nm, polarization, *y0)
                  : layer_matrix(m, k0 * thickness_nm, polarization);
    }

    Matrix of(const Group& group) const {
        if (const Layer* layer = only_layer(group))
            return of(*layer, layer->thickness_nm * static_cast<double>(group.repeat));
        const Matrix m = of(group.elements);
        if (group.repeat == 1) return m;
        // the Bloch phase is the same in any basis
        return power(m, bloch_phase(group, m, media, k0, polarization), group.repeat);
    }

    Matrix of(std::span<const Element> elements) const {
        Matrix total;
        for (std::size_t i = elements.size(); i-- > 0;) {
            const Layer* layer = std::get_if<Layer>(&elements[i].value);
            total =
                (layer ? of(*layer, layer->thickness_nm) : of(std::get<Group>(elements[i].value))) *
                total;
        }
        return total;
    }
};

/// The slab with its matrix replaced by a more accurate equal.
Slab with_matrix(const Slab& slab, const Matrix& matrix) {
    Slab result{matrix, slab.absorbed, slab.absorbs};
    result.absorbed.log_scale += slab.matrix.log_scale - matrix.log_scale;
    return result;
}

double size_of(const Matrix& m) {
    return std::abs(m.a) + std::abs(m.b) + std::abs(m.c) + std::abs(m.d);
}

/// An absorbing group: its absorption is summed by repeated doubling, in which all terms have one
/// sign. While light still gets through, the intermediate matrices are closed-form powers; beyond
/// that only the doubled matrices balance the doubled absorption to the last digit. They lose
/// digits of the fields' ratio where a period's trace cancels, and doubling doubles the error of
/// their logarithm; the closed form does neither, and gives both in the end.
Slab group_slab(const Group& group, std::span<const Medium> media, double k0,
                Polarization polarization) {
    const Slab period = slab_of(group.elements, media, k0, polarization);
    if (!period.absorbs) return {Matrices{media, k0, polarization}.of(group), {}, false};
    const BlochPhase bloch = bloch_phase(group, period.matrix, media, k0, polarization);
    const double growth = std::abs((2.0 * std::asin(std::sqrt(bloch.sin2))).imag());
    const bool closed = growth * static_cast<double>(group.repeat) < kLargestLogTrace;
    const auto of_periods = [&](const Slab& slab, std::uint64_t count) {
        return closed ? with_matrix(slab, power(period.matrix, bloch, count)) : slab;
    };
    Slab total, doubled = period;
    std::uint64_t below = 0;
    for (std::uint64_t step = 1; step <= group.repeat; step *= 2) {
        if (group.repeat & step) total = of_periods(doubled * total, below += step);
        if (2 * step <= group.repeat) doubled = of_periods(doubled * doubled, 2 * step);
    }
    if (closed) return total;
    Matrix exact = power(period.matrix, bloch, group.repeat);
    const double factor = size_of(total.matrix) / size_of(exact);
    for (Complex* entry : {&exact.a, &exact.b, &exact.c, &exact.d}) *entry *= factor;
    exact.log_scale -= std::log(factor);
    total.matrix = exact;
    return total;
}

bool absorbs(std::span<const Element> elements, std::span<const Medium> media) {
    for (const Element& element : elements) {
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            if (is_lossy(media[layer->material])) return true;
        } else if (absorbs(std::get<Group>(element.value).elements, media)) {
            return true;
        }
    }
    return false;
}

}  // namespace

BlochPhase bloch_phase(const Group& group, const Matrix& matrix, std::span<const Medium> media,
                       double k0, Polarization polarization) {
    if (group.elements.size() == 2) {
        const Layer* upper = std::get_if<Layer>(&group.elements[0].value);
        const Layer* lower = std::get_if<Layer>(&group.elements[1].value);
        if (upper && lower) return bloch_phase_of_pair(*upper, *lower, media, k0, polarization);
    }
    return bloch_phase_of_matrix(matrix);
}

Matrix power(const Matrix& m, const BlochPhase& bloch, std::uint64_t repeat) {
    const double n = static_cast<double>(repeat);
    const Complex half_trace = (m.a + m.d) / 2.0 + m.identity();
    const double log_trace = std::log(std::abs(half_trace)) + m.log_scale;  // -inf for a zero trace
    if (log_trace > kLargestLogTrace) {
        // M^N = (2x)^(N-1) M; the other Bloch wave is below rounding
        const Complex turn = std::polar(1.0, (n - 1) * std::arg(half_trace));
        return {turn * (m.a + m.identity()), turn * m.b, turn * m.c, turn * (m.d + m.identity()),
                m.log_scale + (n - 1) * (log_trace + std::log(2.0))};
    }
    // M -> -M turns K into pi - K: take the smaller half angle
    const bool flip = std::norm(bloch.cos2) < std::norm(bloch.sin2);
    Complex k = 2.0 * std::asin(std::sqrt(flip ? bloch.cos2 : bloch.sin2));
    if (k.imag() < 0) k = -k;
    const double ahead = m.log_scale - k.imag();
    const Complex sine = scaled_turn(k).sin, scaled_sine = sine * std::exp(-ahead);
    const Traceless of = traceless_of(m, scaled_sine * scaled_sine);
    const ScaledTurn all = scaled_turn(n * k);
    const Complex ratio = std::norm(n * k) < 1e-18 ? n : all.sin / sine;
    // cos(N K) I grows as exp(N Im K), ratio (M - x I) as exp((N - 1) Im K + m.log_scale)
    const double sign = flip && repeat % 2 == 1 ? -1 : 1;
    const Complex f = (flip ? -sign : sign) * ratio * std::exp(std::min(0.0, ahead));
    const double rest_ahead = std::max(0.0, ahead);
    Matrix result{f * of.t, f * of.b, f * of.c, -f * of.t, n * k.imag() + rest_ahead};
    const Complex diagonal = without_identity(sign, n * k, all.cos, rest_ahead);
    result.a += diagonal;
    result.d += diagonal;
    if (n * k.imag() > kAttenuated) {
        // exp(i N K) + ratio (sigma - |t|), sigma = -i sin K: neither term cancels
        const Complex sigma = Complex(0, -1) * scaled_sine;
        const bool below = std::real(of.t * std::conj(sigma)) > 0;  // the smaller entry
        const Complex rest = of.b * of.c / (sigma + (below ? of.t : -of.t));
        (below != flip ? result.d : result.a) =
            sign * std::exp(Complex(0, 1) * (n * k) - result.log_scale) +
            (flip ? -1.0 : 1.0) * f * rest - result.identity();
    }
    normalize(result);
    return result;
}

Matrix matrix_of(std::span<const Element> elements, std::span<const Medium> media, double k0,
                 Polarization polarization) {
    return Matrices{media, k0, polarization}.of(elements);
}

Matrix wave_matrix_of(std::span<const Element> elements, std::span<const Medium> media, double k0,
                      Polarization polarization, Complex y0) {
    return Matrices{media, k0, polarization, y0}.of(elements);
}

Slab slab_of(std::span<const Element> elements, std::span<const Medium> media, double k0,
             Polarization polarization) {
    Slab total;
    for (std::size_t i = elements.size(); i-- > 0;) {
        if (const Layer* layer = std::get_if<Layer>(&elements[i].value)) {
            total =
                layer_slab(media[layer->material], k0 * layer->thickness_nm, polarization) * total;
            continue;
        }
        const Group& group = std::get<Group>(elements[i].value);
        Slab slab;
        if (const Layer* layer = only_layer(group)) {
            const double thickness = layer->thickness_nm * static_cast<double>(group.repeat);
            slab = layer_slab(media[layer->material], k0 * thickness, polarization);
        } else {
            slab = group_slab(group, media, k0, polarization);
        }
        total = slab * total;
    }
    return total;
}

Slab coherent_slab(std::span<const Element> elements, std::span<const Medium> media, double k0,
                   Polarization polarization) {
    if (absorbs(elements, media)) return slab_of(elements, media, k0, polarization);
    return {matrix_of(elements, media, k0, polarization), {}, false};
}

}  // namespace irido
