#include "core/scratch/field.hpp"

#include <catch2/catch.hpp>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/scratch/diffraction.hpp"
#include "core/scratch/ensemble.hpp"
#include "core/scratch/scratch_grid.hpp"
#include "tests/core/scratch/support.hpp"

using namespace irido;
using namespace irido::test;

namespace {

bool same(const Scratch& a, const Scratch& b) {
    return a.point.x_um == b.point.x_um && a.point.y_um == b.point.y_um &&
           a.width_um == b.width_um && a.depth_um == b.depth_um && a.angle_deg == b.angle_deg &&
           a.start_um == b.start_um && a.end_um == b.end_um;
}

const ScratchField kField{40, {200, 3000}, {0.8, 6}, {0.05, 0.6}, {-180, 180}};

}  // namespace

TEST_CASE("a field is the same from everywhere, and for the same seed", "[scratch]") {
    const std::vector<Scratch> wide = scratches_near(kField, 7, 0, {100, -2500}, 2500);
    std::size_t found = 0;
    for (const double x : {-900.0, 300.0, 1200.0})
        for (const double y : {-3300.0, -2600.0}) {
            const std::vector<Scratch> near = scratches_near(kField, 7, 0, {x, y}, 300);
            for (const Scratch& scratch : near)
                CHECK(std::ranges::count_if(
                          wide, [&](const Scratch& s) { return same(s, scratch); }) == 1);
            for (const Scratch& scratch : wide)
                if (distance_um(scratch, {x, y}) <= 300) ++found;
            found -= near.size();
        }
    CHECK(found == 0);
    CHECK_FALSE(same(scratches_near(kField, 8, 0, {}, 300).front(),
                     scratches_near(kField, 7, 0, {}, 300).front()));
    CHECK_FALSE(same(scratches_near(kField, 7, 1, {}, 300).front(),
                     scratches_near(kField, 7, 0, {}, 300).front()));
    // fixed values, so that other machines must draw the same
    const std::vector<Scratch> fixed = scratches_near(kField, 1, 0, {500, 500}, 60);
    REQUIRE(fixed.size() == 7);
    CHECK(std::abs(fixed[0].point.x_um - 697.2411817839) < 1e-9);
    CHECK(std::abs(fixed[0].width_um - 1.4808534758) < 1e-9);
    CHECK(std::abs(fixed[0].angle_deg + 73.6165172099) < 1e-9);
}

TEST_CASE("a field has the count and the ranges asked for", "[scratch]") {
    // scratches whose midpoint lies in 20 mm x 20 mm
    ScratchField field = kField;
    field.count_per_mm2 = 12.5;
    double count = 0, length = 0;
    for (const Scratch& scratch : scratches_near(field, 3, 2, {10000, 10000}, 15000)) {
        const SurfacePoint& p = scratch.point;
        if (p.x_um < 0 || p.x_um >= 20000 || p.y_um < 0 || p.y_um >= 20000) continue;
        ++count;
        length += scratch.end_um - scratch.start_um;
        CHECK((scratch.width_um >= 0.8 && scratch.width_um <= 6));
        CHECK((scratch.depth_um >= 0.05 && scratch.depth_um <= 0.6));
        CHECK(std::abs(scratch.angle_deg) <= 180);
    }
    CHECK(std::abs(count - 5000) < 5 * std::sqrt(5000.0));
    CHECK(std::abs(length / count - 1600) < 5 * 808 / std::sqrt(5000.0));
    field.count_per_mm2 = 0;
    CHECK(scratches_near(field, 3, 2, {}, 5000).empty());
    field.count_per_mm2 = 700;  // the Poisson number is drawn in several parts
    field.length_um = {1, 1};
    const double many = static_cast<double>(scratches_near(field, 3, 2, {0, 0}, 3000).size());
    CHECK(std::abs(many - 700 * kPi * 9) < 5 * std::sqrt(700 * kPi * 9));
    const auto refused = [](auto change) {
        ScratchField bad = kField;
        change(bad);
        CHECK_THROWS_AS(scratches_near(bad, 1, 0, {}, 10), DomainError);
    };
    refused([](ScratchField& f) { f.count_per_mm2 = -1; });
    refused([](ScratchField& f) { f.length_um = {5, 4}; });
    refused([](ScratchField& f) { f.length_um = {0, 4}; });
    refused([](ScratchField& f) { f.width_um = {1, 1e3}; });
    refused([](ScratchField& f) { f.depth_um.high = std::nan(""); });
    CHECK_THROWS_AS(scratches_near({1e6, {1e5, 1e5}}, 1, 0, {}, 1e6), DomainError);
}

