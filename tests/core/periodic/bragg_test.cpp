#include "core/periodic/bragg.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/math/random.hpp"

using namespace irido;

namespace {

using Digits50 = boost::multiprecision::cpp_bin_float_50;

/// Relative error of omega: a few roundings of the period's share and of the result.
constexpr double kTolerance = 2e-15;

const Digits50 kPi50 = boost::math::constants::pi<Digits50>();

/// The zero of a function that changes sign in [low, high], by bisection.
template <class Number, class Function>
Number halved(Number low, Number high, const Function& f, int steps) {
    const bool rises = f(high) > 0;
    for (int i = 0; i < steps; ++i) {
        const Number middle = (low + high) / 2;
        ((f(middle) > 0) == rises ? high : low) = middle;
    }
    return (low + high) / 2;
}

/// Edges and Airy points from the factors of 1 - cos KL and 1 + cos KL and from cos KL itself, all
/// as functions of h = (a + b)/2 in 50 digits.
struct Oracle {
    Digits50 path1, path2, q;

    explicit Oracle(const BraggPeriod& period)
        : path1(period.path1_nm), path2(period.path2_nm), q(period.admittance_ratio) {}

    Digits50 gamma() const { return (path1 - path2) / (path1 + path2); }

    BandGap gap(int m) const {
        const auto zero_of = [&](const Digits50& ratio) {
            const auto factor = [&](const Digits50& h) -> Digits50 {
                if (m % 2 == 0) return (1 + ratio) * sin(h) + (1 - ratio) * sin(gamma() * h);
                return (1 + ratio) * cos(h) + (1 - ratio) * cos(gamma() * h);
            };
            const Digits50 h =
                halved<Digits50>((m - 1) * kPi50 / 2, (m + 1) * kPi50 / 2, factor, 150);
            return static_cast<double>(Digits50(2 * h / (path1 + path2)));
        };
        const double one = zero_of(q), other = zero_of(1 / q);
        return {static_cast<double>(m), std::min(one, other), std::max(one, other)};
    }

    double airy(int m) const {
        const auto cosine = [&](const Digits50& h) -> Digits50 {
            const Digits50 a = h * (1 + gamma()), b = h * (1 - gamma());
            return cos(a) * cos(b) - (q + 1 / q) / 2 * sin(a) * sin(b);
        };
        const Digits50 h = halved<Digits50>(m * kPi50 / 2, (m + 1) * kPi50 / 2, cosine, 150);
        return static_cast<double>(Digits50(2 * h / (path1 + path2)));
    }
};

BraggPeriod random_period(Random& random) {
    BraggPeriod period{random.uniform(20, 700), random.uniform(20, 700),
                       random.log_uniform(0.3, 3)};
    if (random.one_in(4)) period.path1_nm = random.log_uniform(1e-4, 20);
    if (random.one_in(4)) period.path2_nm = random.log_uniform(1e-4, 20);
    if (random.one_in(4)) period.admittance_ratio = random.log_uniform(1e-8, 1e8);
    if (random.one_in(4)) period.admittance_ratio = 1 + random.log_uniform(1e-14, 1e-2);
    return period;
}

double cosine_of_bloch_phase(const BraggPeriod& period, double omega) {
    const double a = omega * period.path1_nm, b = omega * period.path2_nm;
    const double q = period.admittance_ratio;
    return std::cos(a) * std::cos(b) - (q + 1 / q) / 2 * std::sin(a) * std::sin(b);
}

PeriodAt constant(const BraggPeriod& period) {
    return [period](double) { return period; };
}

std::size_t mirrors_to_try() {
    const char* const text = std::getenv("IRIDO_TEST_MIRRORS");
    return text ? std::strtoull(text, nullptr, 10) : 300;
}

}  // namespace

TEST_CASE("edges and Airy points agree with 50 digits", "[bragg][slow]") {
    Random random(5);
    double worst_edge = 0, worst_airy = 0;
    const std::size_t mirrors = mirrors_to_try();
    for (std::size_t i = 0; i < mirrors; ++i) {
        const BraggPeriod period = random_period(random);
        const Oracle oracle(period);
        const int m = 1 + static_cast<int>(random.one_in(3) ? random.below(5000) : random.below(8));
        CAPTURE(period.path1_nm, period.path2_nm, period.admittance_ratio, m);
        const BandGap want = oracle.gap(m), got = band_gap(period, m);
        for (const double error :
             {got.low_per_nm / want.low_per_nm - 1, got.high_per_nm / want.high_per_nm - 1}) {
            CHECK(std::abs(error) < kTolerance);
            worst_edge = std::max(worst_edge, std::abs(error));
        }
        const double airy = omega_of_airy(period, m - 1) / oracle.airy(m - 1) - 1;
        CHECK(std::abs(airy) < kTolerance);
        worst_airy = std::max(worst_airy, std::abs(airy));
    }
    CAPTURE(mirrors, worst_edge, worst_airy);
    if (mirrors > 1000) WARN("worst edge " << worst_edge << ", worst Airy point " << worst_airy);
    CHECK(std::max(worst_edge, worst_airy) < kTolerance);
}

