#include "core/color/fourier/film_color.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "core/color/stack_color.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/error.hpp"
#include "core/material/library.hpp"
#include "tests/oracle/color_oracle.hpp"
#include "tests/oracle/random_stacks.hpp"
#include "tests/support/d65_tables.hpp"
#include "tests/support/simd_levels.hpp"

using namespace irido;
using oracle::Kind;
using oracle::Random;
using oracle::StackBuilder;
using test::d65_tables;

namespace {

const std::vector<Side> kBothSides{Side::reflected, Side::transmitted};

Stack one_film(Complex film, double thickness_nm, Complex substrate, Complex incident = 1) {
    StackBuilder b(incident);
    b.add(b.layer(film, thickness_nm));
    return b.over(substrate);
}

Stack spread_film(Complex film, double thickness_nm, double sigma_nm, Complex substrate) {
    StackBuilder b;
    b.add(oracle::spread(b.layer(film, thickness_nm), sigma_nm));
    return b.over(substrate);
}

std::vector<StackColor> colors(const Stack& stack, const std::vector<double>& angles_deg,
                               const ColorRequest& request,
                               const ColorMethod& method = color_method("fourier"),
                               const ColorTables& tables = d65_tables()) {
    std::vector<StackColor> result(angles_deg.size() * request.sides.size());
    (*film_color(tables, stack, method, request))(stack, angles_deg, result);
    return result;
}

StackColor color(const Stack& stack, double angle_deg, const ColorRequest& request = {},
                 const ColorMethod& method = color_method("fourier")) {
    return colors(stack, {angle_deg}, request, method).front();
}

StackColor quadrature(const Stack& stack, double angle_deg, Side side, double tolerance,
                      Light light = Light::unpolarized) {
    return stack_color(d65_tables(), stack, color_method("quadrature"),
                       {.sides = {side}, .light = light, .tolerance = tolerance},
                       std::span(&angle_deg, 1))
        .front();
}

double difference(const Triple& a, const Triple& b) {
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
    return largest;
}

Stack random_film(Random& random) {
    for (;;) {
        const std::size_t kind = random.below(3);
        const Stack stack = oracle::random_stack(kind == 0   ? Kind::film
                                                 : kind == 1 ? Kind::film_on_metal
                                                             : Kind::thick_film,
                                                 random);
        if (is_one_film(stack)) return stack;
    }
}

/// Whether the angle is below the film's own critical angle.
bool enters(const Stack& stack, double angle_deg) {
    const double n1 = index_at(stack.materials[stack.incident], 550).real();
    const double n2 = index_at(stack.materials[only_film(stack).material], 550).real();
    return n1 * std::sin(angle_deg * 3.14159265358979 / 180) < 0.999 * n2;
}

}  // namespace

TEST_CASE("colours of one film are those of the oracle", "[film_color]") {
    Random random(21);
    for (int i = 0; i < 12; ++i) {
        const Stack stack = random_film(random);
        const double angle = oracle::random_angle(random);
        if (!enters(stack, angle)) continue;
        const auto got = colors(stack, {angle}, {.sides = kBothSides, .tolerance = 1e-9});
        for (std::size_t s = 0; s < 2; ++s) {
            const Triple exact =
                oracle::stack_xyz(stack, observer(2), illuminant("D65"), angle, s == 1, 1e-12);
            CAPTURE(oracle::text_of(stack), angle, s, got[s].error);
            CHECK(difference(got[s].xyz, exact) <= got[s].error + 1e-12);
            CHECK(got[s].error <= 1e-9);
            CHECK(got[s].evaluations == 1);
        }
    }
}

TEST_CASE("colours of one film agree with exact integrals to 12 digits", "[film_color]") {
    // exact integrals of the piecewise linear tables, accurate to 1e-12: D65, 2-degree observer
    struct Golden {
        Stack stack;
        double angle_deg;
        Triple xyz;
    };
    for (const Golden& golden : std::vector<Golden>{
             {one_film(1.33, 380, 1), 0, {0.04473156990402, 0.0282067426637, 0.03821696445015}},
             {one_film(1.33, 380, 1), 60, {0.1285727530246, 0.1632541097414, 0.1541063439653}},
             {one_film(2.2, 150, {0.2, 3.4}),
              0,
              {0.8504900485245, 0.8614220253323, 0.940852004983}},
             {one_film(2.2, 150, {0.2, 3.4}),
              60,
              {0.8611870791143, 0.9121162447083, 0.8873943744331}}}) {
        const StackColor got = color(golden.stack, golden.angle_deg, {.tolerance = 1e-12});
        CHECK(difference(got.xyz, golden.xyz) < 2e-12);
        CHECK(difference(color(golden.stack, golden.angle_deg).xyz, golden.xyz) < 1e-6);
    }
}

