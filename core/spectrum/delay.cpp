#include "core/spectrum/delay.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/coherent/layer.hpp"
#include "core/material/index_series.hpp"
#include "core/math/constants.hpp"
#include "core/math/imaginary.hpp"

namespace irido {

namespace {

using ComplexSeries = Series<Complex>;

constexpr double kLight_nm_per_fs = 299.792458;

/// A medium at one angle: S is n0(w) sin(theta), so that q2 has the incident medium's dispersion.
/// w and v are the coupling() of its fields.
struct SeriesMedium {
    ComplexSeries eps, q2, w, v;
};

SeriesMedium isotropic_medium(const ComplexSeries& index, const ComplexSeries& n0, IncidentAngle at,
                              Polarization polarization) {
    const ComplexSeries along = n0 * at.cos, across = n0 * at.sin;
    SeriesMedium m;
    m.eps = index * index;
    m.q2 = at.cos * at.cos > 0.5 ? m.eps - across * across
                                 : (index - n0) * (index + n0) + along * along;
    const bool is_s = polarization == Polarization::s;
    m.w = is_s ? ComplexSeries(1) : m.q2 / m.eps;
    m.v = is_s ? m.q2 : m.eps;
    return m;
}

/// extraordinary_medium() for p.
SeriesMedium axial_medium(const ComplexSeries& ordinary, const ComplexSeries& extraordinary,
                          const ComplexSeries& n0, IncidentAngle at) {
    SeriesMedium o = isotropic_medium(ordinary, n0, at, Polarization::p);
    const SeriesMedium e = isotropic_medium(extraordinary, n0, at, Polarization::p);
    o.w = e.q2 / e.eps;
    o.q2 = o.eps * o.w;
    return o;
}

/// cos(sqrt u) and sin(sqrt u)/sqrt u, both divided by exp(|Im sqrt u|) of the constant term.
struct SeriesTurn {
    ComplexSeries cos, sinc;
};

/// Their power series in u.
SeriesTurn small_turn(const ComplexSeries& u) {
    constexpr int kMostTerms = 18;  // 4^18/36! is 1e-31
    SeriesTurn turn{1, 1};
    for (int n = kMostTerms; n > 0; --n) {
        turn.cos = 1 - u * turn.cos * (1 / (2.0 * n * (2.0 * n - 1)));
        turn.sinc = 1 - u * turn.sinc * (1 / (2.0 * n * (2.0 * n + 1)));
    }
    return turn;
}

SeriesTurn turn_of(const ComplexSeries& u) {
    constexpr double kSmall = 4;
    if (std::abs(u[0]) < kSmall) return small_turn(u);
    Complex first = square_root(u[0]);
    if (first.imag() < 0) first = -first;
    const ComplexSeries delta = root_of(u, first);
    ComplexSeries more = delta;  // cos and sin of the sum of first and more
    more[0] = 0;
    const ScaledTurn turn = scaled_turn(first);
    const ComplexSeries square = more * more;
    const ComplexSeries cos_more = 1 - 0.5 * square, sin_more = more * (1 - square * (1 / 6.0));
    return {turn.cos * cos_more - turn.sin * sin_more,
            (turn.sin * cos_more + turn.cos * sin_more) / delta};
}

double size_of(const Complex& z) {
    return std::max(std::abs(z.real()), std::abs(z.imag()));
}

/// Scales series by one power of two, so that products of many neither overflow nor vanish: phases
/// and delays do not see it.
template <std::size_t count>
void scale(const std::array<ComplexSeries*, count>& all) {
    double size = 0;
    for (const ComplexSeries* one : all) size = std::max(size, size_of(one->c[0]));
    if (!(size > 0) || !std::isfinite(size)) return;
    const double factor = std::ldexp(1.0, -std::ilogb(size));
    for (ComplexSeries* one : all)
        for (Complex& coefficient : one->c) coefficient *= factor;
}

/// [[a, b], [c, d]] on tangential fields (B, C)
struct SeriesMatrix {
    ComplexSeries a{1}, b, c, d{1};
};

SeriesMatrix operator*(const SeriesMatrix& u, const SeriesMatrix& l) {
    SeriesMatrix m{u.a * l.a + u.b * l.c, u.a * l.b + u.b * l.d, u.c * l.a + u.d * l.c,
                   u.c * l.b + u.d * l.d};
    scale(std::array{&m.a, &m.b, &m.c, &m.d});
    return m;
}

SeriesMatrix layer_matrix(const SeriesMedium& m, double k0_d) {
    const ComplexSeries kd = k0_d * ComplexSeries({1, 1, 0, 0});
    const SeriesTurn turn = turn_of(kd * kd * m.q2);
    const ComplexSeries sd = -kI * (kd * turn.sinc);
    return {turn.cos, m.w * sd, m.v * sd, turn.cos};
}

SeriesMatrix matrix_of(std::span<const Element> elements, std::span<const SeriesMedium> media,
                       double k0);

SeriesMatrix matrix_of(const Element& element, std::span<const SeriesMedium> media, double k0) {
    if (const Layer* layer = std::get_if<Layer>(&element.value))
        return layer_matrix(media[layer->material], k0 * layer->thickness_nm);
    const Group& group = std::get<Group>(element.value);
    SeriesMatrix square = matrix_of(group.elements, media, k0), power;
    for (std::uint64_t left = group.repeat; left != 0; left >>= 1) {
        if (left & 1) power = power * square;
        if (left > 1) square = square * square;
    }
    return power;
}

SeriesMatrix matrix_of(std::span<const Element> elements, std::span<const SeriesMedium> media,
                       double k0) {
    SeriesMatrix total;
    for (const Element& element : elements) total = total * matrix_of(element, media, k0);
    return total;
}

struct SeriesWave {
    ComplexSeries b, c;
};

/// The wave that leaves; infinite derivatives at its critical angle.
SeriesWave outgoing_wave(const SeriesMedium& m, Polarization polarization) {
    Complex first = square_root(m.q2[0]);
    if (first.imag() < 0) first = -first;
    const ComplexSeries kz = root_of(m.q2, first);
    if (polarization == Polarization::s) return {1, kz};
    return {kz, m.eps};
}

double finite(double value) {
    return std::isfinite(value) ? value + 0.0 : std::numeric_limits<double>::quiet_NaN();
}

/// From the logarithm's series l1 x + l2 x^2 + l3 x^3 of a/a0.
Delay delay_of(const ComplexSeries& a, double w0) {
    const double phase = std::arg(a[0]) / kDegree;
    if (a[0] == 0.0 || !std::isfinite(phase)) return {};
    const ComplexSeries l = a / ComplexSeries(a[0]);
    const Complex l1 = l[1], l2 = l[2] - l1 * l1 / 2.0, l3 = l[3] - l1 * l[2] + l1 * l1 * l1 / 3.0;
    return {phase <= -180 ? 180 : phase + 0.0, finite(l1.imag() / w0),
            finite(2 * l2.imag() / (w0 * w0)), finite(6 * l3.imag() / (w0 * w0 * w0))};
}

}  // namespace

Delays delays(const Stack& stack, std::span<const Series<Complex>> index, double wavelength_nm,
              IncidentAngle incidence, Polarization polarization,
              std::span<const Series<Complex>> extraordinary) {
    ComplexSeries n0 = index[stack.incident];
    for (Complex& coefficient : n0.c) coefficient.imag(0);
    std::vector<SeriesMedium> media;
    for (std::size_t m = 0; m < index.size(); ++m)
        media.push_back(polarization == Polarization::s || extraordinary.empty()
                            ? isotropic_medium(index[m], n0, incidence, polarization)
                            : axial_medium(index[m], extraordinary[m], n0, incidence));
    const double k0 = kTwoPi / wavelength_nm;
    SeriesWave fields = outgoing_wave(media[stack.substrate], polarization);
    const ComplexSeries leaving = fields.b;
    // the fields' powers of two are those of t, which does not see them
    for (std::size_t i = stack.elements.size(); i-- > 0;) {
        const SeriesMatrix m = matrix_of(stack.elements[i], media, k0);
        fields = {m.a * fields.b + m.b * fields.c, m.c * fields.b + m.d * fields.c};
        scale(std::array{&fields.b, &fields.c});
    }
    const ComplexSeries kz = n0 * incidence.cos;
    const bool is_s = polarization == Polarization::s;
    const ComplexSeries down = (is_s ? kz : n0 * n0) * fields.b,
                        up = (is_s ? ComplexSeries(1) : kz) * fields.c;
    const ComplexSeries sum = down + up;
    ComplexSeries difference = down - up;
    constexpr double kRounding = 0x1p-46;
    if (std::abs(difference[0]) <= kRounding * (std::abs(down[0]) + std::abs(up[0])))
        difference[0] = 0;
    const double w0 = kTwoPi * kLight_nm_per_fs / wavelength_nm;
    // t is this times a positive number, which at 90 degrees is 0
    return {delay_of(difference / sum, w0), delay_of(leaving / sum, w0)};
}

}  // namespace irido