TEST_CASE("halving cos KL finds the edges of open gaps", "[bragg]") {
    Random random(6);
    for (int i = 0; i < 300; ++i) {
        const BraggPeriod period{random.uniform(50, 500), random.uniform(50, 500),
                                 random.uniform(1.2, 3)};
        for (const int m : {1, 2, 3, 4}) {
            const BandGap gap = band_gap(period, m);
            if (gap.high_per_nm - gap.low_per_nm < 1e-3 * gap.low_per_nm) continue;
            const double side = m % 2 == 0 ? 1 : -1;
            const auto past_edge = [&](double omega) {
                return side * cosine_of_bloch_phase(period, omega) - 1;
            };
            // between the Airy points, cos KL passes 1 only at the edges
            const double centre = gap.centre_per_nm();
            const double low = halved(omega_of_airy(period, m - 1), centre, past_edge, 60);
            const double high = halved(centre, omega_of_airy(period, m), past_edge, 60);
            CAPTURE(period.path1_nm, period.path2_nm, period.admittance_ratio, m);
            // its rounding error divided by its slope at the edge, which decreases with the gap's
            // width
            const double tolerance = 1e-14 * centre / (gap.high_per_nm - gap.low_per_nm);
            CHECK(std::abs(low / gap.low_per_nm - 1) < tolerance);
            CHECK(std::abs(high / gap.high_per_nm - 1) < tolerance);
            CHECK(std::abs(past_edge(gap.low_per_nm)) < 1e-13);
            CHECK(std::abs(past_edge(gap.high_per_nm)) < 1e-13);
            CHECK(past_edge(centre) > 0);
        }
    }
}

TEST_CASE("modes, Airy points and gaps follow each other", "[bragg]") {
    Random random(7);
    for (int i = 0; i < 300; ++i) {
        const BraggPeriod period = random_period(random);
        CAPTURE(period.path1_nm, period.path2_nm, period.admittance_ratio);
        for (const double m : {1.0, 2.0, 3.0, 17.0, 1000.0}) {
            const BandGap gap = band_gap(period, m);
            const double mode = omega_of_mode(period, m);
            CHECK(omega_of_airy(period, m - 1) <= gap.low_per_nm);
            CHECK(gap.low_per_nm <= mode);
            CHECK(mode <= gap.high_per_nm);
            CHECK(gap.high_per_nm <= omega_of_airy(period, m));
        }
    }
}

TEST_CASE("a closed gap has two equal edges at its mode", "[bragg]") {
    Random random(8);
    for (int i = 0; i < 300; ++i) {
        const double unit = random.uniform(30, 300);
        const auto j = static_cast<double>(1 + random.below(9));
        const auto k = static_cast<double>(1 + random.below(9));
        const double q = random.log_uniform(1e-3, 1e3);
        // j and k quarter waves: gap j + k, of half waves, is closed
        const BraggPeriod commensurate{j * unit, k * unit, q};
        const BraggPeriod matched{unit, random.uniform(1, 999), 1 + 2e-16};
        for (const BraggPeriod& period : {commensurate, matched}) {
            for (const double m : {j + k, 3 * (j + k), 100 * (j + k)}) {
                const BandGap gap = band_gap(period, m);
                CAPTURE(period.path1_nm, period.path2_nm, period.admittance_ratio, m);
                CHECK_FALSE(gap.is_open());
                CHECK(gap.low_per_nm == gap.high_per_nm);
                CHECK(gap.low_per_nm == omega_of_mode(period, m));
            }
        }
    }
    // and a layer of zero thickness closes all gaps
    for (const double m : {1.0, 2.0, 77.0}) CHECK_FALSE(band_gap({0, 200, 1.5}, m).is_open());
}

TEST_CASE("the width of a narrow gap has its digits", "[bragg]") {
    // first order in q - 1, m = 1, quarter waves: width / centre = (2/pi) (q - 1)
    const BandGap gap = band_gap({100, 100, 1 + 1e-6}, 1);
    const double share = (gap.high_per_nm - gap.low_per_nm) / gap.centre_per_nm();
    CHECK(std::abs(share / (2e-6 / std::numbers::pi) - 1) < 1e-6);
    // for any q: 4/pi asin((q - 1)/(q + 1))
    const BandGap wide = band_gap({100, 100, 2.0}, 1);
    const double width = (wide.high_per_nm - wide.low_per_nm) / wide.centre_per_nm();
    CHECK(std::abs(width - 4 / std::numbers::pi * std::asin(1.0 / 3)) < 1e-15);
}

