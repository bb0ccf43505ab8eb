#include "core/color/bloch/bloch_color.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/color/bloch/bloch_sums.hpp"
#include "core/color/bloch/one_mirror.hpp"
#include "core/color/stack_color.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/error.hpp"
#include "core/math/random.hpp"
#include "core/stack/builder.hpp"
#include "tests/oracle/color_oracle.hpp"
#include "tests/oracle/random_stacks.hpp"
#include "tests/support/d65_tables.hpp"
#include "tests/support/simd_levels.hpp"

using namespace irido;
using Catch::Matchers::Contains;
using test::d65_tables;

namespace {

Stack mirror(std::uint64_t repeat, double n1, double d1, double n2, double d2, double n_in,
             double n_out) {
    StackBuilder b(n_in);
    b.add(StackBuilder::group(repeat, {b.layer(n1, d1), b.layer(n2, d2)}));
    return b.over(n_out);
}

Stack fpb24(std::uint64_t repeat, double d1 = 101, double d2 = 143) {
    return mirror(repeat, 1, d1, 1.5, d2, 1, 1);
}

StackColor color(const Stack& stack, double angle_deg, const ColorMethod& method,
                 const ColorRequest& request = {}) {
    return stack_color(d65_tables(), stack, method, request, std::span(&angle_deg, 1)).front();
}

std::string error(const Stack& stack, const ColorMethod& method, double angle_deg = 0) {
    try {
        color(stack, angle_deg, method);
        return "taken";
    } catch (const DomainError& fault) {
        return fault.what();
    }
}

}  // namespace

TEST_CASE("colours by Bloch waves are those of quadrature", "[bloch_color]") {
    Random random(5);
    for (int i = 0; i < 40; ++i) {
        const double n1 = random.uniform(1, 2), n2 = random.uniform(1, 2.5);
        const double d1 = random.uniform(20, 300), d2 = random.uniform(20, 300);
        const bool hosted = i % 2 == 0;
        const Stack stack =
            mirror(1 + random.below(60), n1, d1, n2, d2, hosted ? n1 : 1, hosted ? n1 : 1.5);
        const double angle = random.uniform(0, hosted ? 30 : 85);
        const auto light = static_cast<Light>(random.below(3));
        const Side side = random.one_in(2) ? Side::reflected : Side::transmitted;
        const ColorRequest request{.sides = {side}, .light = light, .tolerance = 1e-6};
        ColorRequest closely = request;
        closely.tolerance = 1e-9;
        const StackColor exact = color(stack, angle, color_method("quadrature"), closely);
        const StackColor got = color(stack, angle, color_method("bloch"), request);
        CAPTURE(i, oracle::text_of(stack), angle, got.error);
        CHECK(got.method == "bloch");
        if (got.error <= 1e-6) CHECK(largest_difference(got.xyz, exact.xyz) <= 1e-6);
        // one of the two only reports that it cannot
        CHECK(largest_difference(got.xyz, exact.xyz) <= std::max(got.error, 1e-6));
    }
}

TEST_CASE("colours by Bloch waves to 1e-9", "[bloch_color]") {
    for (const double angle : {0.0, 50.0}) {
        const ColorRequest request{.tolerance = 1e-9};
        const Stack stack = mirror(6, 1.45, 90, 2.1, 70, 1.45, 1.45);
        const StackColor got = color(stack, angle / 2, color_method("bloch"), request);
        const StackColor exact =
            color(stack, angle / 2, color_method("quadrature"), {.tolerance = 1e-11});
        CHECK(got.error <= 1e-9);
        CHECK(largest_difference(got.xyz, exact.xyz) < 1e-9);
    }
}

TEST_CASE("one period is one film", "[bloch_color]") {
    StackBuilder b(1.0);
    b.add(b.layer(1.5, 320));
    const Stack film = b.over(1);
    for (const double angle : {0.0, 35.0, 80.0}) {
        const Triple want = color(film, angle, color_method("fourier"), {.tolerance = 1e-9}).xyz;
        const StackColor got = color(fpb24(1, 200, 320), angle, color_method("bloch"));
        CHECK(got.error <= 1e-6);
        CHECK(largest_difference(got.xyz, want) <= 1e-6);
    }
}