TEST_CASE("the claimed error is never below the true one", "[film_color]") {
    Random random(31);
    for (int i = 0; i < 60; ++i) {
        const Stack stack = random_film(random);
        const double angle = i % 20 == 0 ? random.uniform(89, 90) : oracle::random_angle(random);
        const Side side = kBothSides[random.below(2)];
        const auto light = static_cast<Light>(random.below(3));
        const StackColor exact = quadrature(stack, angle, side, 1e-11, light);
        if (exact.error > 1e-11) continue;  // lines too sharp for it to resolve
        for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-10}) {
            for (const std::size_t count : {0U, 1U, 3U}) {
                const StackColor got =
                    color(stack, angle, {.sides = {side}, .light = light, .tolerance = tolerance},
                          color_method("fourier", count));
                CAPTURE(oracle::text_of(stack), angle, tolerance, count, got.error);
                CHECK(difference(got.xyz, exact.xyz) <= got.error + 1e-11);
                if (count == 0 && angle < 89 && enters(stack, angle) && tolerance > 1e-9)
                    CHECK(got.error <= tolerance);
            }
        }
    }
}

TEST_CASE("a bare surface and a film of no thickness are one", "[film_color]") {
    for (const Complex base : {Complex(1.5), Complex(0.2, 3.4)}) {
        for (const double angle : {0.0, 60.0, 89.0}) {
            const Triple bare = color(StackBuilder().over(base), angle).xyz;
            CHECK(difference(
                      bare,
                      quadrature(StackBuilder().over(base), angle, Side::reflected, 1e-12).xyz) <
                  1e-12);
            CHECK(color(one_film(1.7, 0, base), angle).xyz == bare);
            CHECK(color(one_film(0.5, 0, base), angle).xyz == bare);
        }
    }
    CHECK(color(one_film(1.5, 300, 2), 90).xyz == d65_tables().sensitivity().white());
}

TEST_CASE("a spread damps every order by its own path", "[film_color]") {
    Random random(41);
    for (int i = 0; i < 12; ++i) {
        const double d = random.uniform(50, 3000), sigma = d / random.uniform(6, 60);
        const Complex base = i % 2 == 0 ? Complex(random.uniform(1, 3))
                                        : Complex(random.uniform(0.1, 3), random.uniform(1, 6));
        const Stack stack = spread_film(random.uniform(1.2, 2.5), d, sigma, base);
        const double angle = oracle::random_angle(random);
        for (const Side side : kBothSides) {
            const StackColor got = color(stack, angle, {.sides = {side}, .tolerance = 1e-9});
            CAPTURE(oracle::text_of(stack), sigma, angle, got.error);
            CHECK(difference(got.xyz, quadrature(stack, angle, side, 1e-10).xyz) <=
                  got.error + 1e-10);
            // six standard deviations above zero, nothing is cut off
            CHECK(got.error <= 2e-9);
        }
    }
}

TEST_CASE("a spread that reaches zero thickness says how much that matters", "[film_color]") {
    for (const auto& [d, sigma] : {std::pair(100.0, 50.0), std::pair(300.0, 100.0),
                                   std::pair(10.0, 200.0), std::pair(0.0, 30.0)}) {
        const Stack stack = spread_film(1.5, d, sigma, {0.3, 3});
        const StackColor got = color(stack, 30);
        const double error = difference(got.xyz, quadrature(stack, 30, Side::reflected, 1e-9).xyz);
        CAPTURE(d, sigma, error);
        CHECK(error <= got.error + 1e-9);
        CHECK(got.error > 1e-6);
        CHECK(got.error < 1);
    }
}

TEST_CASE("an angle without a series is refused, and auto does without it", "[film_color]") {
    const Stack stack = one_film(1.2, 200, 1.6, 1.5);
    CHECK(color(stack, 20).error < 1e-6);
    for (const Stack& without : {stack, one_film(2.5, 400, {2.5, -0.2})})
        CHECK_THROWS_WITH(color(without, 70), Catch::Contains("no Fourier series at 70 degrees"));
    const std::vector<double> angles{20, 70};
    const std::vector<StackColor> by_auto =
        stack_color(d65_tables(), stack, {}, {.colors = 1000000}, angles);
    CHECK(by_auto[0].method == "fourier");
    CHECK(by_auto[1].method == "quadrature");
    for (std::size_t i = 0; i < angles.size(); ++i)
        CHECK(difference(by_auto[i].xyz, quadrature(stack, angles[i], Side::reflected, 1e-9).xyz) <
              1e-6);
    // fringes past the end of the table are left out but counted
    const Stack thick = one_film(1.5, 1e9, 2.5);
    CHECK(color(thick, 0).error < 1e-6);  // even their bound is small
    CHECK(color(one_film(1.5, 2.5e5, {0.05, 5}), 0, {.tolerance = 1e-9}).error > 1e-9);
}

