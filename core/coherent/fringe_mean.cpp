#include "core/coherent/fringe_mean.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

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

/// Least 1 - |q|^2 of a round-trip coefficient q, which reaches 1 at a band edge.
constexpr double kLeastRest = 2e-12;

/// Share of a blend that is left out.
constexpr double kNegligible = 1e-11;

/// Points on the circle of w1 from which harmonics are taken.
constexpr std::size_t kPoints = 32;

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
    /// Real part of K per period, with the sign of the wave that travels down, and imaginary part.
    double phase = 0, growth = 0;
    double from_edge = std::numeric_limits<double>::infinity();  ///< |K| or |pi - K|
    /// exp(log_scale) edges = sin(K)^2 (1 + cos(K)^2): zero at gap edges and, in the complex plane,
    /// close to narrow bands.
    Complex edges{1};
    double log_scale = 0;
    double repeat = 1;
    double wrapped = 0;  ///< of FringeForm
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
    waves.wrapped = 4 * std::numbers::pi * waves.repeat;
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
    if ((cosine + grows).imag() > 0) waves.phase = -waves.phase;  // exp(-i K)
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

/// Fields that depend on w, v[0] + w v[1].
using SwingingFields = std::array<FieldPair, 2>;

/// A fast element with the fields `v` at its lower face: those at its upper face, up to the factor
/// exp(-i N K) / cross(down, up).
SwingingFields above_of(const Waves& waves, const FieldPair& v) {
    const Complex down = cross(v, waves.up), up = cross(waves.down, v);
    const double attenuation = std::exp(-2 * waves.repeat * waves.growth);
    const Complex weak = attenuation * up;
    return {FieldPair{down * waves.down.b, down * waves.down.c},
            FieldPair{weak * waves.up.b, weak * waves.up.c}};
}

/// Share of R and T at the element's own phase in their means.
double own_share(const Waves& waves) {
    const double edge = 2 * waves.repeat * waves.from_edge;
    if (edge > kPassage + kFarPassage * kSoftness) return 0;
    return std::erfc((edge - kPassage) / kSoftness) / 2;
}

/// Both outer waves, the matrices between fast elements from above, and the waves of these.
struct Parts {
    Wave in, out;
    std::array<Matrix, 3> between;
    std::array<Waves, 2> waves;
    std::size_t fast = 0;
};

Parts parts_of(const Stack& stack, std::span<const std::size_t> fast, std::span<const Medium> media,
               double k0, Polarization polarization) {
    Parts parts{outgoing_wave(media.back(), polarization),
                outgoing_wave(media[stack.substrate], polarization),
                {},
                {},
                fast.size()};
    const std::span<const Element> elements = stack.elements;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < fast.size(); ++i) {
        parts.between.at(i) =
            matrix_of(elements.subspan(begin, fast[i] - begin), media, k0, polarization);
        parts.waves.at(i) = waves_of(elements[fast[i]], media, k0, polarization);
        begin = fast[i] + 1;
    }
    parts.between.at(fast.size()) = matrix_of(elements.subspan(begin), media, k0, polarization);
    return parts;
}

