// Groups with absorbing layers in closed form, compared with the plain kernel, which multiplies
// them out.
#include <catch2/catch.hpp>
#include <cmath>

#include "core/spectrum/spectrum.hpp"
#include "tests/oracle/random_stacks.hpp"
#include "tests/support/simd_levels.hpp"

using namespace irido;
using oracle::StackBuilder;

namespace {

Stack random_stack(Random& random) {
    StackBuilder b(random.uniform(1, 1.6));
    std::vector<Element> period;
    const int layers = 2 + static_cast<int>(random.uniform(0, 3));
    for (int i = 0; i < layers; ++i) {
        const double k = random.one_in(3) ? 0 : std::pow(10, random.uniform(-9, -1));
        period.push_back(b.layer({random.uniform(1.2, 2.6), k}, random.uniform(5, 200)));
    }
    b.add(StackBuilder::group(20 + static_cast<std::uint64_t>(random.uniform(0, 700)), period));
    return b.over(random.uniform(1.2, 2.2));
}

}  // namespace

TEST_CASE("groups that absorb agree with the plain kernel at every level") {
    const std::vector<double> cosines{1, 0.8, 0.3};
    for (const SimdLevel level : tested_vector_levels()) {
        Random random(3);
        for (int i = 0; i < 60; ++i) {
            const Stack stack = random_stack(random);
            const StackPower power(stack);
            const IndexTable table(stack, {430, 500, 555, 610, 700});
            const Needs needs{.A = random.one_in(2), .denominators = false};
            const Spectra fast = spectra(power, table, cosines, needs, {1, level});
            const Spectra plain = spectra(power, table, cosines, needs, {1, SimdLevel::plain});
            for (std::size_t point = 0; point < plain.s.R.size(); ++point) {
                CAPTURE(i, point);
                // up to 720 periods of up to 10 rad, each rounded once, and high-finesse fringes
                CHECK(std::abs(fast.s.R[point] - plain.s.R[point]) < 1e-10);
                CHECK(std::abs(fast.p.T[point] - plain.p.T[point]) < 1e-10);
                if (needs.A) CHECK(std::abs(fast.s.A[point] - plain.s.A[point]) < 1e-10);
            }
        }
    }
}

TEST_CASE("a group that absorbs is the same with its period written twice") {
    for (const double k : {1e-12, 1e-5, 0.03}) {
        StackBuilder b(1);
        const std::vector<Element> pair{b.layer({2.3, k}, 58), b.layer({1.46, 0}, 94)};
        const std::vector<Element> both{pair[0], pair[1], pair[0], pair[1]};
        StackBuilder once = b, twice = b;
        once.add(StackBuilder::group(300, pair));
        twice.add(StackBuilder::group(150, both));
        const Stack a = once.over(1.52), c = twice.over(1.52);
        const std::vector<double> wavelengths{450, 480, 520, 600, 660}, cosines{1, 0.6};
        const Needs needs{.A = false, .denominators = false};
        const Spectra x = spectra(StackPower(a), IndexTable(a, wavelengths), cosines, needs, {1});
        const Spectra y = spectra(StackPower(c), IndexTable(c, wavelengths), cosines, needs, {1});
        for (std::size_t point = 0; point < x.p.R.size(); ++point) {
            CHECK(std::abs(x.s.R[point] - y.s.R[point]) < 1e-11);
            CHECK(std::abs(x.p.R[point] - y.p.R[point]) < 1e-11);
        }
    }
}
