#include "core/interference/period.hpp"

#include <algorithm>
#include <cmath>

namespace irido {

namespace {

/// sin(K/2)^2 and cos(K/2)^2 of a period's Bloch phase K.
struct HalfAngle {
    Complex sin2, cos2;
};

/// Where exp(2 |Im K|) passes the digits of a double, only one Bloch wave is left.
constexpr double kLargestLogTrace = 40;

/// cos(z) and sin(z), both times exp(-Im z), for Im z >= 0.
struct ScaledTurn {
    Complex cos, sin;
};

ScaledTurn scaled_turn(Complex z) {
    const double cos_a = std::cos(z.real()), sin_a = std::sin(z.real());
    const double half_less = -std::expm1(-2 * z.imag()) / 2, half_more = 1 - half_less;
    return {{cos_a * half_more, -sin_a * half_less}, {sin_a * half_more, cos_a * half_less}};
}

/// sin K, divided by exp(Im K) as it is given, such that (M - x I)/sin K has determinant 1 to the
/// last digit where that is possible: then so has the power, and energy balances. From
/// -det(M - x I) = traceless^2 + off_diagonal, both without exp(2 m.log_scale); ahead is
/// m.log_scale - Im K. Where those two cancel, the given sine is the better one.
Complex consistent_sine(Complex sine, Complex traceless, Complex off_diagonal, double ahead) {
    const Complex square = -(traceless * traceless + off_diagonal);
    if (std::abs(square) < 0.01 * (std::norm(traceless) + std::abs(off_diagonal))) return sine;
    const Complex root = std::sqrt(square) * std::exp(ahead);
    return std::real(root * std::conj(sine)) < 0 ? -root : root;
}

/// Bloch phase of a two-layer period from Yeh's dispersion relation in factored form,
///     sin(K/2)^2 = F(q) F(1/q),  F(q) = ((1 + q) sin h + (1 - q) sin g)/2
///     cos(K/2)^2 = G(q) G(1/q),  G(q) = ((1 + q) cos h + (1 - q) cos g)/2
/// h = (a + b)/2, g = (a - b)/2, a and b the layers' phases, q the ratio of their admittances: no
/// digits cancel beside a band edge. Source: FPB24 (CGF 43(2), 2024), eqs. 5 to 9.
HalfAngle half_angle_of_pair(Complex a, Complex b, Complex q) {
    const Complex sin_h = std::sin((a + b) / 2.0), cos_h = std::cos((a + b) / 2.0);
    const Complex sin_g = std::sin((a - b) / 2.0), cos_g = std::cos((a - b) / 2.0);
    const Complex p = 1.0 / q;
    return {
        ((1.0 + q) * sin_h + (1.0 - q) * sin_g) * ((1.0 + p) * sin_h + (1.0 - p) * sin_g) / 4.0,
        ((1.0 + q) * cos_h + (1.0 - q) * cos_g) * ((1.0 + p) * cos_h + (1.0 - p) * cos_g) / 4.0};
}

/// The two layers of a Bragg period, or nothing.
struct Pair {
    const Layer* first = nullptr;
    const Layer* second = nullptr;
};

Pair pair_of(std::span<const Element> elements) {
    if (elements.size() != 2) return {};
    return {std::get_if<Layer>(&elements[0].value), std::get_if<Layer>(&elements[1].value)};
}

/// True where the pair's factored form keeps its digits: nothing divides by a vanishing admittance
/// and no exponential is large.
bool is_plain(Complex a, Complex b, Complex q) {
    const double size = std::abs(q);
    return size > 1e-6 && size < 1e6 && std::abs(a.imag()) + std::abs(b.imag()) < 20;
}

/// M - I of layers none of which grows, so that tr(M) - 2 keeps its digits for thin periods.
struct Excess {
    Complex a{}, b{}, c{}, d{};
    bool valid = true;
};

Excess excess_of_layer(const Matrix& m, const Medium& medium, double k0_d) {
    if (m.log_scale != 0) return {.valid = false};
    const Complex half = k0_d / 2 * std::sqrt(medium.q2);
    const Complex sine = std::sin(half);
    const Complex less = -2.0 * sine * sine;  // cos(delta) - 1
    return {less, m.b, m.c, less, true};
}

Excess operator*(const Excess& u, const Excess& l) {
    return {u.a + l.a + u.a * l.a + u.b * l.c, u.b + l.b + u.a * l.b + u.b * l.d,
            u.c + l.c + u.c * l.a + u.d * l.c, u.d + l.d + u.c * l.b + u.d * l.d,
            u.valid && l.valid};
}

HalfAngle half_angle_of_group(const Group& group, const Matrix& matrix,
                              std::span<const Medium> media, double k0, Polarization polarization) {
    if (const Pair pair = pair_of(group.elements); pair.first && pair.second) {
        const Medium& m1 = media[pair.first->material];
        const Medium& m2 = media[pair.second->material];
        const Complex kz1 = std::sqrt(m1.q2), kz2 = std::sqrt(m2.q2);
        const Complex a = k0 * pair.first->thickness_nm * kz1;
        const Complex b = k0 * pair.second->thickness_nm * kz2;
        const Complex q =
            polarization == Polarization::s ? kz2 / kz1 : (kz2 * m1.eps) / (kz1 * m2.eps);
        if (is_plain(a, b, q)) return half_angle_of_pair(a, b, q);
    }
    const Complex half_trace =
        (matrix.a + matrix.d) / 2.0 * std::exp(std::min(matrix.log_scale, 700.0));
    HalfAngle half{(1.0 - half_trace) / 2.0, (1.0 + half_trace) / 2.0};
    Excess excess;
    for (auto element = group.elements.rbegin(); element != group.elements.rend(); ++element) {
        const Layer* layer = std::get_if<Layer>(&element->value);
        if (!layer) return half;
        const double k0_d = k0 * layer->thickness_nm;
        const Medium& m = media[layer->material];
        excess = excess_of_layer(layer_matrix(m, k0_d, polarization), m, k0_d) * excess;
        if (!excess.valid) return half;
    }
    half.sin2 = -(excess.a + excess.d) / 4.0;
    return half;
}

Matrix group_matrix(const Group& group, std::span<const Medium> media, double k0,
                    Polarization polarization) {
    const Matrix m = matrix_of(group.elements, media, k0, polarization);
    if (group.repeat == 1) return m;
    const HalfAngle half = half_angle_of_group(group, m, media, k0, polarization);
    return power(m, half.sin2, half.cos2, group.repeat);
}

/// Where a period absorbs, fields and absorption are raised together by doubling, so that they
/// balance to the last digit: every step adds terms of one sign.
Slab group_slab(const Group& group, std::span<const Medium> media, double k0,
                Polarization polarization) {
    Slab doubled = slab_of(group.elements, media, k0, polarization);
    if (!doubled.absorbs) return {group_matrix(group, media, k0, polarization), {}, false};
    Slab total;
    for (std::uint64_t left = group.repeat; left != 0; left >>= 1) {
        if (left & 1) total = doubled * total;
        if (left > 1) doubled = doubled * doubled;
    }
    return total;
}

/// One layer repeated is a thicker layer.
const Layer* only_layer(const Group& group) {
    return group.elements.size() == 1 ? std::get_if<Layer>(&group.elements[0].value) : nullptr;
}

}  // namespace

Matrix power(const Matrix& m, Complex half_angle_sin2, Complex half_angle_cos2,
             std::uint64_t repeat) {
    const double n = static_cast<double>(repeat);
    const Complex half_trace = (m.a + m.d) / 2.0;
    const double log_trace = std::log(std::abs(half_trace)) + m.log_scale;  // -inf for no trace
    if (log_trace > kLargestLogTrace) {
        // M^N = (2x)^(N-1) M, the other Bloch wave is below the last digit
        const Complex turn = std::polar(1.0, (n - 1) * std::arg(half_trace));
        return {turn * m.a, turn * m.b, turn * m.c, turn * m.d,
                m.log_scale + (n - 1) * (log_trace + std::log(2.0))};
    }
    // M -> -M turns K into pi - K: take the smaller half angle
    const bool flip = std::norm(half_angle_cos2) < std::norm(half_angle_sin2);
    Complex bloch = 2.0 * std::asin(std::sqrt(flip ? half_angle_cos2 : half_angle_sin2));
    if (bloch.imag() < 0) bloch = -bloch;
    const Complex traceless = (m.a - m.d) / 2.0;
    const Complex sine =
        consistent_sine(scaled_turn(bloch).sin, traceless, m.b * m.c, m.log_scale - bloch.imag());
    const ScaledTurn all = scaled_turn(n * bloch);
    // all.cos I has exp(N Im K), ratio (M - x I) has exp((N - 1) Im K + m.log_scale)
    const double ahead = m.log_scale - bloch.imag();
    const Complex ratio = std::norm(n * bloch) < 1e-18 ? n : all.sin / sine;
    const Complex f = (flip ? -1.0 : 1.0) * ratio * std::exp(std::min(0.0, ahead));
    const Complex g = all.cos * std::exp(std::min(0.0, -ahead));
    const double sign = flip && repeat % 2 == 1 ? -1 : 1;
    Matrix result{sign * (g + f * traceless), sign * f * m.b, sign * f * m.c,
                  sign * (g - f * traceless), n * bloch.imag() + std::max(0.0, ahead)};
    normalize(result);
    return result;
}

Matrix matrix_of(std::span<const Element> elements, std::span<const Medium> media, double k0,
                 Polarization polarization) {
    Matrix total;
    for (std::size_t i = elements.size(); i-- > 0;) {
        if (const Layer* layer = std::get_if<Layer>(&elements[i].value)) {
            total = layer_matrix(media[layer->material], k0 * layer->thickness_nm, polarization) *
                    total;
            continue;
        }
        const Group& group = std::get<Group>(elements[i].value);
        if (const Layer* layer = only_layer(group)) {
            const double thickness = layer->thickness_nm * static_cast<double>(group.repeat);
            total = layer_matrix(media[layer->material], k0 * thickness, polarization) * total;
        } else {
            total = group_matrix(group, media, k0, polarization) * total;
        }
    }
    return total;
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

}  // namespace irido