FringeForm form_of(const Parts& parts) {
    const Wave &in = parts.in, &out = parts.out;
    const auto& between = parts.between;
    const auto& waves = parts.waves;
    const std::size_t fast = parts.fast;
    FringeForm form;
    const auto set = [&](std::size_t i, const FieldPair& v) {
        form.incident.at(i) = (v.b / in.b + v.c / in.c) / 2.0;
        form.reflected.at(i) = (v.b / in.b - v.c / in.c) / 2.0;
    };
    double log_scale = 0, T = out.flux / in.flux;
    Matrix others = between.at(fast);
    for (std::size_t i = 0; i < fast; ++i) {
        form.turn.at(i) = 2 * waves.at(i).repeat * waves.at(i).phase;
        form.wrapped.at(i) = waves.at(i).wrapped;
        form.own.at(i) = own_share(waves.at(i));
        form.log_scale += waves.at(i).log_scale;
        form.denominator *= waves.at(i).edges;
        T *= std::exp(-2 * waves.at(i).repeat * waves.at(i).growth) *
             std::norm(cross(waves.at(i).down, waves.at(i).up));
        others = between.at(fast - 1 - i) * others;
    }
    for (std::size_t i = 0; i <= fast; ++i) log_scale += between.at(i).log_scale;
    form.through = times_exp(T, -2 * log_scale);
    const FieldPair through = others * FieldPair{out.b, out.c};
    form.denominator *= (through.b / in.b + through.c / in.c) / 2.0;
    form.log_scale += others.log_scale;

    const FieldPair bottom = between.at(fast) * FieldPair{out.b, out.c};
    if (fast == 0) {
        set(0, bottom);
        return form;
    }
    // the matrices have determinant 1 with exp(log_scale), which is left out here
    const double top = std::exp(-2 * between[0].log_scale) / (2 * std::abs(in.b * in.c));
    const SwingingFields lower = above_of(waves.at(fast - 1), bottom);
    if (fast == 1) {
        for (std::size_t i = 0; i < 2; ++i) set(i, between[0] * lower.at(i));
        form.swing_1 = top * std::abs(cross(lower[0], lower[1]));
        return form;
    }
    const double area = std::abs(cross(waves[0].down, waves[0].up));
    for (std::size_t i = 0; i < 2; ++i) {
        const SwingingFields upper = above_of(waves[0], between[1] * lower.at(i));
        for (std::size_t j = 0; j < 2; ++j) set(2 * i + j, between[0] * upper.at(j));
        if (i == 0) form.swing_1 = top * std::abs(cross(upper[0], upper[1]));
    }
    form.swing_2 = top * std::exp(-2 * between[1].log_scale) * std::abs(cross(lower[0], lower[1])) *
                   area * area * std::exp(-2 * waves[0].repeat * waves[0].growth);
    return form;
}

/// Means over all phases of a form.
FringeMean mean_of(const FringeForm& form) {
    const auto& p = form.incident;
    const double p0 = std::norm(p[0]), u2 = std::min(std::norm(p[1] / p[0]), 1 - kLeastRest);
    const double alpha = p0 + std::norm(p[1]) - std::norm(p[2]) - std::norm(p[3]);
    const Complex beta = std::conj(p[0]) * p[1] - std::conj(p[2]) * p[3];
    const double square = form.swing_2 > 0
                              ? (alpha - 2 * std::abs(beta)) * (alpha + 2 * std::abs(beta))
                              : std::pow(p0 * (1 - u2), 2);
    const double root = std::sqrt(std::max(square, std::pow(kLeastRest * alpha, 2)));
    const double kappa = (alpha + root) / 2;
    const Complex u = p[1] / p[0], v = beta / kappa;
    FringeMean mean;
    const double r0 = std::abs(form.reflected[0] / p[0]), X = form.swing_1 / p0;
    mean.R = r0 * r0 + X * X / (1 - u2);
    if (form.swing_2 > 0) {
        // the mean of 1/|(1 + u w)(1 + v w)|^2
        const double v2 = std::norm(v);
        mean.R += form.swing_2 * form.swing_2 / (p0 * kappa) * (1 - u2 * v2) /
                  ((1 - u2) * (root / kappa) * std::norm(1.0 - u * std::conj(v)));
    }
    mean.R = std::min(mean.R, 1.0);  // of NaN, NaN
    // behind what is opaque, cavities without loss have no mean, and no light
    if (form.through > 0) mean.T = std::min(form.through / root, 1.0);
    const double q = std::sqrt(u2);
    mean.swing_R = std::min(1.0, 2 * (r0 * X + X * X * q / (1 - u2)) / (1 - q));
    mean.swing_T = std::min(1.0, 2 * mean.T * q / (1 - q));
    return mean;
}

/// exp(2 pi i j/kPoints)
const std::array<Complex, kPoints>& circle() {
    static const auto points = [] {
        std::array<Complex, kPoints> all;
        for (std::size_t j = 0; j < kPoints; ++j)
            all.at(j) = std::polar(
                1.0, 2 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(kPoints));
        return all;
    }();
    return points;
}

}  // namespace

FringeForm fringe_form(const Stack& stack, std::span<const std::size_t> fast,
                       std::span<const Medium> media, double k0, Polarization polarization) {
    return form_of(parts_of(stack, fast, media, k0, polarization));
}