TEST_CASE("mirrors of one index reflect nothing, at grazing incidence everything",
          "[bloch_color]") {
    const Stack none = mirror(500, 1.4, 100, 1.4, 140, 1.4, 1.4);
    CHECK(largest_difference(color(none, 30, color_method("bloch")).xyz, {}) < 1e-6);
    CHECK(color(fpb24(20), 90, color_method("bloch")).xyz == d65_tables().sensitivity().white());
    CHECK(largest_difference(color(fpb24(20), 89.99999, color_method("bloch")).xyz,
                             d65_tables().sensitivity().white()) < 1e-4);
}

TEST_CASE("a gap as wide as the visible range is white", "[bloch_color]") {
    const Stack stack = mirror(1000, 1, 137, 4.5, 30.5, 1, 1);
    const StackColor got = color(stack, 0, color_method("bloch"));
    CHECK(largest_difference(got.xyz, d65_tables().sensitivity().white()) < 1e-3);
    CHECK(color(mirror(100000000, 1, 137, 60, 2.3, 1, 1), 0, color_method("bloch")).xyz[1] <=
          1 + 1e-6);
}

TEST_CASE("the colour of very many periods is the integral of the phase average", "[bloch_color]") {
    // R = 1 in gaps, 1 - sin KL / sqrt(sin^2 KL + |C|^2) in bands, without any of irido's code
    const double a = 2 * std::numbers::pi * 101, b = 2 * std::numbers::pi * 1.5 * 143;
    const auto R = [&](double nm) {
        const double C = (1.5 - 1 / 1.5) / 2 * std::sin(b / nm);
        const double cosine = std::cos(a / nm) * std::cos(b / nm) -
                              (1.5 + 1 / 1.5) / 2 * std::sin(a / nm) * std::sin(b / nm);
        const double sine2 = (1 - cosine) * (1 + cosine);
        return sine2 <= 0 ? 1 : 1 - std::sqrt(sine2 / (sine2 + C * C));
    };
    const BraggPeriod period{101, 1.5 * 143, 1.5};
    const BandGap gap = band_gap(period, 1);
    const Triple want = oracle::integrate(
        R, observer(2), illuminant("D65"),
        {2 * std::numbers::pi / gap.low_per_nm, 2 * std::numbers::pi / gap.high_per_nm}, 1e-9);
    for (const std::uint64_t repeat : {20000UL, 1000000UL, 1000000000UL}) {
        const StackColor got = color(fpb24(repeat), 0, {});
        CAPTURE(repeat, got.error);
        CHECK(got.method == "bloch");
        CHECK(got.error <= 1e-6);
        CHECK(largest_difference(got.xyz, want) <= 1e-6);
    }
    // the average alone is independent of the number
    CHECK(largest_difference(color(fpb24(400), 0, color_method("bloch", 1)).xyz, want) < 2e-6);
    CHECK(largest_difference(color(fpb24(20), 0, color_method("bloch", 1)).xyz, want) < 1e-3);
}

TEST_CASE("harmonics bring the average nearer", "[bloch_color]") {
    const Triple exact = color(fpb24(20), 20, color_method("quadrature"), {.tolerance = 1e-9}).xyz;
    double before = 1;
    for (const std::size_t harmonics : {0U, 1U, 3U, 9U}) {
        const StackColor got = color(fpb24(20), 20, color_method("bloch", harmonics + 1));
        const double error = largest_difference(got.xyz, exact);
        CAPTURE(harmonics, error);
        CHECK(std::isinf(got.error));
        CHECK(error < 0.6 * before);
        before = error;
    }
}

TEST_CASE("auto takes Bloch waves where there are many fringes", "[bloch_color]") {
    CHECK(color(fpb24(20), 0, {}).method == "quadrature");
    const StackColor many = color(fpb24(3000), 40, {});
    CHECK(many.method == "bloch");
    CHECK(many.error <= 1e-6);
    // past a critical angle, and where Bloch waves would not work, quadrature takes over
    const Stack thin_gap = mirror(300, 1.5, 100, 1.2, 100, 1.5, 1.5);
    CHECK(color(thin_gap, 60, {}).method == "quadrature");
    const StackColor close = color(fpb24(300), 10, {}, {.tolerance = 1e-10});
    CHECK(close.method == "quadrature");
    CHECK(close.error <= 1e-10);
}

