#include "core/scratch/diffraction.hpp"

#include <catch2/catch.hpp>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/gauss.hpp"
#include "core/math/sine_integral.hpp"
#include "tests/core/scratch/support.hpp"

using namespace irido;
using namespace irido::test;

namespace {

double point_brdf(const Scratch& scratch, const ScratchOptics& optics, const UnitVector& light,
                  const UnitVector& view, double wavelength_um) {
    const VisibleScratch seen(scratch, optics, SurfacePoint{});
    return scratch_brdf(seen, pair_of(seen, optics.depth_phase, light, view), wavelength_um);
}

}  // namespace

TEST_CASE("a scratch's BRDF has the values of a 40-digit evaluation", "[scratch]") {
    const UnitVector light = direction_of(19.704, 206.496), view = direction_of(20, 40);
    const Scratch scratch = worked_scratch();
    CHECK(relative(point_brdf(scratch, kVertical, light, view, 0.45), 80.8220661071697) < 1e-12);
    CHECK(relative(point_brdf(scratch, kVertical, light, view, 0.55), 74.39398546375082) < 1e-12);
    CHECK(relative(point_brdf(scratch, kVertical, light, view, 0.65), 55.869563589819904) < 1e-12);
}

TEST_CASE("scratches are reciprocal, and amplitudes of one have the power of its BRDF",
          "[scratch]") {
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
        Scratch scratch = random_scratch(random);
        const ScratchOptics optics{random.uniform(10, 80),
                                   i % 2 ? DepthPhase::slanted : DepthPhase::vertical};
        if (i % 3 == 0) {
            scratch.start_um = random.uniform(-200, 100);
            scratch.end_um = scratch.start_um + random.uniform(1, 400);
        }
        const UnitVector view = random_direction(random);
        // half of them near the lobe
        UnitVector light = random_direction(random);
        if (i % 4 < 2)
            light = {random.uniform(-0.01, 0.01) - view[0], random.uniform(-0.01, 0.01) - view[1],
                     view[2]};
        const double wavelength = random.uniform(0.36, 0.83);
        const double f = point_brdf(scratch, optics, light, view, wavelength);
        CHECK(f >= 0);
        CHECK(std::abs(point_brdf(scratch, optics, view, light, wavelength) - f) <=
              1e-12 * f + 1e-300);
        const VisibleScratch seen(scratch, optics, SurfacePoint{});
        CHECK(
            std::abs(coherent_brdf(std::array{seen}, optics.depth_phase, light, view, wavelength) -
                     f) <= 1e-12 * f + 1e-24);
    }
}

// Seen along the normal under the whole sky, a scratch with vertical depth phase reflects rho |d|^2
// times the part of sinc^2 within the horizon, (2/pi) F(k W).
TEST_CASE("the light of a scratch over the hemisphere has its closed total", "[scratch]") {
    const UnitVector view{0, 0, 1};
    for (const double width : {0.8, 2.0})
        for (const double wavelength : {0.45, 0.55}) {
            Scratch scratch;
            scratch.width_um = width;
            scratch.depth_um = 0.1;
            const VisibleScratch seen(scratch, kVertical, SurfacePoint{});
            // int f cos_i dw_i = int int f dxi1 dxi2 over the disc
            double sum = 0;
            constexpr int kPanels = 24;
            const double reach = 7 * wavelength / (kTwoPi * 60);
            for (int panel = 0; panel < kPanels; ++panel)
                for (const GaussNode& node : gauss_legendre<16>()) {
                    const double xi1 = reach * ((2 * panel + 1 + node.x) / kPanels - 1);
                    const double edge = std::sqrt(1 - xi1 * xi1);
                    double across = 0;
                    for (int part = 0; part < kPanels; ++part)
                        for (const GaussNode& inner : gauss_legendre<16>()) {
                            const double xi2 = edge * ((2 * part + 1 + inner.x) / kPanels - 1);
                            const UnitVector light{xi1, xi2, std::sqrt(1 - xi1 * xi1 - xi2 * xi2)};
                            across +=
                                inner.weight *
                                scratch_brdf(seen, pair_of(seen, DepthPhase::vertical, light, view),
                                             wavelength);
                        }
                    sum += node.weight * reach / kPanels * across * edge / kPanels;
                }
            const double whole = seen.share() * groove_power(0.2, 1 / wavelength);
            const double part = 2 / kPi * slit_integral(kTwoPi * width / wavelength);
            CHECK(relative(sum, whole * part) < 1e-6);
            CHECK((part > 0.9 && part < 0.99));
        }
}

