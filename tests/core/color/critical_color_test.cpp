#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/color/stack_color.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/material/library.hpp"
#include "tests/oracle/color_oracle.hpp"
#include "tests/oracle/random_stacks.hpp"
#include "tests/support/d65_tables.hpp"

using namespace irido;
using oracle::Random;
using oracle::StackBuilder;
using test::d65_tables;

namespace {

/// A stack, and an angle at which its substrate's critical angle is passed within the spectrum.
struct CriticalStack {
    Stack stack;
    double wavelength_nm = 0;  ///< at which it is
    double angle_deg = 0;
};

Material random_glass(Random& random) {
    constexpr std::array names{"PMMA",  "polycarbonate", "polystyrene", "PET", "SiO2",
                               "water", "BK7",           "MgF2-film",   "ZrO2"};
    return find_material(names[random.below(names.size())])->material;
}

CriticalStack critical_stack(Random& random) {
    while (true) {
        StackBuilder b(random.uniform(1.5, 2.2));
        const std::size_t incident = random.one_in(2) ? b.material(random_glass(random)) : 0;
        for (std::size_t left = 1 + random.below(3); left > 0; --left) {
            const double nm = random.uniform(2, 400), n = random.uniform(1.2, 2.6);
            if (random.one_in(2)) {
                b.add(StackBuilder::layer_of(b.material(random_glass(random)), nm));
            } else {
                b.add(b.layer({n, random.one_in(4) ? random.log_uniform(1e-3, 1) : 0}, nm));
            }
        }
        const std::size_t below = b.material(random_glass(random));
        CriticalStack result{b.over_material(below), random.uniform(420, 660)};
        result.stack.incident = incident;
        for (Material& material : result.stack.materials) material.outside = Outside::clamp;
        const auto n = [&](std::size_t material) {
            return index_at(result.stack.materials[material], result.wavelength_nm).real();
        };
        const double sine = n(below) / n(incident);
        result.angle_deg = std::asin(std::min(sine, 1.0)) * 180 / std::numbers::pi;
        if (sine < 0.999) return result;
    }
}

StackColor color(const CriticalStack& of, const ColorRequest& request,
                 const ColorMethod& method = color_method("quadrature")) {
    return stack_color(d65_tables(), of.stack, method, request, std::span(&of.angle_deg, 1))
        .front();
}

/// IRIDO_TEST_TOLERANCES: number of stacks to try.
std::size_t stacks_to_try() {
    const char* const text = std::getenv("IRIDO_TEST_TOLERANCES");
    return text ? std::strtoull(text, nullptr, 10) : 0;
}

/// Colours of stacks numbered from `first` on, against tight quadrature.
void check_stacks(std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t i = first; i < last; ++i) {
        Random random(Random(i).bits());
        const CriticalStack of = critical_stack(random);
        ColorRequest request{.sides = {random.one_in(2) ? Side::transmitted : Side::reflected},
                             .light = static_cast<Light>(random.below(3)),
                             .tolerance = 1e-10};
        const Triple exact = color(of, request).xyz;
        for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
            request.tolerance = tolerance;
            CAPTURE(i, oracle::text_of(of.stack), of.angle_deg, tolerance);
            const StackColor fitted = color(of, request), alone = color(of, request, {});
            CHECK(fitted.error <= tolerance);
            CHECK(alone.error <= tolerance);
            CHECK(largest_difference(fitted.xyz, exact) <= fitted.error + 1e-9);
            CHECK(largest_difference(alone.xyz, exact) <= alone.error + 1e-9);
        }
    }
}

}  // namespace

TEST_CASE("colours have their error where a critical angle is passed within the spectrum") {
    check_stacks(0, 12);
}

TEST_CASE("many colours have their error where critical angles are passed", "[slow]") {
    check_stacks(12, 12 + std::max<std::size_t>(stacks_to_try(), 200));
}

TEST_CASE("colours at a critical angle agree with another method") {
    for (const std::uint64_t i : {1U, 2U}) {
        Random random(i);
        const CriticalStack of = critical_stack(random);
        const Triple exact = oracle::stack_xyz(of.stack, observer(2), illuminant("D65"),
                                               of.angle_deg, false, 1e-8, {of.wavelength_nm});
        for (const double tolerance : {1e-4, 1e-6}) {
            const StackColor result = color(of, {.tolerance = tolerance});
            CAPTURE(i, oracle::text_of(of.stack), of.angle_deg, tolerance);
            CHECK(largest_difference(result.xyz, exact) <= result.error + 1e-8);
        }
    }
}
