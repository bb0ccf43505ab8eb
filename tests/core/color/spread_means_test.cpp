#include "core/color/spread_means.hpp"

#include <array>
#include <catch2/catch.hpp>

#include "core/color/quadrature/quadrature_color.hpp"
#include "core/color/stack_color.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/error.hpp"
#include "core/material/library.hpp"
#include "tests/oracle/random_stacks.hpp"

using namespace irido;
using oracle::Random;
using oracle::spread;
using oracle::StackBuilder;

namespace {

const ColorTables& bulb_light() {
    static const ColorTables tables(Sensitivity(observer(10), illuminant("A")));
    return tables;
}

std::vector<StackColor> colors_by(const ColorAlgorithm& algorithm, const Stack& stack,
                                  double angle_deg, const ColorRequest& request) {
    return stack_color(algorithm, stack, request.sides.size(), std::span(&angle_deg, 1));
}

/// Up to three spread layers with others between them.
Stack stack_of_spreads(Random& random, std::size_t spreads) {
    StackBuilder b(random.one_in(4) ? 1.5 : 1.0);
    const std::array names{"SiO2", "MgF2"};
    for (std::size_t i = 0; i < spreads; ++i) {
        const double nm = random.uniform(60, 600);
        if (random.one_in(3))
            b.add(b.layer({random.uniform(1.5, 2.5), random.one_in(2) ? 0.3 : 0}, 20));
        Element layer = random.one_in(2)
                            ? b.layer(random.uniform(1.4, 2.6), nm)
                            : StackBuilder::layer_of(
                                  b.material(find_material(names[random.below(2)])->material), nm);
        b.add(spread(std::move(layer), nm * random.log_uniform(0.003, 0.14)));
    }
    return random.one_in(2) ? b.over_material(b.material(find_material("Au")->material))
                            : b.over(1.52);
}

/// Compares colours of so many random stacks, of which two thirds must be known.
void check_means(std::uint64_t seed, int count) {
    Random random(seed);
    int known = 0;
    for (int i = 0; i < count; ++i) {
        const Stack stack = stack_of_spreads(random, 1 + static_cast<std::size_t>(i % 3));
        const double angle = random.uniform(0, 88);
        ColorRequest request;
        request.sides = {Side::reflected, Side::transmitted};
        request.light = std::array{Light::s, Light::p, Light::unpolarized}[random.below(3)];
        request.tolerance = std::array{1e-3, 1e-5, 1e-7}[random.below(3)];
        const auto means = spread_means(bulb_light(), stack, request);
        if (!means) continue;
        std::vector<StackColor> found;
        try {
            found = colors_by(*means, stack, angle, request);
        } catch (const DomainError&) {
            continue;  // evanescent waves
        }
        ++known;
        ColorRequest finer = request;
        finer.tolerance = 1e-8;
        const auto right =
            colors_by(*quadrature_color(bulb_light(), stack, finer), stack, angle, finer);
        INFO(i << " " << angle << " " << oracle::text_of(stack));
        for (std::size_t side = 0; side < 2; ++side) {
            CHECK(found[side].error <= request.tolerance);
            CHECK(largest_difference(found[side].xyz, right[side].xyz) <=
                  found[side].error + right[side].error);
        }
    }
    CHECK(3 * known > 2 * count);
}

}  // namespace

TEST_CASE("colours of means over thicknesses are those of mean spectra", "[color][spread]") {
    check_means(51, 15);
}

TEST_CASE("colours of means over more thicknesses are those of mean spectra",
          "[color][spread][slow]") {
    check_means(52, 60);
}

TEST_CASE("means that the vector kernel has not are left to colours and spectra",
          "[color][spread]") {
    StackBuilder b(1.6);
    b.add(spread(b.layer(1.3, 300), 10));
    const Stack stack = b.over(1.5);
    const std::array angles{20.0, 85.0};  // evanescent in the layer at 85 degrees
    ColorRequest request;
    REQUIRE(spread_means(bulb_light(), stack, request));
    const auto found = stack_color(bulb_light(), stack, {}, request, angles);
    for (std::size_t i = 0; i < 2; ++i) {
        const auto right = colors_by(*quadrature_color(bulb_light(), stack, request), stack,
                                     angles[i], request)[0];
        CHECK(largest_difference(found[i].xyz, right.xyz) <= found[i].error + right.error);
    }
    request.simd = SimdLevel::plain;
    CHECK_FALSE(spread_means(bulb_light(), stack, request));
}

TEST_CASE("stacks of other thicknesses than the first one's have their means", "[color][spread]") {
    StackBuilder b;
    b.add(spread(b.layer(1.5, 0), 8));
    b.add(spread(b.layer(2.2, 150), 6));
    Stack stack = b.over(3.5);
    const ColorRequest request;
    const auto means = spread_means(bulb_light(), stack, request);
    REQUIRE(means);
    const auto algorithm = color_algorithm(bulb_light(), stack, {}, request);
    CHECK_THROWS_AS(colors_by(*means, stack, 20, request), DomainError);  // cut at zero
    for (const double nm : {0.0, 20.0, 200.0}) {
        std::get<Layer>(stack.elements[0].value).thickness_nm = nm;
        const StackColor found = colors_by(*algorithm, stack, 20, request)[0];
        const StackColor right =
            colors_by(*quadrature_color(bulb_light(), stack, request), stack, 20, request)[0];
        INFO(nm);
        CHECK(largest_difference(found.xyz, right.xyz) <= found.error + right.error);
        if (nm > 100) CHECK(colors_by(*means, stack, 20, request)[0].xyz == found.xyz);
    }
}

TEST_CASE("three spread layers take the wavelengths of one colour", "[color][spread]") {
    StackBuilder b;
    for (const double n : {1.45, 2.1, 1.6}) b.add(spread(b.layer(n, 250), 12));
    const Stack stack = b.over(1.52);
    const double angle = 30;
    const StackColor color =
        stack_color(bulb_light(), stack, {}, ColorRequest(), std::span(&angle, 1)).front();
    CHECK(color.error <= 1e-6);
    CHECK(color.evaluations < 1000);
}
