#include "core/scratch/energy.hpp"

#include <catch2/catch.hpp>
#include <vector>

#include "core/complex.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "tests/core/scratch/support.hpp"

using namespace irido;
using namespace irido::test;

TEST_CASE("a mirror and its scratches reflect all light between them", "[scratch]") {
    // masks of a discrete Fourier transform: the mirror's power is the squared mean amplitude, the
    // rest is diffracted (Parseval)
    Random random(41);
    for (int i = 0; i < 400; ++i) {
        constexpr int kCells = 512;
        const double nu = 1 / random.uniform(0.36, 0.83);
        const std::size_t kinds = 1 + random.below(3);
        std::vector<GrooveShare> grooves(kinds);
        std::vector<std::size_t> cells(kinds);
        std::size_t flat = kCells;
        for (std::size_t k = 0; k < kinds; ++k) {
            cells[k] = random.below(flat / 2);
            flat -= cells[k];
            grooves[k] = {static_cast<double>(cells[k]) / kCells, random.uniform(0, 3)};
        }
        Complex mean = static_cast<double>(flat) / kCells;
        double power = 0;
        for (const GrooveShare& groove : grooves) {
            const Complex wave = std::polar(1.0, kTwoPi * groove.path_um * nu);
            mean += groove.share * wave;
            power += groove.share * std::norm(1.0 - wave);
        }
        const ScratchBalance balance = scratch_balance(grooves, nu, false);
        CHECK(std::abs(balance.base - std::norm(mean)) < 1e-14);
        CHECK(std::abs(balance.base + balance.scratches * power - 1) < 1e-13);
        CHECK((balance.scratches >= 0 && balance.scratches <= 1));
        const ScratchBalance random_overlap = scratch_balance(grooves, nu, true);
        CHECK(std::abs(random_overlap.base + random_overlap.scratches * power - 1) < 1e-13);
    }
    const std::vector<GrooveShare> one{{0.1, 0.28}};
    const double d2 = 4 * std::pow(std::sin(kPi * 0.28 / 0.55), 2);
    const ScratchBalance single = scratch_balance(one, 1 / 0.55, false);
    CHECK(relative(single.base, 1 - d2 * 0.1 * 0.9) < 1e-14);
    CHECK(relative(single.scratches, 0.9) < 1e-14);
}

TEST_CASE("balances hold where grooves cover everything or nothing", "[scratch]") {
    CHECK(scratch_balance({}, 2, false).base == 1);
    const std::vector<GrooveShare> flat{{0.2, 0}}, heavy{{1.5, 0.3}, {0.7, 0.5}};
    CHECK(scratch_balance(flat, 2, false).base == 1);
    CHECK(scratch_balance(flat, 2, false).scratches == 0.8);
    for (const bool overlap : {false, true}) {
        const ScratchBalance balance = scratch_balance(heavy, 2, overlap);
        CHECK((balance.base >= 0 && balance.base <= 1));
        CHECK((balance.scratches >= 0 && balance.scratches <= 1));
    }
    CHECK_THROWS_AS(scratch_balance(std::vector<GrooveShare>{{-1, 0}}, 2, false), DomainError);
    // VWH18's blend at 25 % of the area: between half and one and a half times the light
    double least = 9, most = 0;
    for (double path = 0; path < 1; path += 0.01) {
        const std::vector<GrooveShare> quarter{{0.25, path}};
        const ScratchBalance blend = scratch_balance(quarter, 2, false, ScratchEnergy::blend);
        const double total =
            blend.base + blend.scratches * 0.25 * 4 * std::pow(std::sin(kPi * path * 2), 2);
        least = std::min(least, total), most = std::max(most, total);
    }
    CHECK(std::abs(least - 0.5) < 1e-3);
    CHECK(std::abs(most - 1.5) < 1e-3);
    CHECK(scratch_balance(heavy, 2, false, ScratchEnergy::none).scratches == 1);
}