TEST_CASE("s and p agree at normal incidence, p's gaps close at Brewster's angle", "[bragg]") {
    const RealLayer first{1.2, 130}, second{1.7, 210};
    const BraggPeriod s = bragg_period(first, second, 1, 1, Polarization::s);
    const BraggPeriod p = bragg_period(first, second, 1, 1, Polarization::p);
    for (const double m : {1.0, 2.0, 5.0}) {
        CHECK(std::abs(band_gap(s, m).low_per_nm / band_gap(p, m).low_per_nm - 1) < 1e-15);
        CHECK(std::abs(band_gap(s, m).high_per_nm / band_gap(p, m).high_per_nm - 1) < 1e-15);
    }
    const double sine = 1.2 * 1.7 / std::hypot(1.2, 1.7);
    CHECK(reaches_brewster(1.2, 1.7, 1));
    CHECK_FALSE(reaches_brewster(1.46, 2.4, 1));
    const BraggPeriod closed =
        bragg_period(first, second, 1, std::sqrt(1 - sine * sine), Polarization::p);
    CHECK(std::abs(closed.admittance_ratio - 1) < 1e-15);
    CHECK_FALSE(band_gap(closed, 1).is_open());
    CHECK(band_gap(bragg_period(first, second, 1, std::sqrt(1 - sine * sine), Polarization::s), 1)
              .is_open());
}

TEST_CASE("a range holds all its landmarks in order", "[bragg]") {
    Random random(9);
    for (int i = 0; i < 100; ++i) {
        const BraggPeriod period = random_period(random);
        const OmegaRange range{random.uniform(0.002, 0.01), random.uniform(0.01, 0.05)};
        const auto found = landmarks(constant(period), range);
        std::size_t want = 0;
        const auto count = [&](double omega) {
            if (omega >= range.low_per_nm && omega <= range.high_per_nm) ++want;
        };
        for (double m = 0; m < 60; ++m) {
            count(omega_of_airy(period, m));
            if (m == 0) continue;
            count(omega_of_mode(period, m));
            count(omega_of_zero(period, m));
            count(band_gap(period, m).low_per_nm);
            count(band_gap(period, m).high_per_nm);
        }
        CAPTURE(period.path1_nm, period.path2_nm, period.admittance_ratio);
        CHECK(found.size() == want);
        CHECK(std::ranges::is_sorted(found, {}, &Landmark::omega_per_nm));
        for (const BandGap& gap : band_gaps(constant(period), range)) {
            CHECK(gap.high_per_nm >= range.low_per_nm);
            CHECK(gap.low_per_nm <= range.high_per_nm);
        }
    }
}

TEST_CASE("with dispersion every landmark has the indices at its own place", "[bragg]") {
    // Cauchy's n = A + B omega^2 in both layers, at 40 degrees
    const PeriodAt period = [](double omega) {
        const RealLayer first{2.2 + 300 * omega * omega, 300},
            second{1.45 + 60 * omega * omega, 500};
        return bragg_period(first, second, 1, std::cos(0.7), Polarization::p);
    };
    const OmegaRange range{0.0075, 0.0175};
    const auto found = landmarks(period, range);
    CHECK(found.size() == 19);
    std::size_t edges = 0;
    for (const Landmark& mark : found) {
        const double omega = mark.omega_per_nm;
        const BraggPeriod here = period(omega);
        const BandGap gap = band_gap(here, mark.order);
        CAPTURE(static_cast<int>(mark.kind), mark.order, omega);
        double want = 0;
        if (mark.kind == LandmarkKind::mode) want = omega_of_mode(here, mark.order);
        if (mark.kind == LandmarkKind::airy) want = omega_of_airy(here, mark.order);
        if (mark.kind == LandmarkKind::zero) want = omega_of_zero(here, mark.order);
        if (mark.kind == LandmarkKind::edge)
            want = ++edges % 2 == 1 ? gap.low_per_nm : gap.high_per_nm;
        if (mark.kind == LandmarkKind::edge && std::abs(want / omega - 1) > 1e-14)
            want = gap.low_per_nm + gap.high_per_nm - want;
        CHECK(std::abs(want / omega - 1) < 3e-15);
    }
}

TEST_CASE("what is no period is refused", "[bragg]") {
    const auto at = [](const RealLayer& first, const RealLayer& second, double n0, double cosine) {
        return bragg_period(first, second, n0, cosine, Polarization::s);
    };
    CHECK_THROWS_AS(at({1, 100}, {1.5, 100}, 1.5, 0.5), DomainError);  // evanescent
    CHECK_THROWS_AS(at({1, 100}, {1.5, 100}, 1, 0), DomainError);      // grazing in a layer
    CHECK_THROWS_AS(at({1, 0}, {1.5, 0}, 1, 1), DomainError);
    CHECK_THROWS_AS(at({1, -1}, {1.5, 100}, 1, 1), DomainError);
    CHECK_THROWS_AS(at({1, 100}, {1.5, 100}, 1, std::nan("")), DomainError);
    CHECK_THROWS_AS(landmarks(constant({1e9, 1, 1.5}), {0.007, 0.02}), DomainError);
}