TEST_CASE("sums over Bloch waves do not depend on the instructions", "[bloch_color][simd]") {
    Random random(6);
    const SmoothSensitivity& sensitivity = d65_tables().smooth(2);
    BlochMemory memory;
    for (int i = 0; i < 20; ++i) {
        const BlochMirror at = bloch_mirror(
            {1.3, random.uniform(50, 200)}, {2.2, random.uniform(50, 200)}, 1 + random.below(40), 1,
            1.5, random.uniform(0.1, 1), i % 2 == 0 ? Polarization::s : Polarization::p);
        const BandGap first = band_gap(at.period, 1), second = band_gap(at.period, 2);
        const auto [low, high] = sensitivity.reach();
        const auto inside = [&](double omega) {
            return std::clamp(omega, 2 * std::numbers::pi * low, 2 * std::numbers::pi * high);
        };
        const std::vector<BlochRange> ranges{
            {inside(first.low_per_nm), inside(first.high_per_nm), true, true},
            {inside(first.high_per_nm), inside(second.low_per_nm), false, false},
            {inside(second.low_per_nm), inside(second.high_per_nm), true, false}};
        for (const BlochRange& range : ranges) {
            if (!(range.low < range.high)) continue;
            for (const std::uint64_t terms : {0U, 1U, 4U}) {
                const CosineNodes& nodes = d65_tables().nodes(100);
                const auto sum = [&](SimdLevel level) {
                    return bloch_sum(at, range, terms, nodes, sensitivity, memory, level);
                };
                const Triple plain = sum(SimdLevel::plain);
                for (const SimdLevel level : tested_levels())
                    CHECK(largest_difference(sum(level), plain) < 1e-13);
            }
        }
    }
}

TEST_CASE("the two rules on cosine points", "[bloch_color]") {
    const CosineNodes nodes(24);
    double smooth = 0, root = 0;
    for (std::size_t j = 0; j <= nodes.n; ++j) {
        smooth += nodes.curtis[j] * std::exp(nodes.x[j]);
        root += nodes.trapezoid[j] * std::sqrt(std::max(0.0, 1 - nodes.x[j] * nodes.x[j])) *
                std::exp(nodes.x[j]);
    }
    CHECK(smooth == Approx(std::exp(1) - std::exp(-1)).epsilon(1e-13));
    CHECK(root == Approx(std::numbers::pi * 0.565159103992485).epsilon(1e-13));  // pi I_1(1)
}

TEST_CASE("Bloch waves refuse what is no mirror", "[bloch_color][refused]") {
    const ColorMethod method = color_method("bloch");
    StackBuilder b(1.0);
    b.add(b.layer(1.5, 300));
    CHECK_THAT(error(b.over(1), method), Contains("method bloch needs one group of two"));
    CHECK_THAT(error(mirror(5, 1.5, 100, {1.7}, 100, 1, 1), method), Contains("taken"));
    StackBuilder absorbing(1.0);
    absorbing.add(
        StackBuilder::group(4, {absorbing.layer(1.5, 100), absorbing.layer({2, 0.1}, 80)}));
    CHECK_THAT(error(absorbing.over(1), method), Contains("(got k other than 0)"));
    StackBuilder spread(1.0);
    spread.add(
        StackBuilder::group(4, {spread.layer(1.5, 100), oracle::spread(spread.layer(2, 80), 3)}));
    CHECK_THAT(error(spread.over(1), method), Contains("(got a spread thickness)"));
    CHECK_THAT(error(mirror(3, 1.5, 100, 1.2, 90, 1.5, 1.5), method, 70), Contains("critical"));
    CHECK_THAT(error(mirror(3, 1.5, 1e6, 1.2, 9e6, 1.5, 1.5), method), Contains("at most 1000"));
}
