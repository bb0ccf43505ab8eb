#include "core/color/quadrature/sampled_fringes.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/color/stack_color.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/spectrum/spectrum.hpp"
#include "core/truth/regimes.hpp"
#include "tests/oracle/random_stacks.hpp"

using namespace irido;
using oracle::StackBuilder;

namespace {

constexpr std::array kSides{Side::reflected, Side::transmitted};
constexpr std::array kBoth{Polarization::s, Polarization::p};

const Sensitivity& d65() {
    static const Sensitivity sensitivity(observer(2), illuminant("D65"));
    return sensitivity;
}

/// (A^inside B)^outside over (C D E)^(inside + 1), A of two layers.
Stack nested(Random& random, std::uint64_t inside, std::uint64_t outside) {
    StackBuilder b;
    const auto layer = [&] {
        const double k = random.one_in(4) ? random.log_uniform(1e-7, 1e-3) : 0;
        return b.layer({random.uniform(1.3, 2.6), k}, random.uniform(20, 200));
    };
    const Element inner = StackBuilder::group(inside, {layer(), layer()});
    b.add(StackBuilder::group(outside, {inner, layer()}));
    b.add(StackBuilder::group(inside + 1, {layer(), layer(), layer()}));
    return b.over(1.5);
}

std::vector<SampledSum> sums_of(const Stack& stack, double angle_deg,
                                std::span<const std::size_t> fast, double path_nm,
                                std::size_t evaluations = 1U << 21) {
    return sampled_fringes(d65(), {stack, stack, incident_angle(angle_deg), kBoth, fast}, kSides,
                           {1e-6, evaluations, path_nm});
}

double largest_error(const Triple& a, const Triple& b) {
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
    return largest;
}

}  // namespace

TEST_CASE("sampled fringes are those that panels resolve") {
    Random random(8);
    for (int i = 0; i < 3; ++i) {
        const Stack stack = nested(random, 20 + random.below(20), 2 + random.below(4));
        const double angle = random.uniform(1, 70);
        const std::vector<StackColor> exact = stack_color(
            ColorTables(d65()), stack, color_method("quadrature"),
            {.sides = {kSides.begin(), kSides.end()}, .tolerance = 1e-8}, std::span(&angle, 1));
        const std::vector<SampledSum> sums = sums_of(stack, angle, {}, 1e5);
        for (std::size_t side = 0; side < kSides.size(); ++side) {
            CAPTURE(i, oracle::text_of(stack), angle, side, sums[side].evaluations);
            REQUIRE(exact[side].error <= 1e-8);
            CHECK(sums[side].error <= 1e-6);
            CHECK(largest_error(sums[side].xyz, exact[side].xyz) < sums[side].error + 1e-8);
        }
    }
}

TEST_CASE("a limit of points is passed where few more suffice") {
    Random random(8);
    const Stack stack = nested(random, 30, 4);
    const SampledSum enough = sums_of(stack, 40, {}, 1e5)[0];
    REQUIRE(enough.error <= 1e-6);
    const SampledSum near = sums_of(stack, 40, {}, 1e5, enough.evaluations / 4)[0];
    CHECK(near.error <= 1e-6);
    CHECK(near.evaluations > enough.evaluations / 2);
    const Stack longer = nested(random, 300, 40);
    const SampledSum few = sums_of(longer, 40, {}, 100, 1)[0];
    CHECK(few.error > 16e-6);
    CHECK(sums_of(longer, 40, {}, 100, few.evaluations / 2)[0].evaluations == few.evaluations);
}

TEST_CASE("sampled means over the longest element are the sampled fringes", "[slow]") {
    Random random(9);
    const std::vector<std::size_t> first{0};
    for (int i = 0; i < 3; ++i) {
        const Stack stack = nested(random, 20, 500);
        const double angle = random.uniform(1, 70);
        const std::vector<SampledSum> fringes = sums_of(stack, angle, {}, 6e6);
        const std::vector<SampledSum> means = sums_of(stack, angle, first, 1e5);
        for (std::size_t side = 0; side < kSides.size(); ++side) {
            CAPTURE(i, oracle::text_of(stack), angle, side, fringes[side].error, means[side].error);
            CHECK(means[side].evaluations < fringes[side].evaluations);
            // fringes of 3 mm and more leave 5e-7 under D65
            CHECK(largest_error(means[side].xyz, fringes[side].xyz) <
                  means[side].error + fringes[side].error + 5e-7);
        }
    }
}

TEST_CASE("fringes of groups in groups are sampled where they are too many to be followed",
          "[slow]") {
    // random wavelengths, one in each of many equal parts of the spectrum, tell the colour
    const ColorTables tables(d65());
    for (const std::uint64_t seed : {3U, 4U}) {
        Random random(seed);
        const StackCase one = find_regime("nested")->make(random);
        const std::vector<StackColor> colors =
            stack_color(tables, one.stack, {}, {.sides = {kSides.begin(), kSides.end()}},
                        std::span(&one.angle_deg, 1));
        constexpr std::size_t kParts = 40000;
        const WavelengthRange range = d65().support();
        const double width = (range.last_nm - range.first_nm) / kParts;
        std::vector<double> nm;
        for (std::size_t i = 0; i < kParts; ++i)
            nm.push_back(range.first_nm + (static_cast<double>(i) + random.uniform(0, 1)) * width);
        const IndexTable table(one.stack, nm);
        const IncidentAngle at = incident_angle(one.angle_deg);
        const Spectra spectrum = spectra(StackPower(one.stack), table, std::span(&at, 1), {});
        Triple reflected{};
        for (std::size_t i = 0; i < kParts; ++i) {
            const Triple weight = d65().at(nm[i]);
            const double R = (spectrum.s.R[i] + spectrum.p.R[i]) / 2;
            for (std::size_t c = 0; c < 3; ++c) reflected[c] += width * weight[c] * R;
        }
        CAPTURE(seed, colors[0].error, colors[0].evaluations);
        CHECK(colors[0].error <= 1e-6);
        CHECK(colors[1].error <= 1e-6);
        CHECK(largest_error(colors[0].xyz, reflected) < 4e-3);
    }
}
