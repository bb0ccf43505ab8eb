#include "core/coherent/fringe_mean.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/coherent/period.hpp"
#include "core/coherent/slab_response.hpp"

namespace irido {

namespace {

/// Beyond this exponent of attenuation only a period's decaying Bloch wave is left.
constexpr double kOpaqueExponent = 40;

/// Below this growth per period, the sign of a wave's flux tells which wave travels down.
constexpr double kTransparentGrowth = 1e-9;

/// Distance in radians of the phase from a gap edge at which R and T blend into their means, and
/// the softness of the blend: it contains frequencies as high as w's only to exp(-kSoftness^2/4).
constexpr double kPassage = 40, kSoftness = 8, kFarPassage = 5;

/// Cap on the round-trip coefficient, which reaches 1 at a band edge.
constexpr double kMostBounce = 1 - 1e-12;

/// Tangential fields, up to a common factor.
struct FieldPair {
    Complex b, c;
    double flux() const { return (std::conj(b) * c).real(); }
};

FieldPair operator*(const Matrix& m, const FieldPair& v) {
    return {m.identity() * v.b + (m.a * v.b + m.b * v.c),
            m.identity() * v.c + (m.c * v.b + m.d * v.c)};
}

Complex cross(const FieldPair& u, const FieldPair& v) {
    return u.b * v.c - u.c * v.b;
}

/// The two Bloch waves of an element, and how one period advances them.
struct Waves {
    FieldPair down, up;
    double phase = 0, growth = 0;  ///< real and imaginary part of K, per period
    double from_edge = std::numeric_limits<double>::infinity();  ///< |K| or |pi - K|
    /// exp(log_scale) edges = sin(K)^2 (1 + cos(K)^2): zero at gap edges and, in the complex plane,
    /// close to narrow bands.
    Complex edges{1};
    double log_scale = 0;
    double repeat = 1;
};

Waves waves_of(const Layer& layer, double repeat, std::span<const Medium> media, double k0,
               Polarization polarization) {
    const Wave wave = onward_wave(media[layer.material], polarization);
    const Complex delta = k0 * layer.thickness_nm * onward_kz(media[layer.material]);
    return {.down = {wave.b, wave.c},
            .up = {wave.b, -wave.c},
            .phase = delta.real(),
            .growth = delta.imag(),
            .repeat = repeat};
}

/// Eigenvector of the traceless matrix [[t, b], [c, -t]] for the eigenvalue s.
FieldPair eigenvector(Complex t, Complex b, Complex c, Complex s) {
    if (std::norm(s - t) > std::norm(s + t)) return {b, s - t};
    return {s + t, c};
}

Waves waves_of(const Group& group, std::span<const Medium> media, double k0,
               Polarization polarization) {
    const Matrix m = matrix_of(group.elements, media, k0, polarization);
    const BlochPhase half = bloch_phase(group, m, media, k0, polarization);
    const Complex cosine = (m.a + m.d) / 2.0 + m.identity(), traceless = (m.a - m.d) / 2.0;
    Waves waves;
    waves.repeat = static_cast<double>(group.repeat);
    const double one = m.identity() * m.identity();
    Complex sine2 = one - cosine * cosine;
    const double log_trace = std::log(2 * std::abs(cosine)) + m.log_scale;
    Complex grows = cosine;  // exp(-i K) - cos K of the downward wave
    if (log_trace > kOpaqueExponent) {
        waves.growth = log_trace;
    } else {
        const bool flip = std::norm(half.cos2) < std::norm(half.sin2);
        const Complex k = 2.0 * std::asin(std::sqrt(flip ? half.cos2 : half.sin2));
        waves.phase = flip ? std::numbers::pi - k.real() : k.real();
        waves.growth = std::abs(k.imag());
        waves.from_edge = std::abs(k);
        sine2 = 4.0 * half.sin2 * half.cos2 * one;
        grows = square_root(-sine2);
    }
    waves.edges = sine2 * (one + cosine * cosine);
    waves.log_scale = 4 * m.log_scale;
    const auto of = [&](Complex s) { return eigenvector(traceless, m.b, m.c, s); };
    const bool by_flux = waves.growth < kTransparentGrowth;
    const bool swapped =
        by_flux ? of(grows).flux() < of(-grows).flux() : std::real(grows * std::conj(cosine)) < 0;
    if (swapped) grows = -grows;
    waves.down = of(grows);
    waves.up = of(-grows);
    return waves;
}

Waves waves_of(const Element& element, std::span<const Medium> media, double k0,
               Polarization polarization) {
    if (const Layer* layer = std::get_if<Layer>(&element.value))
        return waves_of(*layer, 1, media, k0, polarization);
    const Group& group = std::get<Group>(element.value);
    if (group.elements.size() == 1)
        if (const Layer* layer = std::get_if<Layer>(&group.elements[0].value))
            return waves_of(*layer, static_cast<double>(group.repeat), media, k0, polarization);
    return waves_of(group, media, k0, polarization);
}

}  // namespace

FringeMean fringe_mean(const Stack& stack, std::size_t fast, std::span<const Medium> media,
                       double k0, Polarization polarization) {
    const std::span<const Element> elements = stack.elements;
    const Matrix above = matrix_of(elements.first(fast), media, k0, polarization);
    const Matrix below = matrix_of(elements.subspan(fast + 1), media, k0, polarization);
    const Waves waves = waves_of(elements[fast], media, k0, polarization);
    const Wave in = outgoing_wave(media.back(), polarization);
    const Wave out = outgoing_wave(media[stack.substrate], polarization);
    const auto incident = [&](const FieldPair& v) { return (v.b / in.b + v.c / in.c) / 2.0; };
    const auto reflected = [&](const FieldPair& v) { return (v.b / in.b - v.c / in.c) / 2.0; };

    FringeMean mean;
    mean.phase = 2 * waves.repeat * waves.phase;
    const Matrix others = above * below;
    mean.denominator = waves.edges * incident(others * FieldPair{out.b, out.c});
    mean.log_scale = waves.log_scale + others.log_scale;

    // the factors exp(log_scale) of above and below are left out
    const FieldPair down = above * waves.down, up = above * waves.up;
    const FieldPair bottom = below * FieldPair{out.b, out.c};
    const Complex area = cross(waves.down, waves.up);
    const double attenuation = std::exp(-2 * waves.repeat * waves.growth);
    const double Z = std::abs(cross(waves.down, bottom) / cross(bottom, waves.up)) * attenuation;
    const double enters = std::norm(incident(down));
    const double q = std::min(kMostBounce, std::abs(incident(up) / incident(down)) * Z);
    const double rest = (1 - q) * (1 + q);
    const double r0 = std::abs(reflected(down) / incident(down));
    const double X =
        Z * std::exp(-2 * above.log_scale) * std::abs(area / (2.0 * in.b * in.c)) / enters;
    mean.R = std::min(1.0, r0 * r0 + X * X / rest);
    const double log_T = -2 * (above.log_scale + below.log_scale);
    mean.T = std::min(1.0, out.flux / in.flux * attenuation * std::exp(log_T) * std::norm(area) /
                               (std::norm(cross(bottom, waves.up)) * enters * rest));
    mean.swing_R = std::min(1.0, 2 * (r0 * X + X * X * q / rest) / (1 - q));
    mean.swing_T = std::min(1.0, 2 * mean.T * q / (1 - q));
    const double edge = 2 * waves.repeat * waves.from_edge;
    if (edge > kPassage + kFarPassage * kSoftness) return mean;
    const double share = std::erfc((edge - kPassage) / kSoftness) / 2;
    const Matrix all = matrix_of(elements, media, k0, polarization);
    const FieldPair top = all * FieldPair{out.b, out.c};
    const double R = std::norm(reflected(top) / incident(top));
    const double T = out.flux / in.flux * std::exp(-2 * all.log_scale) / std::norm(incident(top));
    mean.R += share * (R - mean.R);
    mean.T += share * (T - mean.T);
    mean.swing_R *= 1 - share;
    mean.swing_T *= 1 - share;
    return mean;
}

}  // namespace irido
