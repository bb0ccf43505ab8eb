#include "core/periodic/bloch.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/math/random.hpp"
#include "core/stack/builder.hpp"
#include "tests/core/coherent/ask.hpp"

using namespace irido;
using Catch::Matchers::Contains;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

struct Mirror {
    RealLayer first, second;
    std::uint64_t repeat;
    double n_in, n_out, angle_deg;

    BlochMirror in(Polarization polarization) const {
        return bloch_mirror(first, second, repeat, n_in, n_out, cos_of_incidence(angle_deg),
                            polarization);
    }
    Stack stack() const {
        StackBuilder b(n_in);
        b.add(StackBuilder::group(repeat, {b.layer(first.n, first.thickness_nm),
                                           b.layer(second.n, second.thickness_nm)}));
        return b.over(n_out);
    }
};

Mirror random_mirror(Random& random, bool in_its_host) {
    Mirror mirror{};
    mirror.first = {random.uniform(1.2, 2.5), random.uniform(20, 300)};
    mirror.second = {random.uniform(1.2, 2.5), random.uniform(20, 300)};
    mirror.repeat = 1 + random.below(60);
    mirror.n_in = in_its_host ? mirror.first.n : 1;
    mirror.n_out = in_its_host ? mirror.first.n : random.uniform(1, 2);
    mirror.angle_deg = random.uniform(0, in_its_host ? 25 : 85);
    return mirror;
}

}  // namespace

TEST_CASE("T by Bloch waves is that of the whole stack", "[bloch]") {
    Random random(3);
    for (int i = 0; i < 200; ++i) {
        const Mirror mirror = random_mirror(random, i % 2 == 0);
        const double nm = random.uniform(360, 830);
        const Powers want = ask(mirror.stack(), nm, mirror.angle_deg);
        CAPTURE(i, mirror.repeat, nm, mirror.angle_deg);
        // the phases of 60 periods carry 60 roundings
        CHECK(std::abs(bloch_transmittance(mirror.in(Polarization::s), kTurn / nm) - want.s.T) <
              1e-11);
        CHECK(std::abs(bloch_transmittance(mirror.in(Polarization::p), kTurn / nm) - want.p.T) <
              1e-11);
    }
}

TEST_CASE("the series over the Bloch phase sums up to T", "[bloch]") {
    Random random(4);
    int bands = 0;
    for (int i = 0; i < 200; ++i) {
        const Mirror mirror = random_mirror(random, i % 3 == 0);
        const BlochMirror at = mirror.in(i % 2 == 0 ? Polarization::s : Polarization::p);
        const double omega = kTurn / random.uniform(360, 830);
        const BlochPoint point = bloch_point(at, omega);
        CHECK(point.sin2 + point.cos2 == Approx(1).margin(1e-13));
        if (!(point.sin2 > 0 && point.cos2 > 0)) continue;
        const BlochSeries series = bloch_series(at, omega);
        if (std::abs(series.bounce) > 0.9) continue;
        ++bands;
        double sum = 1;
        Complex power = 1;
        for (int m = 1; m < 400; ++m) sum += 2 * (power *= series.bounce).real();
        CHECK(series.average * sum == Approx(bloch_transmittance(at, omega)).epsilon(1e-9));
    }
    CHECK(bands > 60);
}

TEST_CASE("in the host of the first layer the average is FPB24's envelope turned", "[bloch]") {
    // 1 - R = sin KL / sqrt(sin^2 KL + |C|^2)
    const Mirror mirror{{1, 200}, {1.5, 180}, 10, 1, 1, 30};
    const BlochMirror at = mirror.in(Polarization::s);
    const double omega = kTurn / 600, q = at.period.admittance_ratio;
    const BlochPoint point = bloch_point(at, omega);
    const double sine2 = 4 * point.sin2 * point.cos2;
    const double C = (q - 1 / q) / 2 * std::sin(omega * at.period.path2_nm);
    CHECK(bloch_series(at, omega).average == Approx(std::sqrt(sine2 / (sine2 + C * C))));
}

TEST_CASE("Bloch waves of equal layers reflect nothing", "[bloch]") {
    const BlochMirror at = Mirror{{1.4, 100}, {1.4, 130}, 7, 1.4, 1.4, 20}.in(Polarization::p);
    for (const double nm : {400.0, 555.5, 800.0}) {
        CHECK(bloch_transmittance(at, kTurn / nm) == Approx(1).epsilon(1e-13));
        CHECK(std::abs(bloch_series(at, kTurn / nm).bounce) < 1e-13);
        CHECK(bloch_phase_slope(at.period, kTurn / nm) ==
              Approx(
                  (at.period.path1_nm + at.period.path2_nm) *
                  (std::sin(kTurn / nm * (at.period.path1_nm + at.period.path2_nm)) > 0 ? 1 : -1)));
    }
}

TEST_CASE("T is one function across the ends of a gap", "[bloch]") {
    for (const std::uint64_t repeat : {std::uint64_t{1}, std::uint64_t{20}, std::uint64_t{1000}}) {
        const BlochMirror at = Mirror{{1, 101}, {1.5, 143}, repeat, 1, 1, 10}.in(Polarization::s);
        const BandGap gap = band_gap(at.period, 1);
        for (const double edge : {gap.low_per_nm, gap.high_per_nm})
            CHECK(bloch_transmittance(at, edge * (1 - 1e-13)) ==
                  Approx(bloch_transmittance(at, edge * (1 + 1e-13))).epsilon(1e-5));
    }
}

TEST_CASE("a gap of a billion periods is dark, not a fault", "[bloch]") {
    const BlochMirror at = Mirror{{1, 101}, {1.5, 143}, 1000000000, 1, 1, 0}.in(Polarization::s);
    const double T = bloch_transmittance(at, band_gap(at.period, 1).centre_per_nm());
    CHECK(T >= 0);
    CHECK(T < 1e-300);
}

TEST_CASE("Bloch waves are refused past critical angles", "[bloch][refused]") {
    CHECK_THROWS_WITH((Mirror{{1.5, 100}, {1.2, 100}, 5, 1.5, 1.5, 60}.in(Polarization::s)),
                      Contains("critical"));
    CHECK_THROWS_WITH((Mirror{{1.5, 100}, {1.6, 100}, 5, 1.5, 1, 60}.in(Polarization::s)),
                      Contains("critical"));
}

TEST_CASE("quick roots of gaps and Airy points are good to 1e-10", "[bloch][bragg]") {
    Random random(8);
    for (int i = 0; i < 300; ++i) {
        const BraggPeriod period{random.uniform(10, 500), random.uniform(10, 500),
                                 random.uniform(0.2, 5)};
        const auto order = static_cast<double>(1 + random.below(30));
        const BandGap exact = band_gap(period, order);
        const BandGap quick = band_gap(period, order, Roots::quick);
        CHECK(quick.low_per_nm == Approx(exact.low_per_nm).epsilon(1e-10));
        CHECK(quick.high_per_nm == Approx(exact.high_per_nm).epsilon(1e-10));
        CHECK(omega_of_airy(period, order, Roots::quick) ==
              Approx(omega_of_airy(period, order)).epsilon(1e-10));
    }
}
