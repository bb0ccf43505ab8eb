#pragma once

#include <algorithm>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/truth/reference.hpp"

/// Textbook transfer matrices for any real type: the implementation behind reference.hpp, in parts
/// that tests can recombine. Shares no formula with the kernel. Internal.
/// Source: P. Yeh, Optical Waves in Layered Media (1988), section 5.1: D P D^-1 of the forward and
/// the backward wave, kz on an explicit branch; groups by repeated squaring.
namespace irido::textbook {

template <unsigned digits>
using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<digits>,
                                             boost::multiprecision::et_off>;

template <class R>
struct Cx {
    R re{}, im{};
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
/// Re(conj(a) b)
template <class R>
R dot(const Cx<R>& a, const Cx<R>& b) {
    return a.re * b.re + a.im * b.im;
}
/// -i a
template <class R>
Cx<R> turned(const Cx<R>& a) {
    return {a.im, -a.re};
}

template <class R>
R power_of_two(std::int64_t exponent) {
    using std::ldexp;
    constexpr std::int64_t kFarAway = 1000000000;
    return ldexp(R(1), static_cast<int>(std::clamp(exponent, -kFarAway, kFarAway)));
}

/// kz of the outgoing wave: decaying or, without decay, travelling.
template <class R>
Cx<R> outgoing_root(const Cx<R>& z) {
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

/// Perturbs inputs by a few 2^-53 of themselves.
class Shift {
public:
    static Shift none() { return {}; }
    /// Random perturbation of each input by up to half an ulp; seed 0 leaves them unchanged.
    static Shift random(std::uint64_t seed) {
        Shift shift;
        shift.state_ = seed;
        return shift;
    }
    /// That many 2^-53, so that all q2 and all phases increase (decrease if negative).
    static Shift along(double roundings) {
        Shift shift;
        shift.along_ = roundings * 0x1p-53;
        return shift;
    }

    /// up() for inputs that increase q2 and phases, down() for those that decrease them.
    template <class R>
    R up(const R& x) {
        return moved(x, along_);
    }
    template <class R>
    R down(const R& x) {
        return moved(x, -along_);
    }

private:
    template <class R>
    R moved(const R& x, double along) {
        if (state_ == 0) return along == 0 ? x : x * (1 + R(along));
        state_ = state_ * 6364136223846793005U + 1442695040888963407U;
        const double u = static_cast<double>(state_ >> 11) * 0x1p-52 - 1;
        return x * (1 + R(u * 0x1p-53));
    }

    std::uint64_t state_ = 0;
    double along_ = 0;
};

/// A medium at one angle; n, k, n0^2 cos^2, n0^2 sin^2 serve the derivatives of eps and q2.
template <class R>
struct MediumOf {
    Cx<R> eps, q2, kz;
    R n{}, k{}, along2{}, across2{};
};

template <class R>
MediumOf<R> medium_of(const Cx<R>& eps, const Cx<R>& q2) {
    return {eps, q2, outgoing_root(q2)};
}

/// [[a, b], [c, d]] 2^exponent
template <class R>
struct MatrixOf {
    Cx<R> a{R(1), R(0)}, b{}, c{}, d{R(1), R(0)};
    std::int64_t exponent = 0;
};

template <class R>
MatrixOf<R> normalized(MatrixOf<R> m) {
    using std::abs;
    using std::frexp;
    constexpr int kLargePower = 100;
    R largest(0);
    for (const Cx<R>* entry : {&m.a, &m.b, &m.c, &m.d})
        for (const R* part : {&entry->re, &entry->im})
            if (abs(*part) > largest) largest = abs(*part);
    int power = 0;
    frexp(largest, &power);
    if (std::abs(power) < kLargePower) return m;
    const R factor = power_of_two<R>(-power);
    for (Cx<R>* entry : {&m.a, &m.b, &m.c, &m.d}) *entry = scaled(*entry, factor);
    m.exponent += power;
    return m;
}

template <class R>
MatrixOf<R> operator*(const MatrixOf<R>& u, const MatrixOf<R>& l) {
    return normalized(MatrixOf<R>{u.a * l.a + u.b * l.c, u.a * l.b + u.b * l.d,
                                  u.c * l.a + u.d * l.c, u.c * l.b + u.d * l.d,
                                  u.exponent + l.exponent});
}

template <class R>
MatrixOf<R> operator+(const MatrixOf<R>& u, const MatrixOf<R>& l) {
    const std::int64_t common = std::max(u.exponent, l.exponent);
    const R f = power_of_two<R>(u.exponent - common), g = power_of_two<R>(l.exponent - common);
    const auto sum = [&](const Cx<R>& x, const Cx<R>& y) { return scaled(x, f) + scaled(y, g); };
    return {sum(u.a, l.a), sum(u.b, l.b), sum(u.c, l.c), sum(u.d, l.d), common};
}

template <class R>
MatrixOf<R> transposed(const MatrixOf<R>& m) {
    return {m.a, m.c, m.b, m.d, m.exponent};
}

/// Propagation through a layer, phase = kz d: cos and -i sin of it, divided by exp(decay).
template <class R>
struct Turn {
    const MediumOf<R>* medium;
    R k0_d, decay;
    Cx<R> phase, mean, half;
};

/// Fields B and C of the wave with that kz.
template <class R>
struct WaveOf {
    Cx<R> b, c;
    R flux() const { return dot(b, c); }
};

template <class R>
WaveOf<R> wave(const MediumOf<R>& m, Polarization polarization) {
    if (polarization == Polarization::s) return {{R(1), R(0)}, m.kz};
    return {m.kz, m.eps};
}

/// Coherent layers between two half-spaces at one wavelength and angle.
template <class R>
class Transfer {
public:
    /// From the stack's own inputs, perturbed; indices are taken from its materials.
    ///   stack          layers and half-spaces
    ///   wavelength_nm  in vacuum, [1, 1e7]
    ///   angle_deg      [0, 90)
    ///   shift          perturbation of the inputs
    Transfer(const Stack& stack, double wavelength_nm, double angle_deg,
             Shift shift = Shift::none())
        : shift_(shift) {
        using std::sin;
        const R& pi = boost::math::constants::pi<R>();
        k0_ = 2 * pi / shift_.down(R(wavelength_nm));
        const R cosine = shift_.up(R(sin((90 - R(angle_deg)) * pi / 180)));
        std::vector<std::array<R, 2>> index;
        for (std::size_t m = 0; m < stack.materials.size(); ++m) {
            const Complex value = index_at(stack.materials[m], wavelength_nm);
            const R n(value.real()), k(value.imag());
            index.push_back({m == stack.incident ? shift_.down(n) : shift_.up(n), shift_.up(k)});
        }
        const R n0 = index[stack.incident][0];
        for (const auto& [n, k] : index) media_.push_back(indexed_medium(n, k, n0, cosine));
        above_ = indexed_medium(n0, R(0), n0, cosine);
        below_ = media_[stack.substrate];
        add_layer_media();
    }

    /// From media as the kernel takes them, eps and q2 exact.
    ///   above, below  half-spaces
    ///   media         one per material of the stack
    ///   k0            2 pi / wavelength, 1/nm, > 0
    Transfer(const Medium& above, const Medium& below, std::span<const Medium> media, double k0)
        : k0_(k0), above_(converted(above)), below_(converted(below)) {
        for (const Medium& m : media) media_.push_back(converted(m));
        add_layer_media();
    }

    Transfer(const Transfer&) = delete;
    Transfer& operator=(const Transfer&) = delete;

    /// Sets the current layers, which must outlive their use. `extra_phases` are added to the
    /// phases of incoherent layers, in order.
    void set_layers(std::span<const Element> elements, std::span<const R> extra_phases = {}) {
        elements_ = elements;
        turns_.clear();
        add_turns(elements, extra_phases);
    }

    /// R and T
    std::array<R, 2> powers(Polarization polarization) const {
        using std::exp;
        const Fields f = fields(polarization);
        return {norm(f.reflected) / norm(f.incident),
                f.out.flux() / (norm(f.incident) * f.in.flux()) * squared_scale(f)};
    }

    /// Whether that many roundings of 2^-53 could move the substrate across its critical angle,
    /// where powers have an infinite, square-root slope. (Layers have no such points.)
    bool is_near_branch_point(double roundings) const {
        using std::abs;
        const MediumOf<R>& m = below_;
        const R reach = R(roundings * 0x1p-53) * (m.n * m.n + m.k * m.k + m.along2 + m.across2);
        return abs(m.q2.re) < reach && abs(m.q2.im) < reach;
    }

    /// Condition numbers as defined in reference.hpp.
    Condition condition(Polarization polarization) const {
        return Derivatives(*this, polarization).sum();
    }

    /// x times the derivatives of R and of ln T with respect to every input x, in this order: for
    /// every layer (one in a group counts once) thickness, wavelength, n, k, n0 and cos(theta); for
    /// the substrate n, k, n0 and cos(theta); for the incident medium n0 and cos(theta).
    std::vector<std::array<R, 2>> slopes(Polarization polarization) const {
        Derivatives derivatives(*this, polarization);
        derivatives.sum();
        return derivatives.all();
    }

private:
    struct Fields {
        WaveOf<R> in, out;
        MatrixOf<R> matrix;
        R decay;
        Cx<R> b, c;                 ///< at the top, without the matrix's exponents
        Cx<R> incident, reflected;  ///< amplitudes in units of `in`, likewise
    };

    static MediumOf<R> indexed_medium(const R& n, const R& k, const R& n0, const R& cosine) {
        const R along2 = n0 * n0 * cosine * cosine;
        const Cx<R> eps{n * n - k * k, 2 * n * k};
        MediumOf<R> m = medium_of<R>(eps, Cx<R>{(n - n0) * (n + n0) - k * k + along2, eps.im});
        m.n = n;
        m.k = k;
        m.along2 = along2;
        m.across2 = n0 * n0 - along2;
        return m;
    }

    static MediumOf<R> converted(const Medium& m) {
        return medium_of<R>({R(m.eps.real()), R(m.eps.imag())}, {R(m.q2.real()), R(m.q2.imag())});
    }

    /// At kz = 0 the two waves coincide; a shift far below double precision separates them.
    void add_layer_media() {
        const double shift = std::numeric_limits<R>::digits10 > 40 ? 1e-36 : 1e-30;
        layer_media_ = media_;
        for (MediumOf<R>& m : layer_media_)
            if (m.q2.re == 0 && m.q2.im == 0) {
                m.q2.re = R(shift);
                m.kz = outgoing_root(m.q2);
            }
    }

    void add_turns(std::span<const Element> elements, std::span<const R>& extra_phases) {
        for (const Element& element : elements) {
            if (const Layer* layer = std::get_if<Layer>(&element.value)) {
                R extra(0);
                if (!layer->coherent && !extra_phases.empty()) {
                    extra = extra_phases.front();
                    extra_phases = extra_phases.subspan(1);
                }
                turns_.push_back(turn_of(*layer, extra));
            } else {
                add_turns(std::get<Group>(element.value).elements, extra_phases);
            }
        }
    }

    /// Moving up by d multiplies the downward wave by exp(-i kz d) and the upward one by its
    /// inverse: mean and half difference of the two factors.
    Turn<R> turn_of(const Layer& layer, const R& extra_phase) {
        using std::abs;
        using std::cos;
        using std::exp;
        using std::expm1;
        using std::sin;
        const MediumOf<R>& m = layer_media_[layer.material];
        const R k0_d = k0_ * shift_.up(R(layer.thickness_nm));
        const R phase = k0_d * m.kz.re + extra_phase, decay = k0_d * m.kz.im;
        const R less = decay == 0        ? R(0)
                       : decay > R(1e-3) ? R((1 - exp(-2 * decay)) / 2)
                                         : R(-expm1(-2 * decay) / 2);
        const R more = 1 - less;
        const R cosine = phase == 0 ? R(1) : R(cos(phase)),
                sine = phase == 0 ? phase : R(sin(phase));
        return {&m,
                k0_d,
                decay,
                {phase, decay},
                {cosine * more, -sine * less},
                {cosine * less, -sine * more}};
    }

    /// D P D^-1 with D = [[b, b], [c, -c]]: maps fields at the lower face to the upper face.
    MatrixOf<R> of_turn(const Turn<R>& turn, Polarization polarization) const {
        const auto [b, c] = wave(*turn.medium, polarization);
        return {turn.mean, turn.half * b / c, turn.half * c / b, turn.mean, 0};
    }

    static MatrixOf<R> raised(MatrixOf<R> square, std::uint64_t repeat) {
        MatrixOf<R> total;
        for (std::uint64_t left = repeat; left != 0; left >>= 1) {
            if (left & 1) total = total * square;
            if (left > 1) square = square * square;
        }
        return total;
    }

    /// Matrix of one element without exp(decay); advances `turn` past its layers.
    MatrixOf<R> of(const Element& element, Polarization polarization, std::size_t& turn,
                   R& decay) const {
        if (std::holds_alternative<Layer>(element.value)) {
            decay += turns_[turn].decay;
            return of_turn(turns_[turn++], polarization);
        }
        const Group& group = std::get<Group>(element.value);
        R inside(0);
        const MatrixOf<R> period = of(group.elements, polarization, turn, inside);
        decay += R(static_cast<double>(group.repeat)) * inside;
        return raised(period, group.repeat);
    }

    MatrixOf<R> of(std::span<const Element> elements, Polarization polarization, std::size_t& turn,
                   R& decay) const {
        MatrixOf<R> total;
        for (const Element& element : elements)
            total = total * of(element, polarization, turn, decay);
        return total;
    }

    /// (b, c) = incident (b_in, c_in) + reflected (b_in, -c_in)
    Fields fields(Polarization polarization) const {
        Fields f{wave(above_, polarization), wave(below_, polarization), {}, R(0), {}, {}, {}, {}};
        std::size_t turn = 0;
        f.matrix = of(elements_, polarization, turn, f.decay);
        f.b = f.matrix.a * f.out.b + f.matrix.b * f.out.c;
        f.c = f.matrix.c * f.out.b + f.matrix.d * f.out.c;
        f.incident = scaled(f.b / f.in.b + f.c / f.in.c, R(0.5));
        f.reflected = scaled(f.b / f.in.b - f.c / f.in.c, R(0.5));
        return f;
    }

    static R squared_scale(const Fields& f) {
        using std::exp;
        return exp(-2 * (f.decay + R(static_cast<double>(f.matrix.exponent)) *
                                       boost::math::constants::ln_two<R>()));
    }

    class Derivatives;

    Shift shift_;
    R k0_;
    std::vector<MediumOf<R>> media_, layer_media_;
    MediumOf<R> above_, below_;
    std::span<const Element> elements_;
    std::vector<Turn<R>> turns_;
};

/// Derivatives of R, ln T and A = 1 - R - T with respect to every input, by reverse-mode
/// differentiation: the adjoints G of r and of ln(1/t), dr = sum of G_ij dM_ij, are passed from a
/// product of matrices to its factors.
template <class R>
class Transfer<R>::Derivatives {
public:
    Derivatives(const Transfer& transfer, Polarization polarization)
        : transfer_(transfer), polarization_(polarization), f_(transfer.fields(polarization)) {
        r_ = f_.reflected / f_.incident;
        transmitted_ = f_.out.flux() / (norm(f_.incident) * f_.in.flux()) * squared_scale(f_);
    }

    Condition sum() {
        const Cx<R> zero{}, half{R(0.5), R(0)};
        const Cx<R> with_b = half / (f_.in.b * f_.incident),
                    with_c = half / (f_.in.c * f_.incident);
        const Cx<R> r_b = with_b - r_ * with_b, r_c = zero - with_c - r_ * with_c;
        const auto [b, c] = f_.out;
        const std::int64_t exponent = -f_.matrix.exponent;
        std::size_t turn = 0;
        of_elements(transfer_.elements_,
                    {MatrixOf<R>{r_b * b, r_b * c, r_c * b, r_c * c, exponent},
                     MatrixOf<R>{with_b * b, with_b * c, with_c * b, with_c * c, exponent}},
                    turn);
        of_below(r_b, r_c, with_b, with_c);
        of_above();
        return sum_;
    }

    const std::vector<std::array<R, 2>>& all() const { return all_; }

private:
    using Adjoints = std::array<MatrixOf<R>, 2>;  ///< of r and of ln(1/t)

    /// Adds one input x, given x times the derivatives of r, ln(1/t) and ln(flux out/in) by x.
    void add(const Cx<R>& dr, const Cx<R>& dlog, const R& dflux = R(0)) {
        using std::abs;
        const R reflected = 2 * dot(r_, dr), log_transmitted = dflux - 2 * dlog.re;
        all_.push_back({reflected, log_transmitted});
        sum_.R += static_cast<double>(R(abs(reflected)));
        sum_.T += static_cast<double>(R(abs(transmitted_ * log_transmitted)));
        sum_.log_T += static_cast<double>(R(abs(log_transmitted)));
        sum_.A += static_cast<double>(R(abs(reflected + transmitted_ * log_transmitted)));
    }

    /// Calls f(dq2, deps) for n, k, n0 and cos of one medium: x times the derivatives by x.
    template <class F>
    static void for_inputs(const MediumOf<R>& m, F f) {
        const Cx<R> index{m.n, m.k}, none{};
        const Cx<R> by_n = scaled(index, R(2 * m.n)), by_k = Cx<R>{R(0), 2 * m.k} * index;
        f(by_n, by_n);
        f(by_k, by_k);
        f(Cx<R>{2 * m.across2, R(0)}, none);
        f(Cx<R>{2 * m.along2, R(0)}, none);
    }

    void of_elements(std::span<const Element> elements, Adjoints whole, std::size_t& turn) {
        std::vector<MatrixOf<R>> matrix(elements.size()), below(elements.size() + 1);
        std::size_t next = turn;
        R decay(0);
        for (std::size_t i = 0; i < elements.size(); ++i)
            matrix[i] = transfer_.of(elements[i], polarization_, next, decay);
        for (std::size_t i = elements.size(); i-- > 0;) below[i] = matrix[i] * below[i + 1];
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const MatrixOf<R> after = transposed(below[i + 1]), itself = transposed(matrix[i]);
            const Adjoints own{whole[0] * after, whole[1] * after};
            if (std::holds_alternative<Layer>(elements[i].value)) {
                of_turn(transfer_.turns_[turn++], own);
            } else {
                of_group(std::get<Group>(elements[i].value), own, turn);
            }
            for (MatrixOf<R>& adjoint : whole) adjoint = itself * adjoint;
        }
    }

    /// Propagates adjoints back through the squarings.
    void of_group(const Group& group, const Adjoints& whole, std::size_t& turn) {
        std::size_t next = turn;
        R decay(0);
        // squares M^(2^bit), and products of those of the lower bits: M^(repeat mod 2^bit)
        std::vector<MatrixOf<R>> squares{transfer_.of(group.elements, polarization_, next, decay)};
        std::vector<MatrixOf<R>> lower(1);
        for (std::uint64_t left = group.repeat; left > 1; left >>= 1) {
            lower.push_back(left & 1 ? lower.back() * squares.back() : lower.back());
            squares.push_back(squares.back() * squares.back());
        }
        Adjoints of_period;
        for (std::size_t q = 0; q < 2; ++q) {
            MatrixOf<R> of_total = whole[q], sum = nothing();
            for (std::size_t bit = squares.size(); bit-- > 0;) {
                const MatrixOf<R> itself = transposed(squares[bit]);
                if (bit + 1 < squares.size()) sum = sum * itself + itself * sum;
                if ((group.repeat >> bit & 1) == 0) continue;
                sum = sum + transposed(lower[bit]) * of_total;
                of_total = of_total * itself;
            }
            of_period[q] = sum;
        }
        of_elements(group.elements, of_period, turn);
    }

    static MatrixOf<R> nothing() {
        MatrixOf<R> m{{}, {}, {}, {}, 0};
        m.exponent = std::numeric_limits<std::int64_t>::min() / 4;
        return m;
    }

    void of_turn(const Turn<R>& turn, const Adjoints& adjoint) {
        const MediumOf<R>& m = *turn.medium;
        const bool s = polarization_ == Polarization::s;
        const Cx<R> one{R(1), R(0)}, none{};
        const Cx<R> z = s ? one / m.kz : m.kz / m.eps;  // M = [[mean, half z], [half/z, mean]]
        std::array<Cx<R>, 2> by_phase, by_q2, by_eps;
        for (std::size_t q = 0; q < 2; ++q) {
            const auto& [a, b, c, d, exponent] = adjoint[q];
            const R scale = power_of_two<R>(exponent);
            const Cx<R> phase = turned(turn.half * (a + d) + turn.mean * (b * z + c / z));
            const Cx<R> ratio = turn.half * (b - c / (z * z));
            const Cx<R> by_kz =
                scaled(phase, turn.k0_d) + (s ? none - ratio / (m.kz * m.kz) : ratio / m.eps);
            by_phase[q] = scaled(phase, scale);
            by_q2[q] = scaled(by_kz / (m.kz + m.kz), scale);
            by_eps[q] = s ? none : scaled(none - ratio * m.kz / (m.eps * m.eps), scale);
        }
        for (int twice = 0; twice < 2; ++twice)  // thickness and wavelength
            add(by_phase[0] * turn.phase, by_phase[1] * turn.phase);
        for_inputs(m, [&](const Cx<R>& dq2, const Cx<R>& deps) {
            add(by_q2[0] * dq2 + by_eps[0] * deps, by_q2[1] * dq2 + by_eps[1] * deps);
        });
    }

    void of_below(const Cx<R>& r_b, const Cx<R>& r_c, const Cx<R>& log_b, const Cx<R>& log_c) {
        const MediumOf<R>& m = transfer_.below_;
        const MatrixOf<R>& t = f_.matrix;
        const R flux = f_.out.flux();
        for_inputs(m, [&](const Cx<R>& dq2, const Cx<R>& deps) {
            const WaveOf<R> d = change_of(m, dq2, deps);
            const Cx<R> db = t.a * d.b + t.b * d.c, dc = t.c * d.b + t.d * d.c;
            add(r_b * db + r_c * dc, log_b * db + log_c * dc,
                flux == 0 ? R(0) : R((dot(d.b, f_.out.c) + dot(f_.out.b, d.c)) / flux));
        });
    }

    /// In the incident medium q2 is n0^2 cos^2, so n = n0 is a single input.
    void of_above() {
        const MediumOf<R>& m = transfer_.above_;
        const Cx<R> along{2 * m.along2, R(0)};
        of_incident_wave(change_of(m, along, {2 * m.n * m.n, R(0)}));
        of_incident_wave(change_of(m, along, {}));
    }

    void of_incident_wave(const WaveOf<R>& d) {
        const Cx<R> half{R(0.5), R(0)};
        const Cx<R> with_b = half * f_.b * d.b / (f_.in.b * f_.in.b * f_.incident);
        const Cx<R> with_c = half * f_.c * d.c / (f_.in.c * f_.in.c * f_.incident);
        const Cx<R> dlog = Cx<R>{} - with_b - with_c;
        const R dflux = -(dot(d.b, f_.in.c) + dot(f_.in.b, d.c)) / f_.in.flux();
        add(with_c - with_b - r_ * dlog, dlog, dflux);
    }

    WaveOf<R> change_of(const MediumOf<R>& m, const Cx<R>& dq2, const Cx<R>& deps) const {
        const Cx<R> dkz = dq2 / (m.kz + m.kz);
        if (polarization_ == Polarization::s) return {{}, dkz};
        return {dkz, deps};
    }

    const Transfer& transfer_;
    Polarization polarization_;
    Fields f_;
    Cx<R> r_;
    R transmitted_;
    Condition sum_;
    std::vector<std::array<R, 2>> all_;
};

}  // namespace irido::textbook
