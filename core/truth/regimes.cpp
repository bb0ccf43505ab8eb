#include "core/truth/regimes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/stack/builder.hpp"

namespace irido {

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

double dielectric(Random& random) {
    return random.uniform(1.2, 2.7);
}

/// No absorption, or absorption of any magnitude.
double some_absorption(Random& random) {
    return random.one_in(2) ? 0 : random.log_uniform(1e-12, 1);
}

Complex metal(Random& random) {
    return {random.uniform(0.05, 3), random.uniform(1.5, 7)};
}

/// Glass or metal.
Complex substrate(Random& random) {
    return random.one_in(3) ? metal(random) : Complex(random.uniform(1, 2.5));
}

double visible(Random& random) {
    return random.uniform(380, 780);
}

/// A layer with a thickness between the two. Cases draw their random numbers in line order.
Element film(StackBuilder& b, Random& random, Complex index, double from_nm, double to_nm) {
    return b.layer(index, random.uniform(from_nm, to_nm));
}

/// The same with a log-uniform thickness.
Element any_film(StackBuilder& b, Random& random, Complex index, double from_nm, double to_nm) {
    return b.layer(index, random.log_uniform(from_nm, to_nm));
}

/// Up to three ulps away, or, in every second draw, up to 1e-3 away.
double beside(double value, Random& random) {
    if (random.one_in(2)) {
        const double away = random.log_uniform(1e-15, 1e-3);
        return value * (random.one_in(2) ? 1 + away : 1 - away);
    }
    const double towards = random.one_in(2) ? 0 : 2 * value;
    for (std::size_t ulps = random.below(4); ulps > 0; --ulps)
        value = std::nextafter(value, towards);
    return value;
}

/// 2 to `most`; every fourth draw is `most`.
std::uint64_t many(Random& random, double most = 1e9) {
    if (random.one_in(4)) return static_cast<std::uint64_t>(most);
    return static_cast<std::uint64_t>(random.log_uniform(2, most));
}

StackCase ordinary(Random& random) {
    StackBuilder b(random.one_in(4) ? random.uniform(1, 1.6) : 1.0);
    for (std::size_t left = 1 + random.below(8); left > 0; --left) {
        const Complex index{dielectric(random), random.one_in(4) ? random.uniform(0, 0.3) : 0};
        b.add(film(b, random, index, 5, 500));
    }
    const Stack stack = b.over(substrate(random));
    return {stack, visible(random), random.one_in(4) ? 0 : random.uniform(0, 85)};
}

StackCase grazing(Random& random) {
    StackBuilder b(random.one_in(4) ? random.uniform(1, 1.6) : 1.0);
    for (std::size_t left = random.below(4); left > 0; --left)
        b.add(film(b, random, {dielectric(random), some_absorption(random)}, 5, 500));
    const double below = random.one_in(8) ? 1e-9 : random.log_uniform(1e-13, 1);
    return {b.over(substrate(random)), visible(random), 90 - below};
}

/// Critical angle in degrees for light going from n0 into a medium of index n < n0.
double critical_angle_deg(double n, double n0) {
    return std::asin(n / n0) * kDegrees;
}

StackCase critical(Random& random) {
    const double n0 = random.one_in(3) ? 2 : random.uniform(1.3, 2.7);
    const double low = n0 == 2 ? 1 : n0 * random.uniform(0.3, 0.95);
    StackBuilder b(n0);
    const bool in_film = random.one_in(2);
    if (random.one_in(2)) b.add(film(b, random, dielectric(random), 5, 500));
    if (in_film) b.add(any_film(b, random, low, 0.1, 1e5));
    if (random.one_in(3)) b.add(film(b, random, {dielectric(random), 0.01}, 5, 500));
    const double angle = n0 == 2 ? 30 : critical_angle_deg(low, n0);
    return {b.over(in_film ? substrate(random) : low), visible(random), beside(angle, random)};
}

StackCase evanescent(Random& random) {
    const double n0 = random.uniform(1.4, 2.7), gap = n0 * random.uniform(0.4, 0.95);
    StackBuilder b(n0);
    if (random.one_in(2)) b.add(film(b, random, random.uniform(1.2, 2.7), 5, 500));
    b.add(any_film(b, random, gap, 1, 1e6));
    if (random.one_in(2)) b.add(b.layer({dielectric(random), some_absorption(random)}, 80));
    const double critical_deg = critical_angle_deg(gap, n0);
    const double angle = critical_deg + (90 - critical_deg) * random.uniform(0, 0.999);
    return {b.over(random.one_in(2) ? Complex(n0) : substrate(random)), visible(random), angle};
}

StackCase absorber(Random& random) {
    StackBuilder b;
    if (random.one_in(2)) b.add(film(b, random, dielectric(random), 5, 500));
    const Complex index{random.uniform(0.1, 4), random.log_uniform(1e-9, 10)};
    b.add(any_film(b, random, index, 1, 1e9));
    if (random.one_in(2)) b.add(film(b, random, dielectric(random), 5, 500));
    return {b.over(substrate(random)), visible(random), random.uniform(0, 89)};
}

StackCase gain(Random& random) {
    StackBuilder b;
    const auto amplifier = [&] {
        const double most = random.one_in(2) ? 0.5 : 1e-3;
        return film(b, random, {dielectric(random), -random.log_uniform(1e-12, most)}, 5, 1000);
    };
    if (random.one_in(2)) b.add(b.layer({dielectric(random), some_absorption(random)}, 100));
    b.add(amplifier());
    if (random.one_in(3))
        b.add(StackBuilder::group(30, {amplifier(), b.layer(dielectric(random), 90)}));
    return {b.over(substrate(random)), visible(random), random.uniform(0, 85)};
}

StackCase dense_metal(Random& random) {
    const Complex dense = random.one_in(2)
                              ? Complex(0.05, 60)
                              : Complex(random.log_uniform(1e-3, 10), random.log_uniform(10, 1e4));
    StackBuilder b;
    if (random.one_in(2)) b.add(film(b, random, dielectric(random), 5, 500));
    if (random.one_in(2)) b.add(any_film(b, random, dense, 0.1, 100));
    if (random.one_in(2)) b.add(film(b, random, dielectric(random), 5, 500));
    const Complex below = random.one_in(2) ? dense : substrate(random);
    return {b.over(below), visible(random), random.one_in(4) ? 0 : random.uniform(0, 89.99)};
}

StackCase near_equal(Random& random) {
    const double n = random.uniform(1, 2.5);
    const auto nearly = [&] { return n * (1 + random.log_uniform(1e-16, 1e-2)); };
    StackBuilder b(n);
    for (std::size_t left = 1 + random.below(4); left > 0; --left)
        b.add(film(b, random, random.one_in(4) ? n : nearly(), 5, 5000));
    if (random.one_in(4))
        b.add(StackBuilder::group(1000, {b.layer(n, 100), b.layer(nearly(), 120)}));
    const double angle =
        random.one_in(2) ? random.uniform(0, 89) : 90 - random.log_uniform(1e-9, 10);
    return {b.over(nearly()), visible(random), angle};
}

StackCase repeats_pair(Random& random) {
    StackBuilder b;
    const std::uint64_t repeat = many(random);
    b.add(StackBuilder::group(repeat, {film(b, random, dielectric(random), 5, 300),
                                       film(b, random, dielectric(random), 5, 300)}));
    return {b.over(substrate(random)), visible(random), random.uniform(0, 85)};
}

StackCase repeats_triple(Random& random) {
    StackBuilder b;
    std::vector<Element> period;
    for (std::size_t left = 3 + random.below(3); left > 0; --left)
        period.push_back(film(b, random, dielectric(random), 5, 300));
    b.add(StackBuilder::group(many(random), std::move(period)));
    return {b.over(substrate(random)), visible(random), random.uniform(0, 85)};
}

StackCase repeats_absorbing(Random& random) {
    StackBuilder b;
    std::vector<Element> period;
    for (std::size_t left = 2 + random.below(2); left > 0; --left)
        period.push_back(
            film(b, random, {dielectric(random), random.log_uniform(1e-15, 1)}, 5, 300));
    b.add(StackBuilder::group(many(random), std::move(period)));
    return {b.over(substrate(random)), visible(random), random.uniform(0, 85)};
}

StackCase repeats_thin(Random& random) {
    StackBuilder b;
    const std::uint64_t repeat = many(random);
    const double whole = random.log_uniform(1e-3, 1e3) / static_cast<double>(repeat);
    b.add(StackBuilder::group(repeat,
                              {b.layer(dielectric(random), whole),
                               b.layer({dielectric(random), some_absorption(random)}, whole)}));
    return {b.over(substrate(random)), visible(random), random.uniform(0, 89)};
}

/// Two lossless layers at one angle; admittances are those of one polarization.
struct Pair {
    std::array<double, 2> path_nm;  ///< n d cos(theta)
    long double ratio;              ///< of the admittances
};

/// F(q) (even gaps) and G(q) (odd gaps) of a two-layer period, whose zeros are the band edges.
/// Source: FPB24 (CGF 43(2), 2024), eqs. 5 to 9, factored.
long double edge_factor(const Pair& pair, long double q, bool even, long double k0) {
    const long double h = k0 * (pair.path_nm[0] + pair.path_nm[1]) / 2;
    const long double g = k0 * (pair.path_nm[0] - pair.path_nm[1]) / 2;
    return even ? (1 + q) * std::sin(h) + (1 - q) * std::sin(g)
                : (1 + q) * std::cos(h) + (1 - q) * std::cos(g);
}

/// Wavelength of one edge of the gap of that order, by bisection over the half turn of the factor.
double band_edge_nm(const Pair& pair, std::size_t order, bool upper) {
    constexpr long double kPi = std::numbers::pi_v<long double>;
    const bool even = order % 2 == 0;
    const long double q = upper ? pair.ratio : 1 / pair.ratio;
    const long double sum = pair.path_nm[0] + pair.path_nm[1];
    long double low = (static_cast<long double>(order) - 1) * kPi / sum;
    long double high = (static_cast<long double>(order) + 1) * kPi / sum;
    const bool rising = edge_factor(pair, q, even, high) > 0;
    while (true) {
        const long double middle = low + (high - low) / 2;
        if (middle <= low || middle >= high) return static_cast<double>(2 * kPi / middle);
        ((edge_factor(pair, q, even, middle) > 0) == rising ? high : low) = middle;
    }
}

/// Layers of indices n and thicknesses d; along is n0 sin(theta).
Pair pair_of(const std::array<double, 2>& n, const std::array<double, 2>& d, double along, bool s) {
    std::array<double, 2> q{};
    for (std::size_t i = 0; i < 2; ++i) q[i] = std::sqrt(n[i] * n[i] - along * along);
    return {{d[0] * q[0], d[1] * q[1]},
            s ? q[1] / q[0] : (q[1] / (n[1] * n[1])) / (q[0] / (n[0] * n[0]))};
}

StackCase band_edge(Random& random) {
    const std::array n{dielectric(random), dielectric(random)};
    const std::array d{random.uniform(50, 300), random.uniform(50, 300)};
    const double angle = random.one_in(4) ? 0 : random.uniform(0, 85);
    const double sine = std::sin(angle / kDegrees);
    const bool s = random.one_in(2);
    const Pair pair = pair_of(n, d, sine, s);
    StackBuilder b;
    b.add(StackBuilder::group(many(random), {b.layer(n[0], d[0]), b.layer(n[1], d[1])}));
    const double edge = band_edge_nm(pair, 1 + random.below(6), random.one_in(2));
    return {b.over(substrate(random)), beside(edge, random), angle};
}

/// An embedded mirror at any wavelength, at commensurate phases, or at a band edge.
StackCase hosted_mirror(Random& random) {
    const double host = random.one_in(2) ? 1 : dielectric(random);
    const double contrast = random.one_in(4) ? random.log_uniform(1e-12, 1) : 0;
    const std::array n{host, contrast > 0 ? host * (1 + contrast) : dielectric(random)};
    const std::array d{random.uniform(50, 300), random.uniform(50, 300)};
    const std::uint64_t repeat = random.one_in(2) ? 1 + random.below(50) : many(random);
    double angle = random.one_in(4) ? 0 : random.uniform(0, 85);
    if (random.one_in(6)) angle = beside(std::atan(n[1] / n[0]) * kDegrees, random);
    const double along = host * std::sin(angle / kDegrees);
    StackBuilder b(host);
    const bool turned = random.one_in(2);
    const Element first = b.layer(n[0], d[0]), second = b.layer(n[1], d[1]);
    b.add(StackBuilder::group(repeat,
                              turned ? std::vector{second, first} : std::vector{first, second}));
    double nm = visible(random);
    const bool s = random.one_in(2), travels = along < 0.99 * n[1];
    const Pair pair = pair_of(n, d, travels ? along : 0, s);
    const std::size_t order = 1 + random.below(6);
    if (random.one_in(2)) {
        nm = beside(band_edge_nm(pair, order, random.one_in(2)), random);
    } else if (random.one_in(4)) {
        nm = beside(2 * pair.path_nm[random.below(2)] / static_cast<double>(order), random);
    }
    return {b.over(host), nm, angle};
}

StackCase thousand_layers(Random& random) {
    StackBuilder b;
    const double k = random.one_in(2) ? 0 : random.log_uniform(1e-9, 1e-2);
    const double contrast = random.log_uniform(1e-3, 1.4);
    for (int i = 0; i < 1000; ++i)
        b.add(film(b, random, {1.3 + contrast * random.uniform(0, 1), k * random.uniform(0, 1)}, 5,
                   300));
    return {b.over(substrate(random)), visible(random), random.uniform(0, 85)};
}

StackCase wavelengths(Random& random) {
    StackCase c = ordinary(random);
    c.wavelength_nm = random.one_in(8) ? 1 : random.log_uniform(1, 1e6);
    return c;
}

StackCase nested(Random& random) {
    StackBuilder b;
    const auto layer = [&] {
        return film(b, random,
                    {dielectric(random), random.one_in(3) ? random.log_uniform(1e-9, 0.1) : 0}, 5,
                    300);
    };
    const std::uint64_t inside = many(random, 1e4), outside = many(random, 1e4);
    const Element inner = StackBuilder::group(inside, {layer(), layer()});
    b.add(StackBuilder::group(outside, {inner, layer()}));
    if (random.one_in(2)) b.add(layer());
    b.add(StackBuilder::group(inside + 1, {layer(), layer(), layer()}));
    if (random.one_in(4)) b.add(StackBuilder::group(outside, {layer()}));
    return {b.over(substrate(random)), visible(random), random.uniform(0, 85)};
}

StackCase thin(Random& random) {
    StackBuilder b;
    for (std::size_t left = 1 + random.below(4); left > 0; --left) {
        constexpr std::array kSpecial{0.0, 1e-300, 5e-324, 1e-30};
        const double d =
            random.one_in(2) ? kSpecial[random.below(4)] : random.log_uniform(1e-20, 1);
        b.add(b.layer({dielectric(random), some_absorption(random)}, d));
    }
    const double angle =
        random.one_in(2) ? random.uniform(0, 89) : 90 - random.log_uniform(1e-9, 1);
    return {b.over(substrate(random)), visible(random), angle};
}

StackCase matched(Random& random) {
    const double n0 = random.uniform(1, 2.5);
    StackBuilder b(n0);
    const Complex below = random.one_in(2) ? Complex(n0) : substrate(random);
    for (std::size_t left = 1 + random.below(3); left > 0; --left)
        b.add(any_film(b, random, random.one_in(2) ? Complex(n0) : below, 1, 1e5));
    const double angle =
        random.one_in(2) ? random.uniform(0, 89) : 90 - random.log_uniform(1e-9, 1);
    return {b.over(below), visible(random), angle};
}

StackCase brewster(Random& random) {
    const double n0 = random.one_in(2) ? 1 : random.uniform(1, 2), n = dielectric(random);
    StackBuilder b(n0);
    if (random.one_in(2)) b.add(film(b, random, n, 5, 500));
    if (random.one_in(4))
        b.add(StackBuilder::group(many(random, 1e4), {b.layer(n0, 100), b.layer(n, 100)}));
    const Complex below = random.one_in(2) ? Complex(n) : Complex(n, some_absorption(random));
    return {b.over(below), visible(random), beside(std::atan(n / n0) * kDegrees, random)};
}

StackCase metal_cavity(Random& random) {
    StackBuilder b;
    const Complex mirror{random.log_uniform(1e-3, 0.3), random.uniform(2, 7)};
    // the two walls together take up to 1e-300 of the power
    const double nm = visible(random);
    const double wall_nm = random.uniform(0.5, 172) * nm / (4 * std::numbers::pi * mirror.imag());
    b.add(b.layer(mirror, wall_nm * random.uniform(0.1, 1)));
    b.add(film(b, random, {dielectric(random), random.one_in(2) ? 0 : some_absorption(random)}, 5,
               2000));
    b.add(b.layer(mirror, 2 * wall_nm));
    return {b.over(substrate(random)), nm, random.uniform(0, 89)};
}

StackCase x_ray(Random& random) {
    const auto index = [&] {
        const double less = random.log_uniform(1e-6, 1e-2);
        return Complex(1 - less, less * random.log_uniform(1e-3, 1));
    };
    StackBuilder b;
    const std::uint64_t periods = 1 + random.below(500);
    if (random.one_in(2)) b.add(film(b, random, index(), 0.5, 100));
    if (random.one_in(2))
        b.add(StackBuilder::group(
            periods, {film(b, random, index(), 0.5, 5), film(b, random, index(), 0.5, 5)}));
    const double angle =
        random.one_in(4) ? random.uniform(0, 90) : 90 - random.log_uniform(1e-3, 20);
    return {b.over(index()), random.log_uniform(1, 30), angle};
}

StackCase absorbing_gap(Random& random) {
    const double n0 = random.uniform(1.4, 2.7), gap = n0 * random.uniform(0.3, 0.95);
    StackBuilder b(n0);
    b.add(any_film(b, random, {gap, random.log_uniform(1e-15, 0.1)}, 1, 1e5));
    if (random.one_in(2)) b.add(b.layer({dielectric(random), some_absorption(random)}, 80));
    const double critical_deg = critical_angle_deg(gap, n0);
    const double angle =
        random.one_in(3) ? beside(critical_deg, random) : random.uniform(critical_deg, 89.9);
    return {b.over(random.one_in(2) ? Complex(n0) : substrate(random)), visible(random), angle};
}

/// A spacer between two quarter-wave mirrors, at or near its resonance.
StackCase resonator(Random& random) {
    const double low = random.uniform(1.3, 1.6), high = random.uniform(1.8, 2.6);
    const double nm = visible(random);
    const std::uint64_t pairs = 2 + random.below(25);
    const double k = random.one_in(2) ? 0 : random.log_uniform(1e-15, 1e-4);
    StackBuilder b;
    const Element h = b.layer({high, k}, nm / (4 * high)), l = b.layer(low, nm / (4 * low));
    b.add(StackBuilder::group(pairs, {h, l}));
    b.add(h);
    b.add(b.layer(low, nm / (2 * low) * static_cast<double>(1 + random.below(20))));
    b.add(StackBuilder::group(pairs, {h, l}));
    b.add(h);
    return {b.over(1), beside(nm, random), random.one_in(2) ? 0 : random.log_uniform(1e-9, 1)};
}

StackCase small_index(Random& random) {
    StackBuilder b;
    const auto tiny = [&] {
        return Complex(random.log_uniform(1e-6, 0.5),
                       random.one_in(2) ? 0 : random.log_uniform(1e-9, 0.5));
    };
    b.add(any_film(b, random, tiny(), 1, 1e4));
    if (random.one_in(2)) b.add(film(b, random, dielectric(random), 5, 500));
    const Complex below = random.one_in(3) ? tiny() : substrate(random);
    const double angle = random.one_in(3) ? 0 : random.log_uniform(1e-9, 89);
    return {b.over(below), visible(random), angle};
}

/// Periods of layers beyond their critical angle and of others that light tunnels between.
StackCase frustrated_mirror(Random& random) {
    const double n0 = random.uniform(1.5, 4), gap = random.uniform(1, 1.4);
    StackBuilder b(n0);
    std::vector<Element> period{any_film(b, random, gap, 100, 2e4)};
    period.push_back(film(b, random, random.one_in(2) ? n0 : random.uniform(1.4, 4), 50, 500));
    if (random.one_in(2)) period.push_back(film(b, random, random.uniform(1, 4), 10, 500));
    b.add(StackBuilder::group(many(random), std::move(period)));
    const double critical_deg = critical_angle_deg(gap, n0);
    const double angle = critical_deg + (90 - critical_deg) * random.uniform(0, 0.99);
    return {b.over(random.one_in(2) ? n0 : random.uniform(1, 4)), visible(random), angle};
}

/// Groups nested three deep, in gaps and beyond critical angles.
StackCase nested_gaps(Random& random) {
    const bool frustrated = random.one_in(2);
    StackBuilder b(frustrated ? random.uniform(1.5, 3) : 1);
    const auto layer = [&] {
        return any_film(b, random, random.uniform(frustrated ? 1 : 1.2, 2.7), 5,
                        frustrated ? 3000 : 500);
    };
    std::vector<Element> inner{layer(), layer()};
    if (random.one_in(2)) inner.push_back(layer());
    std::vector<Element> outer{layer(), StackBuilder::group(2 + random.below(12), inner), layer()};
    if (random.one_in(3))
        outer.push_back(StackBuilder::group(
            2 + random.below(3),
            {layer(), StackBuilder::group(2 + random.below(3), {layer(), layer()})}));
    b.add(StackBuilder::group(2 + random.below(2000), std::move(outer)));
    return {b.over(random.uniform(1, 2.5)), visible(random), random.uniform(0, 89)};
}

/// Layers and periods with one medium exactly at its critical angle: 1 under 2, at 30 degrees.
StackCase critical_period(Random& random) {
    StackBuilder b(2);
    std::vector<Element> period{any_film(b, random, 1, 1, 1e4),
                                film(b, random, random.uniform(1.2, 3), 10, 500)};
    if (random.one_in(2))
        period.push_back(film(b, random, random.one_in(2) ? 1 : random.uniform(1, 4), 10, 500));
    b.add(StackBuilder::group(1 + random.below(1000), std::move(period)));
    return {b.over(random.one_in(2) ? 2 : random.uniform(1.2, 4)), visible(random), 30};
}

/// (H L)^N 2H (L H)^N, at and near its resonance.
StackCase twin_mirrors(Random& random) {
    const double nm = random.uniform(400, 700);
    const double high = random.uniform(1.9, 2.6), low = random.uniform(1.35, 1.55);
    const auto pairs = static_cast<std::uint64_t>(random.log_uniform(2, 500));
    StackBuilder b;
    const Element h = b.layer(high, nm / (4 * high)), l = b.layer(low, nm / (4 * low));
    b.add(StackBuilder::group(pairs, {h, l}));
    b.add(b.layer(high, nm / (2 * high)));
    b.add(StackBuilder::group(pairs, {l, h}));
    const double angle = random.one_in(2) ? 0 : random.log_uniform(1e-3, 30);
    return {b.over(random.one_in(2) ? 1 : 1.52),
            random.one_in(2) ? nm : nm * (1 + random.log_uniform(1e-15, 1e-3)), angle};
}

/// Metal-dielectric periods, T down to 1e-300.
StackCase metal_periods(Random& random) {
    StackBuilder b;
    const Complex inside{random.uniform(0.05, 1), random.uniform(1, 7)};
    std::vector<Element> period{film(b, random, inside, 5, 100)};
    const double k = random.one_in(2) ? 0 : random.log_uniform(1e-4, 1);
    period.push_back(film(b, random, {dielectric(random), k}, 5, 300));
    b.add(StackBuilder::group(10 + random.below(90), std::move(period)));
    return {b.over(random.uniform(1, 2)), visible(random), random.uniform(0, 85)};
}

constexpr std::array kRegimes{
    Regime{"ordinary", "1 to 8 films on glass or metal, 0 to 85 degrees", true, ordinary},
    Regime{"grazing", "1 to 1e-13 degrees below 90", true, grazing},
    Regime{"critical", "a film's or the substrate's critical angle, and beside it", true, critical},
    Regime{"evanescent", "frustrated reflection through gaps of 1 nm to 1 mm", true, evanescent},
    Regime{"absorber", "k of 1e-9 to 10, 1 nm to 1 m thick", true, absorber},
    Regime{"gain", "films with k of -1e-12 to -0.5", false, gain},
    Regime{"dense_metal", "0.05 + 60i and up to k = 1e4, film and substrate", true, dense_metal},
    Regime{"near_equal", "indices that differ by 1e-16 to 1e-2", true, near_equal},
    Regime{"repeats_pair", "lossless two-layer periods, up to 1e9 of them", true, repeats_pair},
    Regime{"repeats_triple", "3 to 5 lossless layers, up to 1e9 times", true, repeats_triple},
    Regime{"repeats_absorbing", "periods with k of 1e-15 to 1, up to 1e9", true, repeats_absorbing},
    Regime{"repeats_thin", "periods far thinner than the wavelength", true, repeats_thin},
    Regime{"band_edge", "at and beside edges of up to 1e9 periods", true, band_edge},
    Regime{"hosted_mirror", "1 to 1e9 pairs in the index of one, at edges", true, hosted_mirror},
    Regime{"thousand_layers", "1000 random layers, half of them absorbing", true, thousand_layers},
    Regime{"wavelengths", "ordinary films from 1 nm to 1 mm", true, wavelengths},
    Regime{"nested", "groups in groups, mixed with layers", true, nested},
    Regime{"thin", "thickness 0, 5e-324 and up to 1 nm", true, thin},
    Regime{"matched", "films of the incident medium's or the substrate's index", true, matched},
    Regime{"brewster", "Brewster's angle and beside it", true, brewster},
    Regime{"metal_cavity", "films between metals, T down to 1e-300", true, metal_cavity},
    Regime{"x_ray", "n just below 1, 1 to 30 nm, grazing", true, x_ray},
    Regime{"absorbing_gap", "weak absorbers under total reflection", true, absorbing_gap},
    Regime{"resonator", "spacers between 2 to 26 pairs, at resonance", true, resonator},
    Regime{"small_index", "indices down to 1e-6", true, small_index},
    Regime{"frustrated_mirror", "periods with gaps past their critical angle, up to 1e9", true,
           frustrated_mirror},
    Regime{"nested_gaps", "three levels of groups, in gaps and past critical angles", true,
           nested_gaps},
    Regime{"critical_period", "layers and periods exactly at a critical angle", true,
           critical_period},
    Regime{"twin_mirrors", "(H L)^N 2H (L H)^N at resonance", true, twin_mirrors},
    Regime{"metal_periods", "metal and dielectric, T down to 1e-300", true, metal_periods},
};

}  // namespace

std::span<const Regime> regimes() {
    return kRegimes;
}

const Regime* find_regime(std::string_view name) {
    const auto found = std::ranges::find(kRegimes, name, &Regime::name);
    return found == kRegimes.end() ? nullptr : &*found;
}

}  // namespace irido
