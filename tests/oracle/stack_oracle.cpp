#include "tests/oracle/stack_oracle.hpp"

#include <algorithm>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <vector>

#include "tests/oracle/legendre.hpp"

namespace irido::oracle {

namespace {

using Digits100 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>,
                                                boost::multiprecision::et_off>;

template <class Real>
struct Cx {
    Real re{}, im{};
};
template <class R>
Cx<R> operator+(const Cx<R>& a, const Cx<R>& b) {
    return {a.re + b.re, a.im + b.im};
}
template <class R>
Cx<R> operator-(const Cx<R>& a, const Cx<R>& b) {
    return {a.re - b.re, a.im - b.im};
}
template <class R>
Cx<R> operator*(const Cx<R>& a, const Cx<R>& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
template <class R>
R norm(const Cx<R>& a) {
    return a.re * a.re + a.im * a.im;
}
template <class R>
Cx<R> operator/(const Cx<R>& a, const Cx<R>& b) {
    const R n = norm(b);
    return {(a.re * b.re + a.im * b.im) / n, (a.im * b.re - a.re * b.im) / n};
}
template <class R>
Cx<R> scaled(const Cx<R>& a, const R& f) {
    return {a.re * f, a.im * f};
}

/// kz of the wave that decays (or, where nothing decays, travels) away.
template <class R>
Cx<R> outgoing_root(const Cx<R>& z) {
    using std::abs;
    using std::sqrt;
    if (z.im == 0) return z.re >= 0 ? Cx<R>{sqrt(z.re), R(0)} : Cx<R>{R(0), sqrt(-z.re)};
    const R modulus = sqrt(norm(z));
    if (z.re >= 0) {
        const R u = sqrt((modulus + z.re) / 2), v = z.im / (2 * u);
        return v >= 0 ? Cx<R>{u, v} : Cx<R>{-u, -v};
    }
    const R v = sqrt((modulus - z.re) / 2);
    return {z.im / (2 * v), v};
}

/// Shifts numbers by up to half an ulp each, or not at all.
class Shaker {
public:
    explicit Shaker(std::uint64_t seed) : state_(seed), active_(seed != 0) {}
    template <class R>
    R operator()(const R& x) {
        if (!active_) return x;
        state_ = state_ * 6364136223846793005U + 1442695040888963407U;
        const double u = static_cast<double>(state_ >> 11) * 0x1p-52 - 1;
        return x * (1 + R(u * 0x1p-53));
    }

private:
    std::uint64_t state_;
    bool active_;
};

template <class R>
struct MediumOf {
    Cx<R> eps, q2;
};

template <class R>
struct MatrixOf {
    Cx<R> a{R(1), R(0)}, b{}, c{}, d{R(1), R(0)};
    R log_scale{0};
};

template <class R>
R power_of_two(const R& x, int exponent) {
    using std::ldexp;
    return ldexp(x, exponent);
}

template <class R>
MatrixOf<R> product(const MatrixOf<R>& u, const MatrixOf<R>& l) {
    using std::abs;
    using std::frexp;
    using std::max;
    MatrixOf<R> m{u.a * l.a + u.b * l.c, u.a * l.b + u.b * l.d, u.c * l.a + u.d * l.c,
                  u.c * l.b + u.d * l.d, u.log_scale + l.log_scale};
    R largest(0);
    for (const Cx<R>* entry : {&m.a, &m.b, &m.c, &m.d})
        for (const R* part : {&entry->re, &entry->im})
            if (abs(*part) > largest) largest = abs(*part);
    int exponent = 0;
    frexp(largest, &exponent);
    if (std::abs(exponent) < 100) return m;
    const R factor = power_of_two(R(1), -exponent);
    for (Cx<R>* entry : {&m.a, &m.b, &m.c, &m.d}) *entry = scaled(*entry, factor);
    m.log_scale += R(exponent) * boost::math::constants::ln_two<R>();
    return m;
}

/// A stack at one wavelength, angle and polarization.
template <class R>
struct Evaluation {
    Polarization polarization;
    R k0;
    std::vector<MediumOf<R>> media;
    Shaker shake{0};
    std::vector<R> extra_phase;  ///< of the incoherent layers, in order
    std::size_t next_phase = 0;

    /// Admittance C : B of the wave that goes with kz.
    std::array<Cx<R>, 2> wave(const MediumOf<R>& m, const Cx<R>& kz) const {
        if (polarization == Polarization::s) return {Cx<R>{R(1), R(0)}, kz};
        return {kz, m.eps};
    }

    /// D P D^-1 with D = [[B, B], [C, -C]] of the two waves: fields at the lower face to the upper.
    MatrixOf<R> of_layer(const Layer& layer, const R& repeat) {
        using std::cos;
        using std::expm1;
        using std::sin;
        const MediumOf<R>& m = media[layer.material];
        Cx<R> q2 = m.q2;
        // at kz = 0 the two waves are one; a shift far below the last digit of a double parts them
        if (q2.re == 0 && q2.im == 0) q2.re = R(sizeof(R) > 16 ? 1e-80 : 1e-30);
        const Cx<R> kz = outgoing_root(q2);
        const R k0_d = k0 * shake(R(layer.thickness_nm)) * repeat;
        R phase = k0_d * kz.re;
        const R decay = k0_d * kz.im;
        if (!layer.coherent && next_phase < extra_phase.size()) phase += extra_phase[next_phase++];
        // going up by d multiplies the downward wave by exp(-i kz d) and the upward one by its
        // inverse; mean and half difference of the two, divided by exp(decay)
        const R less = -R(expm1(-2 * decay)) / 2, more = 1 - less;
        const Cx<R> mean{cos(phase) * more, -sin(phase) * less};
        const Cx<R> half{cos(phase) * less, -sin(phase) * more};
        const auto [b, c] = wave(m, kz);
        return {mean, half * b / c, half * c / b, mean, decay};
    }

    MatrixOf<R> of(std::span<const Element> elements) {
        MatrixOf<R> total;
        for (const Element& element : elements) {
            if (const Layer* layer = std::get_if<Layer>(&element.value)) {
                total = product(total, of_layer(*layer, R(1)));
                continue;
            }
            const Group& group = std::get<Group>(element.value);
            MatrixOf<R> square = of(group.elements);
            for (std::uint64_t left = group.repeat; left != 0; left >>= 1) {
                if (left & 1) total = product(total, square);
                if (left > 1) square = product(square, square);
            }
        }
        return total;
    }

    std::array<R, 2> reflected_and_transmitted(const MediumOf<R>& above,
                                               std::span<const Element> elements,
                                               const MediumOf<R>& below) {
        using std::exp;
        next_phase = 0;
        const MatrixOf<R> m = of(elements);
        const auto [b_in, c_in] = wave(above, outgoing_root(above.q2));
        const auto [b_out, c_out] = wave(below, outgoing_root(below.q2));
        const Cx<R> b = m.a * b_out + m.b * c_out, c = m.c * b_out + m.d * c_out;
        // (b, c) = t^-1 { (b_in, c_in) + r (b_in, -c_in) }
        const Cx<R> incident = scaled(b / b_in + c / c_in, R(0.5));
        const Cx<R> reflected = scaled(b / b_in - c / c_in, R(0.5));
        const auto flux = [](const Cx<R>& x, const Cx<R>& y) { return x.re * y.re + x.im * y.im; };
        return {
            norm(reflected) / norm(incident),
            flux(b_out, c_out) / (norm(incident) * flux(b_in, c_in)) * R(exp(-2 * m.log_scale))};
    }
};

template <class R>
Cx<R> square(const R& n, const R& k) {
    return {n * n - k * k, 2 * n * k};
}

/// A whole stack: its media from indices that core's materials give, the rest from scratch.
template <class R>
struct StackEvaluation {
    const Stack& stack;
    Evaluation<R> evaluation;
    MediumOf<R> above;

    StackEvaluation(const Stack& s, const Query& query, std::uint64_t seed)
        : stack(s), evaluation{query.polarization, R(0), {}, Shaker(seed), {}, 0} {
        using std::sin;
        Shaker& shake = evaluation.shake;
        const R pi = boost::math::constants::pi<R>();
        evaluation.k0 = 2 * pi / shake(R(query.wavelength_nm));
        const R cosine = shake(R(sin((90 - R(query.angle_deg)) * pi / 180)));
        std::vector<std::array<R, 2>> index;
        for (const Material& material : stack.materials) {
            const Complex value = index_at(material, query.wavelength_nm);
            index.push_back({shake(R(value.real())), shake(R(value.imag()))});
        }
        const R n0 = index[stack.incident][0];
        const auto with_q2 = [&](const R& n, const R& k) {
            const Cx<R> eps = square(n, k);
            const R along = n0 * cosine;
            return MediumOf<R>{eps, {(n - n0) * (n + n0) - k * k + along * along, eps.im}};
        };
        for (const auto& [n, k] : index) evaluation.media.push_back(with_q2(n, k));
        above = with_q2(n0, R(0));
    }

    std::array<R, 2> operator()(std::span<const Element> elements) {
        return evaluation.reflected_and_transmitted(above, elements,
                                                    evaluation.media[stack.substrate]);
    }
};

template <class R>
Power as_power(const std::array<R, 2>& rt) {
    return {static_cast<double>(rt[0]), static_cast<double>(rt[1]),
            static_cast<double>(R(1 - rt[0] - rt[1]))};
}

using Extended = long double;
using Mean = std::array<Extended, 2>;

/// Mean over a turn of each incoherent layer's phase.
Mean phase_mean(StackEvaluation<Extended>& stack, std::span<const Element> elements, int points,
                std::vector<Extended>& phases, std::size_t layer) {
    if (layer == phases.size()) {
        stack.evaluation.extra_phase = phases;
        return stack(elements);
    }
    Mean sum{};
    for (int i = 0; i < points; ++i) {
        phases[layer] = boost::math::constants::pi<Extended>() * static_cast<Extended>(i) /
                        static_cast<Extended>(points);
        const Mean one = phase_mean(stack, elements, points, phases, layer + 1);
        for (std::size_t k = 0; k < 2; ++k) sum[k] += one[k] / static_cast<Extended>(points);
    }
    return sum;
}

Mean phase_mean(StackEvaluation<Extended>& stack, std::span<const Element> elements, int points) {
    const auto count = std::ranges::count_if(elements, [](const Element& element) {
        const Layer* layer = std::get_if<Layer>(&element.value);
        return layer && !layer->coherent;
    });
    std::vector<Extended> phases(static_cast<std::size_t>(count));
    return phase_mean(stack, elements, points, phases, 0);
}

Layer* first_spread(std::vector<Element>& elements) {
    for (Element& element : elements) {
        if (Layer* layer = std::get_if<Layer>(&element.value)) {
            if (layer->thickness_sigma_nm > 0) return layer;
        } else if (Layer* inside = first_spread(std::get<Group>(element.value).elements)) {
            return inside;
        }
    }
    return nullptr;
}

Mean spread_mean(StackEvaluation<Extended>& stack, std::vector<Element> elements, int panels,
                 int points) {
    Layer* layer = first_spread(elements);
    if (!layer) return phase_mean(stack, elements, points);
    static const LegendreRule<Extended> rule(20);
    const double mean = layer->thickness_nm, sigma = layer->thickness_sigma_nm;
    layer->thickness_sigma_nm = 0;
    const double first = std::max(-8.0, -mean / sigma), width = (8 - first) / panels;
    Mean sum{};
    Extended total = 0;
    for (int panel = 0; panel < panels; ++panel) {
        for (std::size_t i = 0; i < rule.x.size(); ++i) {
            const double z = first + width * (panel + 0.5 * (1 + static_cast<double>(rule.x[i])));
            const Extended weight = rule.weight[i] * std::exp(-Extended(z) * z / 2);
            layer->thickness_nm = mean + z * sigma;
            const Mean one = spread_mean(stack, elements, panels, points);
            for (std::size_t k = 0; k < 2; ++k) sum[k] += weight * one[k];
            total += weight;
        }
    }
    for (Extended& value : sum) value /= total;
    return sum;
}

double relative(double a, double b) {
    return b == 0 ? std::abs(a) : std::abs((a - b) / b);
}

}  // namespace

Power coherent(const Stack& stack, const Query& query, std::uint64_t seed) {
    return as_power(StackEvaluation<Digits100>(stack, query, seed)(stack.elements));
}

Power coherent(const Medium& above, std::span<const Element> elements, const Medium& below,
               std::span<const Medium> media, double k0, Polarization polarization,
               std::uint64_t seed) {
    using R = Digits100;
    Evaluation<R> evaluation{polarization, R(k0), {}, Shaker(seed), {}, 0};
    const auto convert = [&](const Medium& m) {
        Shaker& shake = evaluation.shake;
        return MediumOf<R>{{shake(R(m.eps.real())), shake(R(m.eps.imag()))},
                           {shake(R(m.q2.real())), shake(R(m.q2.imag()))}};
    };
    for (const Medium& m : media) evaluation.media.push_back(convert(m));
    const auto converted_above = convert(above), converted_below = convert(below);
    return as_power(
        evaluation.reflected_and_transmitted(converted_above, elements, converted_below));
}

Power coherent_fast(const Stack& stack, const Query& query) {
    return as_power(StackEvaluation<double>(stack, query, 0)(stack.elements));
}

Scatter scatter(const Stack& stack, const Query& query, int draws) {
    const Power exact = coherent(stack, query);
    Scatter result;
    for (int i = 1; i <= draws; ++i) {
        const Power shifted = coherent(stack, query, static_cast<std::uint64_t>(i) * 7919);
        result.R = std::max(result.R, std::abs(shifted.R - exact.R));
        result.T = std::max(result.T, relative(shifted.T, exact.T));
        result.A = std::max(result.A, relative(shifted.A, exact.A));
    }
    return result;
}

Power incoherent(const Stack& stack, const Query& query, int points) {
    StackEvaluation<Extended> evaluation(stack, query, 0);
    return as_power(phase_mean(evaluation, stack.elements, points));
}

Power spread(const Stack& stack, const Query& query, int panels, int points) {
    StackEvaluation<Extended> evaluation(stack, query, 0);
    return as_power(spread_mean(evaluation, stack.elements, panels, points));
}

}  // namespace irido::oracle