TEST_CASE("a grid finds every scratch in reach", "[scratch]") {
    std::vector<Scratch> scratches = scratches_near(kField, 5, 0, {2000, 1500}, 2500);
    scratches.push_back(worked_scratch());  // an infinite one
    const double reach = 180;
    const ScratchGrid grid(scratches, {0, 0}, 4000, 3000, 125, reach);
    CHECK(grid.columns() == 32);
    CHECK(grid.rows() == 24);
    Random random(51);
    std::size_t missed = 0;
    for (int i = 0; i < 3000; ++i) {
        const SurfacePoint at{random.uniform(0, 4000), random.uniform(0, 3000)};
        const auto near = grid.near(at);
        CHECK(std::ranges::is_sorted(near));
        for (std::uint32_t k = 0; k < scratches.size(); ++k)
            if (distance_um(scratches[k], at) <= reach) CHECK(std::ranges::binary_search(near, k));
    }
    CHECK(missed == 0);
    // and few more
    CHECK(static_cast<double>(grid.entries().size()) <
          32 * 24 * 0.35 * static_cast<double>(scratches.size()));
    CHECK(grid.offsets().size() == 32 * 24 + 1);
    CHECK_THROWS_AS(ScratchGrid(scratches, {}, 4000, 3000, 0, 10), DomainError);
    CHECK_THROWS_AS(ScratchGrid(scratches, {}, 1e9, 1e9, 1, 10), DomainError);
}

TEST_CASE("an ensemble is the mean of many scratches", "[scratch]") {
    const UnitVector view = direction_of(30, 10);
    const ScratchOptics optics{20, DepthPhase::slanted};
    for (const double off : {0.0, 1e-13, 0.003, 0.05, 0.4}) {
        const UnitVector light{-view[0] + off * 0.6, -view[1] + off * 0.8, 0.8};
        ScratchEnsemble ensemble{0.01, 1, 0.2};
        const double f = ensemble_brdf(ensemble, optics, light, view, 0.55);
        // positions: the mean of exp(-s_b^2/sigma^2) is rho sqrt(pi) sigma/W; angles: equal steps
        double sum = 0;
        constexpr int kAngles = 40000;
        for (int i = 0; i < kAngles; ++i) {
            Scratch scratch;
            scratch.width_um = 1;
            scratch.depth_um = 0.2;
            scratch.angle_deg = 180.0 * (i + 0.5) / kAngles;
            const VisibleScratch seen(scratch, optics, SurfacePoint{});
            sum += scratch_brdf(seen, pair_of(seen, optics.depth_phase, light, view), 0.55);
        }
        const double mean = sum / kAngles * 0.01 * std::sqrt(kPi) * 20;
        CAPTURE(off);
        CHECK(std::isfinite(f));
        CHECK(relative(f, mean) < 2e-3);
        if (off > 0.01) {
            const double nu = 1 / 0.55;
            const double far = 0.01 * nu * slit_power(1, off, nu) *
                               groove_power(0.2 * (light[2] + view[2]), nu) / (kPi * off);
            CHECK(relative(f, far) < 1e-2);
        }
        // a quarter of the angles, around those that reflect: twice the density
        const double across = std::atan2(0.8, 0.6) / kDegree + 90;
        ensemble.angle_low_deg = across - 45;
        ensemble.angle_high_deg = across + 45;
        if (off > 0.01)
            CHECK(relative(ensemble_brdf(ensemble, optics, light, view, 0.55), 2 * f) < 1e-9);
    }
    CHECK_THROWS_AS(ensemble_brdf({2, 1, 0.1}, optics, view, view, 0.5), DomainError);
    CHECK_THROWS_AS(ensemble_brdf({0.1, 1, 0.1, 10, 5}, optics, view, view, 0.5), DomainError);
}
