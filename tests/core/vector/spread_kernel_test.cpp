#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/spectrum/spectrum.hpp"
#include "tests/oracle/random_stacks.hpp"
#include "tests/support/simd_levels.hpp"

using namespace irido;
using Catch::WithinAbs;
using oracle::spread;
using oracle::StackBuilder;

namespace {

constexpr double kError = 1e-9, kReach = 6;

Needs needs_of_means(double error = kError) {
    return {.A = false, .denominators = true, .spread_error = error, .spread_reach = kReach};
}

/// Layers and groups, `spreads` of the layers spread.
Stack random_spreads(std::size_t spreads, bool absorbs, Random& random) {
    StackBuilder b;
    const auto fixed = [&] {
        const double k = absorbs && random.one_in(2) ? random.log_uniform(1e-3, 2) : 0;
        return b.layer({random.uniform(1.3, 2.4), k}, random.uniform(5, 200));
    };
    for (std::size_t i = 0; i < spreads; ++i) {
        if (random.one_in(3)) b.add(fixed());
        if (random.one_in(4)) b.add(StackBuilder::group(2 + random.below(30), {fixed(), fixed()}));
        const double nm = random.uniform(50, 900);
        const double part = random.log_uniform(0.01, 1);
        if (absorbs && random.one_in(2)) {  // of narrow spreads, or of metals
            const bool is_metal = random.one_in(2);
            const double k = is_metal ? random.uniform(0.3, 4) : random.log_uniform(1e-7, 0.05);
            const double thickness_nm = is_metal ? random.uniform(5, 50) : nm;
            b.add(spread(b.layer({random.uniform(0.3, 2.4), k}, thickness_nm),
                         std::min(8.0, thickness_nm / kReach * part)));
        } else {
            b.add(spread(b.layer(random.uniform(1.3, 2.4), nm), nm / kReach * part));
        }
    }
    if (random.one_in(2)) b.add(fixed());
    return b.over({random.uniform(1.1, 2.5), absorbs ? random.uniform(0, 3) : 0});
}

struct Means {
    Spectra spectra;
    bool known = true;
};
Means means_of(const Stack& stack, const IndexTable& table, std::span<const IncidentAngle> angles,
               const Needs& needs, SimdLevel level) {
    const StackPower power(stack);
    Means means;
    try {
        const SpectrumKernel kernel(power, table.absorbs(), table.amplifies(), needs, level);
        SpectrumMemory memory;
        kernel(table, angles, means.spectra, memory);
    } catch (const DomainError&) {
        means.known = false;
    }
    return means;
}

}  // namespace

TEST_CASE("means by the vector kernel are those of the plain one", "[vector][spread]") {
    for (const SimdLevel level : tested_vector_levels()) {
        Random random(41);
        int known = 0;
        for (int i = 0; i < 36; ++i) {
            const Stack stack =
                random_spreads(1 + static_cast<std::size_t>(i % 3), i % 2 == 1, random);
            std::vector<double> wavelengths;
            for (int w = 0; w < 11; ++w) wavelengths.push_back(random.uniform(380, 780));
            const IndexTable table(stack, wavelengths);
            const double degrees = i % 5 == 0 ? 0 : random.uniform(0, 89);
            const std::vector<IncidentAngle> angle{
                i % 5 == 0 ? IncidentAngle(1) : IncidentAngle(std::cos(degrees * 0.0174532925199))};
            const Means means = means_of(stack, table, angle, needs_of_means(), level);
            if (!means.known) continue;
            ++known;
            const Spectra exact =
                spectra(StackPower(stack), table, angle, {.A = false, .denominators = true});
            INFO(name_of(level) << " " << i << " " << degrees << " " << oracle::text_of(stack));
            for (const auto polarization : {&Spectra::s, &Spectra::p}) {
                const Spectrum &found = means.spectra.*polarization, &right = exact.*polarization;
                for (std::size_t w = 0; w < wavelengths.size(); ++w) {
                    CHECK_THAT(found.R[w], WithinAbs(right.R[w], kError + 1e-11));
                    CHECK_THAT(found.T[w], WithinAbs(right.T[w], kError + 1e-11));
                    // a positive factor apart
                    const Complex a{found.denominator_re[w], found.denominator_im[w]};
                    const Complex b{right.denominator_re[w], right.denominator_im[w]};
                    CHECK_THAT(std::arg(a / b), WithinAbs(0, 1e-9));
                }
            }
        }
        CHECK(known > 20);
    }
}

TEST_CASE("means that the vector kernel does not have are refused", "[vector][spread]") {
    const std::vector<IncidentAngle> straight{IncidentAngle(1)}, steep{IncidentAngle(0.1)};
    const auto is_known = [](const Stack& stack, std::span<const IncidentAngle> angle) {
        const IndexTable table(stack, {500.0, 600.0});
        return means_of(stack, table, angle, needs_of_means(), best_simd_level()).known;
    };
    StackBuilder dense(1.6);
    dense.add(spread(dense.layer(1.3, 300), 10));
    const Stack evanescent = dense.over(1.5);
    CHECK(is_known(evanescent, straight));
    CHECK_FALSE(is_known(evanescent, steep));
    StackBuilder cut;
    cut.add(spread(cut.layer(1.5, 300), 60));
    CHECK_FALSE(is_known(cut.over(1.5), straight));
    StackBuilder empty;
    empty.add(spread(empty.layer(1.5, 300), 10));
    empty.add(spread(empty.layer(1.6, 0), 10));
    CHECK_FALSE(is_known(empty.over(1.5), straight));
    StackBuilder absorbing;
    absorbing.add(spread(absorbing.layer({1.5, 0.1}, 900), 150));  // too many fringes
    CHECK_FALSE(is_known(absorbing.over(1.5), straight));
    StackBuilder repeated;
    repeated.add(
        StackBuilder::group(3, {spread(repeated.layer(1.5, 300), 10), repeated.layer(2, 100)}));
    CHECK_FALSE(is_known(repeated.over(1.5), straight));
    // one layer in a group is one of as many thicknesses
    StackBuilder thrice;
    thrice.add(StackBuilder::group(3, {spread(thrice.layer(1.5, 100), 5)}));
    const Stack stack = thrice.over(2);
    const IndexTable table(stack, {500.0, 600.0});
    const Means means = means_of(stack, table, straight, needs_of_means(), best_simd_level());
    REQUIRE(means.known);
    const Spectra exact = spectra(StackPower(stack), table, straight, {.A = false});
    for (std::size_t w = 0; w < 2; ++w)
        CHECK_THAT(means.spectra.s.R[w], WithinAbs(exact.s.R[w], kError));
}
