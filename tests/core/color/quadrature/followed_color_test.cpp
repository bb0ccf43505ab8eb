#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <span>
#include <vector>

#include "core/color/quadrature/quadrature_rule.hpp"
#include "core/color/quadrature/resampling.hpp"
#include "core/color/stack_color.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/math/random.hpp"
#include "tests/oracle/random_stacks.hpp"

using namespace irido;
using oracle::StackBuilder;

namespace {

/// Tolerances below 1e-8 compute every sample of the spectra.
constexpr double kSampled = 1e-9;

std::vector<StackColor> colors_of(const ColorTables& tables, const Stack& stack,
                                  std::span<const double> angles_deg, double tolerance,
                                  Light light) {
    return stack_color(
        tables, stack, color_method("quadrature"),
        {.sides = {Side::reflected, Side::transmitted}, .light = light, .tolerance = tolerance},
        angles_deg, 1);
}

/// Transparent layers and periods; the substrate may reflect totally, and films may tunnel.
Stack transparent_stack(Random& random) {
    StackBuilder b;
    const auto index = [&] { return 1.2 + 1.6 * random.uniform(0, 1); };
    const auto thickness_nm = [&] { return 400 * random.uniform(0, 1) * random.uniform(0, 1); };
    const auto layers =
        static_cast<std::size_t>(1 + 40 * random.uniform(0, 1) * random.uniform(0, 1));
    for (std::size_t i = 0; i < layers; ++i) b.add(b.layer(index(), thickness_nm()));
    if (random.uniform(0, 1) < 0.7) {
        const auto repeat = static_cast<std::uint64_t>(std::exp(6 * random.uniform(0, 1)));
        b.add(StackBuilder::group(
            repeat, {b.layer(index(), thickness_nm()), b.layer(index(), thickness_nm())}));
    }
    if (random.uniform(0, 1) < 0.2) b.add(b.layer(index(), 20000 * random.uniform(0, 1)));
    return b.over(random.uniform(0, 1) < 0.2 ? 1 : index());
}

}  // namespace

TEST_CASE("polynomials are the same at the points of other degrees and of halves") {
    const auto polynomial = [](double x) { return 1 + x * (2 - x * (3 + x * (0.5 - x * x))); };
    const auto point = [](std::size_t j, std::size_t n) {
        return std::cos(std::acos(-1.0) * static_cast<double>(j) / static_cast<double>(n));
    };
    const auto check = [&](const Resampling& by, std::size_t from, std::size_t to, double scale,
                           double shift) {
        CHECK(by.inputs == from + 1);
        for (std::size_t j = 0; j < by.stride; ++j) {
            double sum = 0;
            for (std::size_t i = 0; i <= from; ++i)
                sum += by.columns[i * by.stride + j] * polynomial(point(i, from));
            CHECK(std::abs(sum - (j <= to ? polynomial(scale * point(j, to) + shift) : 0)) < 1e-13);
        }
    };
    for (std::size_t from = 1; from < kDegrees.size(); ++from) {
        for (std::size_t to = 0; to < kDegrees.size(); ++to)
            check(resampling(from, to), kDegrees[from], kDegrees[to], 1, 0);
        for (std::size_t half = 0; half < 2; ++half)
            check(resampling_of_half(from, half), kDegrees[from], kDegrees[from], 0.5,
                  half == 0 ? 0.5 : -0.5);
    }
}

TEST_CASE("colours from interpolated denominators are those of sampled spectra", "[slow]") {
    const Sensitivity sensitivity(observer(2), illuminant("D65"));
    const ColorTables tables(sensitivity);
    Random random(41);
    const std::vector<double> angles_deg{0, 25, 55, 80, 89.5};
    std::size_t fewer = 0, all = 0;
    for (std::size_t i = 0; i < 150; ++i) {
        const Stack stack = transparent_stack(random);
        const Light light = std::array{Light::s, Light::p, Light::unpolarized}[i % 3];
        CAPTURE(i, oracle::text_of(stack));
        const auto exact = colors_of(tables, stack, angles_deg, kSampled, light);
        for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-7}) {
            const auto colors = colors_of(tables, stack, angles_deg, tolerance, light);
            for (std::size_t k = 0; k < colors.size(); ++k) {
                CAPTURE(tolerance, angles_deg[k / 2], k % 2);
                const double off = largest_difference(colors[k].xyz, exact[k].xyz);
                CHECK(off <= colors[k].error + exact[k].error);
                CHECK((colors[k].error <= tolerance || exact[k].error > kSampled));
                if (tolerance == 1e-6) {
                    ++all;
                    if (2 * colors[k].evaluations < exact[k].evaluations) ++fewer;
                }
            }
        }
    }
    CHECK(10 * fewer > all);
}

TEST_CASE("ten thousand layers have the colour that very many wavelengths give", "[slow]") {
    const Sensitivity sensitivity(observer(2), illuminant("D65"));
    const ColorTables tables(sensitivity);
    Random random(43);
    StackBuilder b;
    for (std::size_t i = 0; i < 10000; ++i)
        b.add(b.layer(i % 2 == 0 ? 1.5 : 1.5 + 0.1 * random.uniform(0, 1),
                      50 + 100 * random.uniform(0, 1)));
    const Stack stack = b.over(1.52);
    const std::vector<double> angles_deg{0};
    const ColorRequest request{.tolerance = 1e-4};
    const StackColor color =
        stack_color(tables, stack, color_method("quadrature"), request, angles_deg, 1).front();
    const StackColor equal =
        stack_color(tables, stack, color_method("equal", 200000), request, angles_deg, 1).front();
    CHECK(color.error <= request.tolerance);
    CHECK(largest_difference(color.xyz, equal.xyz) < 2 * request.tolerance);
}
