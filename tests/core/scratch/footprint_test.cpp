#include "core/scratch/footprint.hpp"

#include <catch2/catch.hpp>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/scratch/diffraction.hpp"
#include "core/scratch/lobe_table.hpp"
#include "tests/core/scratch/support.hpp"

using namespace irido;
using namespace irido::test;

namespace {

const Footprint kWorked{Footprint::Kind::ellipse, {}, 150, 80, 20};

}  // namespace

TEST_CASE("a footprint's mean has the values of a 40-digit evaluation", "[scratch]") {
    const Scratch scratch = worked_scratch();
    const FootprintFrame frame = frame_of(kWorked, scratch);
    CHECK(relative(frame.across_um, 82.97875874387034) < 1e-13);
    CHECK(relative(frame.offset_um, -9.330127018922193) < 1e-13);
    CHECK(relative(chord_um(frame), 287.396496353906) < 1e-13);
    const double mean = ellipse_mean(frame.offset_um / 60, frame.across_um / 60);
    CHECK(relative(mean, 0.6763527859375671) < 1e-14);
    CHECK(relative(2 * kPi * 3600 * mean, 15298.739593462446) < 1e-13);
    const VisibleScratch seen(scratch, kVertical, kWorked);
    CHECK(relative(seen.share(), 0.012719706554316024) < 1e-13);
}

// Slips of VWH18: eq. 16 loses a factor pi where footprints are small, eq. 18 counts the area
// twice.
TEST_CASE("published footprint formulas are what they are", "[scratch]") {
    const Scratch scratch = worked_scratch();
    const auto eta2 = [&](FootprintFormula formula, const Footprint& footprint) {
        return published_eta2_um2(formula, footprint, scratch, 60);
    };
    CHECK(relative(eta2(FootprintFormula::length, kWorked), 18338.292961172414) < 1e-13);
    CHECK(relative(eta2(FootprintFormula::blend_as_printed, kWorked), 18338.292961172418) < 1e-13);
    CHECK(relative(eta2(FootprintFormula::blend, kWorked), 18338.292961172418) < 1e-13);
    CHECK(relative(published_density(kWorked, scratch), 0.030493715348010677) < 1e-13);
    const Footprint small{Footprint::Kind::ellipse, {}, 1, 1, 0};
    const double exact = 2 * kPi * 3600 * ellipse_mean(9.330127018922193 / 60, 1.0 / 60);
    CHECK(eta2(FootprintFormula::blend_as_printed, small) / exact < 0.33);
    CHECK(std::abs(eta2(FootprintFormula::blend, small) / exact - 1) < 0.01);
    const double density = VisibleScratch(scratch, kVertical, kWorked).share();
    CHECK(published_density(kWorked, scratch) / density > 2);
}

TEST_CASE("the mean over an ellipse is right for every size", "[scratch]") {
    // many points of a rule that is exact for polynomials, where it is in reach
    Random random(8);
    for (int i = 0; i < 300; ++i) {
        const double h = random.log_uniform(1e-3, 60), s = random.uniform(-1, 1) * (h + 3);
        const double exact = ellipse_mean_by_points(s, h, 2000);
        CHECK(std::abs(ellipse_mean(s, h) - exact) < 1e-14 + 1e-13 * exact);
        CHECK(ellipse_mean(-s, h) == ellipse_mean(s, h));
    }
    // exp(-z) (I0(z) + I1(z))
    for (const double h : {0.1, 1.0, 5.0, 12.0}) {
        const double z = h * h / 2;
        const double exact = std::exp(-z) * (std::cyl_bessel_i(0, z) + std::cyl_bessel_i(1, z));
        CHECK(relative(ellipse_mean(0, h), exact) < 1e-13);
    }
    CHECK(ellipse_mean(0.7, 0) == Approx(std::exp(-0.49)).epsilon(1e-14));
    CHECK(relative(ellipse_mean(0, 1e6), 2 / std::sqrt(kPi) * 1e-6) < 1e-10);
    CHECK(ellipse_mean(1e5 + 8, 1e5) < 1e-20);
    CHECK_THROWS_AS(ellipse_mean(0, -1), DomainError);
    CHECK_THROWS_AS(ellipse_mean(std::nan(""), 1), DomainError);
}