FringeMean fringe_mean(const Stack& stack, std::span<const std::size_t> fast,
                       std::span<const Medium> media, double k0, Polarization polarization) {
    const FringeForm form = fringe_form(stack, fast, media, k0, polarization);
    FringeMean mean;
    mean.form = form;
    // bit i of a set is 1 where the phase of fast[i] is averaged
    for (unsigned set = 0; set < 1U << fast.size(); ++set) {
        double weight = 1;
        std::vector<std::size_t> averaged;
        for (std::size_t i = 0; i < fast.size(); ++i) {
            const bool is_averaged = (set >> i & 1U) != 0;
            weight *= is_averaged ? 1 - form.own.at(i) : form.own.at(i);
            if (is_averaged) averaged.push_back(fast[i]);
        }
        if (weight < kNegligible) continue;
        const bool is_whole = averaged.size() == fast.size();
        const FringeMean part =
            mean_of(is_whole ? form : fringe_form(stack, averaged, media, k0, polarization));
        mean.R += weight * part.R;
        mean.T += weight * part.T;
        if (!is_whole || fast.size() != 1) continue;
        mean.swing_R = weight * part.swing_R;
        mean.swing_T = weight * part.swing_T;
    }
    return mean;
}

FringeHarmonics::Wave FringeHarmonics::wave(std::size_t h) {
    const int i = static_cast<int>(h);
    if (i < kMost) return {i + 1, 0};
    const int width = 2 * kMost + 1;
    return {(i - kMost) % width - kMost, (i - kMost) / width + 1};
}

FringeHarmonics fringe_harmonics(const FringeForm& form, std::size_t elements) {
    FringeHarmonics result;
    const auto& p = form.incident;
    const auto& s = form.reflected;
    // r = r0 + X w/(1 + q w): harmonics of |r|^2 and of 1/|1 + q w|^2, which is 1/(1 - |q|^2) times
    // 1 + 2 Re sum (-q w)^m
    struct Swing {
        Complex q, R;
        double rest;
    };
    const auto swing = [](Complex s0, Complex s1, Complex p0, Complex p1) {
        const Complex q = p1 / p0, r0 = s0 / p0, X = s1 / p0 - q * r0;
        const double rest = std::max(1 - std::norm(q), kLeastRest);
        return Swing{q, 2.0 * (std::conj(r0) * X - q * std::norm(X) / rest), rest};
    };
    if (elements == 1) {
        const Swing of = swing(s[0], s[1], p[0], p[1]);
        const double T = form.through / std::norm(p[0]) / of.rest;
        Complex power = 1 - form.own[0];
        for (std::size_t h = 0; h < FringeHarmonics::kOfOne; ++h) {
            result.R.at(h) = power * of.R;
            power *= -of.q;
            result.T.at(h) = 2.0 * power * T;
        }
        return result;
    }
    const auto n = static_cast<double>(kPoints);
    for (std::size_t j = 0; j < kPoints; ++j) {
        const Complex w1 = circle()[j];
        const Complex p0 = p[0] + p[1] * w1, s0 = s[0] + s[1] * w1;
        const Swing of = swing(s0, s[2] + s[3] * w1, p0, p[2] + p[3] * w1);
        const double norm = std::norm(p0);
        // of w2^m2, each with its share of the sum over w1
        std::array<Complex, FringeHarmonics::kMost + 1> R{}, T{};
        Complex power = 2 / n;
        const double mean_T = form.through / norm / of.rest;
        R[0] = power * (std::norm(s0) + std::pow(form.swing_2, 2) / norm / of.rest) / norm;
        T[0] = power * mean_T;
        for (std::size_t m = 1; m < R.size(); ++m) {
            R.at(m) = power / 2.0 * of.R;
            power *= -of.q;
            T.at(m) = power * mean_T;
        }
        for (std::size_t h = 0; h < FringeHarmonics::kOfTwo; ++h) {
            const auto [m1, m2] = FringeHarmonics::wave(h);
            const Complex back = std::conj(
                circle()[static_cast<std::size_t>((m1 + static_cast<int>(kPoints))) * j % kPoints]);
            result.R.at(h) += R.at(static_cast<std::size_t>(m2)) * back;
            result.T.at(h) += T.at(static_cast<std::size_t>(m2)) * back;
        }
    }
    for (std::size_t h = 0; h < FringeHarmonics::kOfTwo; ++h) {
        const auto [m1, m2] = FringeHarmonics::wave(h);
        const double kept = (m1 != 0 ? form.own[0] : 1) * (m2 != 0 ? form.own[1] : 1);
        result.R.at(h) *= 1 - kept;
        result.T.at(h) *= 1 - kept;
    }
    return result;
}

}  // namespace irido
