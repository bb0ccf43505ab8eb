#include "core/coherent/layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/math/imaginary.hpp"

namespace irido {

namespace {

/// Beyond this |Im delta| the factor exp(|Im delta|) is carried in the logarithm.
constexpr double kLargestPlainExponent = 1;

/// delta = a + i b with b >= 0; less = cos - 1 and s = sin, both times exp(-log_scale).
struct Phase {
    double a, b;
    Complex less, s;
    double log_scale;
};

Phase layer_phase(Complex q2, double k0_d) {
    Complex delta = k0_d * square_root(q2);
    if (delta.imag() < 0) delta = -delta;  // c and sd are even in delta
    const double a = delta.real(), b = delta.imag();
    if (b <= kLargestPlainExponent) {
        const Complex half = std::sin(delta / 2.0);
        return {a, b, -2.0 * half * half, std::sin(delta), 0};
    }
    const ScaledTurn turn = scaled_turn(delta);
    return {a, b, turn.cos - std::exp(-b), turn.sin, b};
}

/// k0 d sinc(delta), times exp(-log_scale).
Complex scaled_sd(const Phase& phase, double k0_d) {
    const Complex delta{phase.a, phase.b};
    if (std::norm(delta) > 1e-8) return k0_d * (phase.s / delta);
    return k0_d * (1.0 - delta * delta / 6.0);  // next term below 1e-18
}

/// Integrals over a layer's depth, divided by exp(2 log_scale), times k0:
///     cc = int |cos|^2,  ss = int |sin(kz z)/(kz/k0)|^2,  cs = int cos conj(sin(kz z)/(kz/k0))
struct DepthIntegrals {
    double cc, ss;
    Complex cs;
};

/// sin(2a)/(2a) and sin(a)^2/a^2, safe at zero.
double sinc(double x) {
    return std::abs(x) > 1e-4 ? std::sin(x) / x : 1 - x * x / 6;
}

/// (sinh(2b)/(2b) - sin(2a)/(2a)) / (2 |delta|^2) for small delta, as the series
///     2 sum_{m>=1} h_{m-1}(u, v)/(2m+1)!,   u = 4 b^2,   v = -4 a^2,
/// with h the complete homogeneous symmetric polynomials.
double sine_square_series(double a, double b) {
    const double u = 4 * b * b, v = -4 * a * a;
    double h = 1, v_power = 1, factorial = 6, sum = 1.0 / 6;
    for (int m = 2; m <= 12; ++m) {
        v_power *= v;
        h = u * h + v_power;
        factorial *= 2.0 * m * (2.0 * m + 1);
        sum += h / factorial;
    }
    return 2 * sum;
}

/// With kz d = delta = a + ib, and x = a z/d, y = b z/d at the depth z,
///     |cos|^2 = (cosh 2y + cos 2x)/2,   |sin|^2 = (cosh 2y - cos 2x)/2,
///     cos conj(sin) = (sin 2x - i sinh 2y)/2,
/// and over the depth cosh 2y, cos 2x, sin 2x and sinh 2y have the means sinh(2b)/(2b),
/// sin(2a)/(2a), sin(a)^2/a and sinh(b)^2/b; kz/k0 = delta/(k0 d). In a thin layer the first two
/// are nearly equal: their difference is taken term by term, u^m - v^m = (u - v) h_{m-1}(u, v) with
/// u - v = 4 |delta|^2.
DepthIntegrals depth_integrals(const Phase& phase, double k0_d) {
    const double a = phase.a, b = phase.b;
    const double scale = std::exp(-2 * phase.log_scale);
    const bool large = phase.log_scale > 0;
    // exp(-2 log_scale) times sinh(2b)/(2b), sin(2a)/(2a), sinh(b)^2/b and sin(a)^2/a
    const double hyperbolic = large      ? -std::expm1(-4 * b) / (4 * b)
                              : b > 1e-4 ? std::sinh(2 * b) / (2 * b)
                                         : 1 + 2 * b * b / 3;
    const double circular = sinc(2 * a) * scale;
    const double sinh_square = large   ? std::pow(std::expm1(-2 * b), 2) / (4 * b)
                               : b > 0 ? std::pow(std::sinh(b), 2) / b
                                       : 0;
    const double sine_square = a * std::pow(sinc(a), 2) * scale;
    const double delta2 = a * a + b * b;
    DepthIntegrals result{};
    result.cc = k0_d / 2 * (hyperbolic + circular);
    result.ss = k0_d * k0_d * k0_d *
                (delta2 < 0.25 ? sine_square_series(a, b) : (hyperbolic - circular) / (2 * delta2));
    const Complex difference{sine_square, -sinh_square};  // -> conj(delta) for thin layers
    result.cs = k0_d * k0_d / 2 * (delta2 > 1e-280 ? difference / Complex(a, -b) : Complex(1));
    return result;
}

AbsorbedPower absorbed_power(const Medium& m, const Phase& phase, double k0_d,
                             Polarization polarization) {
    // flux falls by Im(v') |B|^2 + Im(w) |C|^2 per depth 1/k0, v' = eps in both polarizations
    const auto [w, v] = coupling(m, polarization);
    const DepthIntegrals f = depth_integrals(phase, k0_d);
    const double loss_b = m.eps.imag();
    AbsorbedPower q;
    q.bb = loss_b * f.cc;
    q.cc = loss_b * std::norm(w) * f.ss;
    q.bc = loss_b * (-kI * w) * std::conj(f.cs);
    if (polarization == Polarization::p) {
        const double loss_c = w.imag();
        q.bb += loss_c * std::norm(v) * f.ss;
        q.cc += loss_c * f.cc;
        q.bc += loss_c * std::conj(-kI * v) * f.cs;
    }
    return q;
}

Matrix phase_matrix(const Medium& m, const Phase& phase, double k0_d, Polarization polarization) {
    const auto [w, v] = coupling(m, polarization);
    const Complex sd = scaled_sd(phase, k0_d);
    return {phase.less, -kI * w * sd, -kI * v * sd, phase.less, phase.log_scale};
}

/// The factor F of one layer's form, which has a single sign.
FormRoot root_of(const AbsorbedPower& q) {
    const double bb = std::abs(q.bb), cc = std::abs(q.cc);
    if (bb == 0) return {0, std::sqrt(cc), 0};
    const double b = std::sqrt(bb);
    const Complex c = (q.bb < 0 ? -q.bc : q.bc) / b;
    return {b, std::sqrt(std::max(0.0, cc - std::norm(c))), c};
}

double norm_of(const FormRoot& f, Complex b, Complex c) {
    return std::norm(f.b * b + f.c * c) + f.rest * f.rest * std::norm(c);
}

}  // namespace

Complex square_root(Complex z) {
    if (z.imag() != 0) return std::sqrt(z);
    return z.real() >= 0 ? Complex(std::sqrt(z.real()), 0) : Complex(0, std::sqrt(-z.real()));
}

ScaledTurn scaled_turn(Complex z) {
    const double cos_a = std::cos(z.real()), sin_a = std::sin(z.real());
    const double half_less = -std::expm1(-2 * z.imag()) / 2, half_more = 1 - half_less;
    return {{cos_a * half_more, -sin_a * half_less}, {sin_a * half_more, cos_a * half_less}};
}

Coupling coupling(const Medium& m, Polarization polarization) {
    if (polarization == Polarization::s) return {1.0, m.q2};
    return {m.q2 / m.eps, m.eps};
}

LayerTurn layer_turn(Complex q2, double k0_d) {
    const Phase phase = layer_phase(q2, k0_d);
    // from cos itself: cos - 1 would lose the digits of a cosine near 0
    const Complex cosine = phase.log_scale > 0 ? scaled_turn({phase.a, phase.b}).cos
                                               : std::cos(Complex{phase.a, phase.b});
    return {cosine, scaled_sd(phase, k0_d), phase.log_scale};
}

AbsorbedPower absorbed_power(const Medium& m, double k0_d, Polarization polarization) {
    return absorbed_power(m, layer_phase(m.q2, k0_d), k0_d, polarization);
}

double absorbed_flux(const AbsorbedPower& q, Complex b, Complex c) {
    return q.bb * std::norm(b) + q.cc * std::norm(c) + 2 * (std::conj(b) * q.bc * c).real();
}

double absorbed_flux(const SlabAbsorption& q, Complex b, Complex c) {
    return norm_of(q.loss, b, c) - norm_of(q.gain, b, c);
}

Matrix layer_matrix(const Medium& m, double k0_d, Polarization polarization) {
    return phase_matrix(m, layer_phase(m.q2, k0_d), k0_d, polarization);
}

Matrix wave_matrix(const Medium& m, double k0_d, Polarization polarization, Complex y0) {
    const Complex kz = square_root(m.q2), delta = k0_d * kz;  // Re(kz) >= 0
    const Complex y = polarization == Polarization::s ? kz : m.eps / kz;
    const Complex i_h = kI * ((y - y0) * (y - y0) / (2.0 * y * y0));
    const Complex i_w = kI * ((y - y0) * (y + y0) / (2.0 * y * y0));
    const double b = std::abs(delta.imag());
    if (b <= kLargestPlainExponent) {
        const Complex half = std::sin(delta / 2.0), sine = std::sin(delta);
        const Complex less = -2.0 * half * half;
        return {less - (kI + i_h) * sine, -i_w * sine, i_w * sine, less + (kI + i_h) * sine, 0};
    }
    const double identity = std::exp(-b);
    const Complex down = std::exp(-kI * delta - b), up = std::exp(kI * delta - b);
    const Complex sine = (up - down) / (2.0 * kI);
    return {down - identity - i_h * sine, -i_w * sine, i_w * sine, up - identity + i_h * sine, b};
}

Slab layer_slab(const Medium& m, double k0_d, Polarization polarization) {
    const Phase phase = layer_phase(m.q2, k0_d);
    Slab slab{phase_matrix(m, phase, k0_d, polarization), {}, is_lossy(m)};
    const double loss = m.eps.imag() != 0 ? m.eps.imag() : (m.q2 / m.eps).imag();
    if (slab.absorbs)
        (loss > 0 ? slab.absorbed.loss : slab.absorbed.gain) =
            root_of(absorbed_power(m, phase, k0_d, polarization));
    return slab;
}

double Matrix::identity() const {
    return std::exp(-log_scale);
}

double normalize(Matrix& m) {
    const double size = std::max({std::abs(m.a.real()), std::abs(m.a.imag()), std::abs(m.b.real()),
                                  std::abs(m.b.imag()), std::abs(m.c.real()), std::abs(m.c.imag()),
                                  std::abs(m.d.real()), std::abs(m.d.imag())});
    const bool shrunk = size > 0 && size < 1e-60 && m.log_scale > 1;
    if (!(size > 1e60) && !shrunk) return 0;
    const int lowest = -static_cast<int>(std::min(m.log_scale / std::log(2.0), 2000.0));
    const int exponent = std::max(std::ilogb(size), lowest);
    const double factor = std::ldexp(1.0, -exponent);
    for (Complex* entry : {&m.a, &m.b, &m.c, &m.d}) *entry *= factor;
    const double moved = exponent * std::log(2.0);
    m.log_scale += moved;
    return moved;
}

namespace {

/// (I + e^p U)(I + e^q L) = I + e^(p+q) (U e^-q + L e^-p + U L)
Matrix product(const Matrix& u, const Matrix& l) {
    const double with_u = l.identity(), with_l = u.identity();
    return {with_u * u.a + with_l * l.a + (u.a * l.a + u.b * l.c),
            with_u * u.b + with_l * l.b + (u.a * l.b + u.b * l.d),
            with_u * u.c + with_l * l.c + (u.c * l.a + u.d * l.c),
            with_u * u.d + with_l * l.d + (u.c * l.b + u.d * l.d), u.log_scale + l.log_scale};
}

/// One row (b, c) of a factor.
using Row = std::array<Complex, 2>;

/// The triangular factor of the same F^H F: QR by Gram-Schmidt.
FormRoot triangle(std::span<const Row> rows) {
    double bb = 0;
    for (const Row& row : rows) bb += std::norm(row[0]);
    const double b = std::sqrt(bb), inverse = b > 0 ? 1 / b : 0;
    Complex c = 0;
    for (const Row& row : rows) c += std::conj(row[0] * inverse) * row[1];
    double rest = 0;
    for (const Row& row : rows) rest += std::norm(row[1] - c * (row[0] * inverse));
    return {b, std::sqrt(rest), c};
}

/// Factor of the sum of both forms, the upper one expressed in the fields below the slab of matrix
/// M: F M.
FormRoot combined(const FormRoot& above, double f, const Matrix& m, const FormRoot& below,
                  double g) {
    if (above.is_zero() && below.is_zero()) return {};
    const Complex a = m.a + m.identity(), d = m.d + m.identity();
    const double b = f * above.b, rest = f * above.rest;
    const Complex c = f * above.c;
    const std::array<Row, 4> rows{Row{b * a + c * m.c, b * m.b + c * d}, Row{rest * m.c, rest * d},
                                  Row{g * below.b, g * below.c}, Row{0, g * below.rest}};
    return triangle(rows);
}

/// Absorption of two stacked slabs; both logarithms are relative to the combined matrix.
SlabAbsorption combined(const SlabAbsorption& above, const Matrix& m, const SlabAbsorption& below) {
    const auto is_zero = [](const SlabAbsorption& q) {
        return q.loss.is_zero() && q.gain.is_zero();
    };
    const double common = is_zero(above)   ? below.log_scale
                          : is_zero(below) ? above.log_scale
                                           : std::max(above.log_scale, below.log_scale);
    const double f = is_zero(above) ? 0 : std::exp(above.log_scale - common);
    const double g = is_zero(below) ? 0 : std::exp(below.log_scale - common);
    return {combined(above.loss, f, m, below.loss, g), combined(above.gain, f, m, below.gain, g),
            common};
}

void normalize(SlabAbsorption& q) {
    double size = 0;
    for (const FormRoot* f : {&q.loss, &q.gain})
        size = std::max({size, f->b, std::abs(f->c), f->rest});
    if ((size > 1e-30 && size < 1e30) || size < 1e-140) return;  // 0, or negligible
    const int exponent = std::ilogb(size);
    const double factor = std::ldexp(1.0, -exponent);
    for (FormRoot* f : {&q.loss, &q.gain}) *f = {f->b * factor, f->rest * factor, f->c * factor};
    q.log_scale += exponent * std::log(2.0);
}

}  // namespace

Matrix operator*(const Matrix& upper, const Matrix& lower) {
    Matrix both = product(upper, lower);
    normalize(both);
    return both;
}

Slab operator*(const Slab& upper, const Slab& lower) {
    Slab both{product(upper.matrix, lower.matrix), {}, upper.absorbs || lower.absorbs};
    const double moved = normalize(both.matrix);
    if (!both.absorbs) return both;
    SlabAbsorption above = upper.absorbed, below = lower.absorbed;
    above.log_scale -= moved;
    below.log_scale -= upper.matrix.log_scale + moved;
    both.absorbed = combined(above, lower.matrix, below);
    normalize(both.absorbed);
    return both;
}

}  // namespace irido