TEST_CASE("a long finite scratch is an infinite one, and parts add up coherently", "[scratch]") {
    Random random(2);
    for (int i = 0; i < 300; ++i) {
        const Scratch infinite = random_scratch(random);
        const ScratchOptics optics{random.uniform(20, 60), DepthPhase::slanted};
        const UnitVector view = random_direction(random);
        const UnitVector light{random.uniform(-0.01, 0.01) - view[0],
                               random.uniform(-0.01, 0.01) - view[1], view[2]};
        const double wavelength = random.uniform(0.36, 0.83);
        const double exact = point_brdf(infinite, optics, light, view, wavelength);
        Scratch finite = infinite;
        finite.start_um = -8.5 * 60 - 80;
        finite.end_um = 8.5 * 60 + 80;
        const double scale =
            point_brdf(infinite, optics, {-view[0], -view[1], view[2]}, view, wavelength);
        CHECK(std::abs(point_brdf(finite, optics, light, view, wavelength) - exact) <=
              1e-12 * scale);
        // wherever a scratch is cut, the amplitudes of its parts add to that of the whole
        Scratch first = finite, second = finite;
        first.end_um = second.start_um = random.uniform(-100, 100);
        const auto amplitude = [&](const Scratch& scratch) {
            const VisibleScratch seen(scratch, optics, SurfacePoint{});
            return scratch_amplitude(seen, pair_of(seen, optics.depth_phase, light, view),
                                     wavelength);
        };
        CHECK(std::abs(amplitude(first) + amplitude(second) - amplitude(finite)) <=
              1e-12 * std::sqrt(scale) + 1e-13);
    }
    // the integral along a short one by points, with signs and oscillations
    for (int i = 0; i < 200; ++i) {
        const double start = random.uniform(-9, 8), end = start + random.uniform(0, 6),
                     y = random.uniform(-30, 30);
        Complex sum = 0;
        constexpr int kPanels = 40;
        for (int panel = 0; panel < kPanels; ++panel)
            for (const GaussNode& node : gauss_legendre<16>()) {
                const double t = start + (end - start) * (2 * panel + 1 + node.x) / (2 * kPanels);
                sum += node.weight * (end - start) / (2 * kPanels) *
                       std::polar(std::exp(-t * t / 2), -y * t);
            }
        CHECK(std::abs(gaussian_segment(start, end, y) - std::sqrt(2 / kPi) * sum) < 1e-14);
    }
    CHECK(std::abs(gaussian_segment(-kInfinity, kInfinity, 1.5) - 2 * std::exp(-1.125)) < 1e-15);
}

TEST_CASE("waves of two scratches far apart average to the sum of their powers", "[scratch]") {
    const UnitVector view = direction_of(20, 40);
    Scratch one = worked_scratch(), two = worked_scratch();
    two.point = {-15, 38.3};
    const std::array seen{VisibleScratch(one, kVertical, SurfacePoint{}),
                          VisibleScratch(two, kVertical, SurfacePoint{})};
    double coherent = 0, separate = 0;
    for (int i = 0; i < 4000; ++i) {
        const double wavelength = 0.5 + 0.1 * i / 4000;
        const UnitVector light{-view[0] + 0.3 * 0.5, -view[1] - 0.3 * std::sqrt(0.75), 0.7};
        coherent += coherent_brdf(seen, DepthPhase::vertical, light, view, wavelength);
        for (const VisibleScratch& scratch : seen)
            separate += scratch_brdf(scratch, pair_of(scratch, DepthPhase::vertical, light, view),
                                     wavelength);
    }
    CHECK(relative(coherent, separate) < 0.2);
    CHECK(relative(coherent, separate) > 1e-6);
}

TEST_CASE("scratches out of range are refused by name", "[scratch]") {
    const auto refused = [](auto change) {
        Scratch scratch = worked_scratch();
        ScratchOptics optics;
        change(scratch, optics);
        CHECK_THROWS_AS(VisibleScratch(scratch, optics, SurfacePoint{}), DomainError);
    };
    refused([](Scratch& s, ScratchOptics&) { s.width_um = 0; });
    refused([](Scratch& s, ScratchOptics&) { s.width_um = 101; });
    refused([](Scratch& s, ScratchOptics&) { s.depth_um = -1; });
    refused([](Scratch& s, ScratchOptics&) { s.angle_deg = std::nan(""); });
    refused([](Scratch& s, ScratchOptics&) { s.start_um = 3, s.end_um = 3; });
    refused([](Scratch& s, ScratchOptics&) { s.point.x_um = kInfinity; });
    refused([](Scratch&, ScratchOptics& o) { o.coherence_radius_um = 0; });
    CHECK_THROWS_AS(direction_of(91, 0), DomainError);
    CHECK(doubts_about(worked_scratch(13), {}).size() == 1);
    Scratch deep = worked_scratch(0.1);
    CHECK(doubts_about(deep, {}).size() == 1);
    CHECK(doubts_about(worked_scratch(), {}).empty());
}