TEST_CASE("means of BRDFs over footprints are those of many points", "[scratch]") {
    Random random(9);
    for (int i = 0; i < 24; ++i) {
        Scratch scratch = random_scratch(random);
        if (i % 2) {
            scratch.start_um = random.uniform(-150, 50);
            scratch.end_um = scratch.start_um + random.uniform(20, 200);
        }
        const ScratchOptics optics{40, DepthPhase::slanted};
        const Footprint footprint{i % 3 ? Footprint::Kind::ellipse : Footprint::Kind::gaussian,
                                  {random.uniform(-40, 40), random.uniform(-40, 40)},
                                  random.uniform(1, i % 3 ? 150 : 40),
                                  random.uniform(1, i % 3 ? 150 : 40),
                                  random.uniform(-180, 180)};
        const UnitVector view = random_direction(random);
        const UnitVector light{random.uniform(-0.002, 0.002) - view[0],
                               random.uniform(-0.002, 0.002) - view[1], view[2]};
        const VisibleScratch seen(scratch, optics, footprint);
        const double mean =
            scratch_brdf(seen, pair_of(seen, optics.depth_phase, light, view), 0.55);
        double sum = 0, share = 0;
        for (const FootprintPoint& point : footprint_points(footprint, 40)) {
            const VisibleScratch there(scratch, optics, point.at);
            sum += point.weight *
                   scratch_brdf(there, pair_of(there, optics.depth_phase, light, view), 0.55);
            share += point.weight * there.share();
        }
        CAPTURE(i, mean, sum, footprint.a1_um, footprint.a2_um);
        CHECK(std::abs(mean - sum) <= 1e-9 * sum + 1e-12);
        CHECK(std::abs(share - seen.share()) <= 1e-9 * share + 1e-14);
    }
    CHECK_THROWS_AS(
        VisibleScratch(worked_scratch(), {}, Footprint{Footprint::Kind::ellipse, {}, 0}),
        DomainError);
}

// power() is a sum of Faddeeva functions over the places of a footprint, the table a Fourier
// integral of what all places see together.
TEST_CASE("tables of lobes hold what the lobes are", "[scratch]") {
    Random random(10);
    for (int i = 0; i < 24; ++i) {
        Scratch scratch = random_scratch(random);
        scratch.start_um = random.uniform(-250, 50);
        scratch.end_um = i % 3 ? scratch.start_um + random.uniform(20, 400) : 5000;
        const Footprint footprint{i % 4 == 1 ? Footprint::Kind::gaussian : Footprint::Kind::ellipse,
                                  {},
                                  random.uniform(1, 90),
                                  random.uniform(1, 90),
                                  random.uniform(-180, 180)};
        const ScratchOptics optics{40, DepthPhase::slanted};
        const VisibleScratch seen = i % 2 ? VisibleScratch(scratch, optics, footprint)
                                          : VisibleScratch(scratch, optics, SurfacePoint{});
        const LobeTable lobe(seen, 0, 300, kInfinity);
        CHECK(lobe.has_ends());
        for (int k = 0; k < 60; ++k) {
            const double y = k % 2 ? random.uniform(-300, 300) : random.uniform(-14, 14);
            CHECK(std::abs(lobe(y) - seen.power(y)) < 1e-10 * seen.power(y) + 1e-13);
        }
        CHECK(lobe(301) == seen.power(301));
        // a part of the range alone is the same
        const LobeTable far(seen, 20, 300, kInfinity), near(seen, 1.5, 9, kInfinity);
        CHECK(std::abs(far(50) - lobe(50)) < 1e-15);
        CHECK(std::abs(near(3) - lobe(3)) < 1e-13);
        CHECK(near(0) == seen.power(0));
        CHECK(LobeTable(seen, 2, 2, kInfinity)(2) == seen.power(2));
    }
    const VisibleScratch endless(worked_scratch(), {}, SurfacePoint{});
    const LobeTable lobe(endless, 0, 300);
    CHECK_FALSE(lobe.has_ends());
    CHECK(lobe(1.5) == endless.power(1.5));
}