TEST_CASE("many angles are the same as one by one, at every level", "[film_color]") {
    const Stack stack = one_film(1.33, 600, {1.5, 3});
    std::vector<double> angles;
    for (int i = 0; i <= 180; ++i) angles.push_back(i / 2.0);
    const ColorRequest request{.sides = {Side::transmitted, Side::reflected}};
    const auto together = colors(stack, angles, request);
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const auto alone = colors(stack, {angles[i]}, request);
        CHECK(together[2 * i].xyz == alone[0].xyz);
        CHECK(together[2 * i + 1].xyz == alone[1].xyz);
    }
    for (const SimdLevel level : tested_levels()) {
        ColorRequest at_level = request;
        at_level.simd = level;
        const auto same = colors(stack, angles, at_level);
        for (std::size_t i = 0; i < same.size(); ++i)
            CHECK(difference(same[i].xyz, together[i].xyz) < 1e-14);
    }
}

TEST_CASE("one algorithm serves films of other thicknesses", "[film_color]") {
    const auto algorithm =
        film_color(d65_tables(), one_film(1.4, 100, 2), color_method("fourier"), {});
    StackColor got;
    const double angle = 30;
    (*algorithm)(one_film(1.4, 777, 2), std::span(&angle, 1), std::span(&got, 1));
    CHECK(got.xyz == color(one_film(1.4, 777, 2), angle).xyz);
}

TEST_CASE("with dispersion the group path is closer than constant indices", "[film_color]") {
    Random random(51);
    for (const char* name : {"Cu", "Al", "Si", "W", "BK7"}) {
        double group = 0, constant = 0;
        constexpr int count = 20;
        for (int i = 0; i < count; ++i) {
            StackBuilder b;
            const char* film = random.one_in(2) ? "SiO2" : "PMMA";
            b.add(b.layer_of(b.material(find_material(film).value().material),
                             random.uniform(30, 1500)));
            const Stack stack = b.over_material(b.material(find_material(name).value().material));
            REQUIRE(is_one_film(stack));
            REQUIRE(has_dispersion(stack));
            const double angle = random.uniform(0, 80);
            const Triple exact = quadrature(stack, angle, Side::reflected, 1e-7).xyz;
            const StackColor by_group = color(stack, angle);
            CHECK(std::isinf(by_group.error));
            group += difference(by_group.xyz, exact) / count;
            constant +=
                difference(color(stack, angle, {}, color_method("fourier-constant")).xyz, exact) /
                count;
        }
        CAPTURE(name, group, constant);
        CHECK(group < constant / 3);
        CHECK(group < 0.03);
    }
}

TEST_CASE("without dispersion all is exact by either name", "[film_color]") {
    const Stack stack = one_film(1.5, 525, 1.09);
    CHECK_FALSE(has_dispersion(stack));
    const StackColor constant = color(stack, 40, {}, color_method("fourier-constant"));
    CHECK(constant.xyz == color(stack, 40).xyz);
    CHECK(constant.method == "fourier-constant");
}

TEST_CASE("dispersion and a spread go together", "[film_color]") {
    StackBuilder b;
    b.add(oracle::spread(b.layer_of(b.material(find_material("SiO2").value().material), 500), 20));
    const Stack stack = b.over_material(b.material(find_material("Si").value().material));
    const Triple exact = quadrature(stack, 40, Side::reflected, 1e-8).xyz;
    CHECK(difference(color(stack, 40).xyz, exact) < 2e-3);
}

TEST_CASE("what is no film, or out of range, is refused", "[film_color]") {
    StackBuilder two, absorbing, incoherent, group;
    two.add(two.layer(1.4, 100));
    two.add(two.layer(1.5, 100));
    absorbing.add(absorbing.layer({1.4, 0.01}, 100));
    incoherent.add(oracle::incoherent(incoherent.layer(1.4, 100)));
    group.add(StackBuilder::group(2, {group.layer(1.4, 100)}));
    for (const Stack& stack : {two.over(2), absorbing.over(2), incoherent.over(2), group.over(2)}) {
        CHECK_FALSE(is_one_film(stack));
        CHECK_THROWS_AS(color_algorithm(d65_tables(), stack, color_method("fourier"), {}),
                        DomainError);
    }
    const Stack film = one_film(1.4, 100, 2);
    CHECK_THROWS_AS(color(film, 90.5), DomainError);
    CHECK_THROWS_AS(color_algorithm(d65_tables(), film, color_method("fourier"), {.tolerance = 0}),
                    DomainError);
    CHECK_THROWS_AS(color(one_film(1.4, std::nan(""), 2), 0), DomainError);
    CHECK_THROWS_AS(color(one_film(1.4, 100, 2, {1.5, 0.1}), 0), DomainError);
    Material unknown;
    unknown.name = "unknown";
    unknown.model = RefractiveIndex{Table{{450, 600}, {1.5, 1.6}}, Constant{0}};
    StackBuilder b;
    b.add(b.layer_of(b.material(unknown), 100));
    CHECK_THROWS_AS(color(b.over(2), 0), DomainError);
}
