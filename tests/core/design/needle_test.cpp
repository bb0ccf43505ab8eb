#include "core/design/needle.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.hpp"
#include "tests/core/design/problems.hpp"

using namespace irido;

namespace {

DesignProblem four_layers() {
    return coating(
        {92, 60, 35, 14},
        {.quantity = DesignQuantity::R, .wavelength_nm = steps(400, 700, 10), .angle_deg = {45}});
}

std::vector<NeedleLayer> layers_of(const DesignProblem& problem) {
    std::vector<NeedleLayer> layers;
    for (std::size_t i = 0; i < problem.stack.elements.size(); ++i) {
        const Layer& layer = std::get<Layer>(problem.stack.elements[i].value);
        layers.push_back({layer.material, layer.thickness_nm, i, false});
    }
    return layers;
}

}  // namespace

TEST_CASE("slopes of needles are those of thin layers", "[design]") {
    const DesignProblem problem = four_layers();
    REQUIRE(problem.stack.materials.size() == 4);
    const std::vector<NeedleLayer> layers = layers_of(problem);
    const auto slopes =
        needle_slopes(problem, layers, {layers[0].material, layers[1].material}, best_simd_level());
    // derivatives of merit^2 per nm at the upper faces, from an independent program, as above
    const std::vector<double> exact{-0.0006697417993653577, -0.00015778527331376742,
                                    -4.7380099368561275e-05, 4.548896676734069e-05};
    std::size_t found = 0;
    for (const NeedleSlope& needle : slopes) {
        CHECK(needle.material != layers[needle.layer].material);
        if (needle.depth_nm == 0) {
            CHECK(needle.slope == Approx(exact[needle.layer]).epsilon(1e-9));
            ++found;
        }
        // finite differences for a layer in the middle
        if (needle.depth_nm == 0 || found % 3 != 0) continue;
        const auto objective = [&](double thickness) {
            std::vector<NeedleLayer> with = layers;
            NeedleLayer lower = with[needle.layer];
            lower.thickness_nm -= needle.depth_nm;
            with[needle.layer].thickness_nm = needle.depth_nm;
            with.insert(with.begin() + static_cast<std::ptrdiff_t>(needle.layer) + 1,
                        {{needle.material, thickness}, lower});
            DesignModel model(problem_of_layers(problem, with, 0, 500));
            return model.objective(model.start());
        };
        const double h = 1e-3;
        const double slope = (-3 * objective(0) + 4 * objective(h) - objective(2 * h)) / (2 * h);
        CHECK(needle.slope == Approx(slope).epsilon(1e-4).margin(1e-9));
    }
    CHECK(found == 4);
}

TEST_CASE("layers come and go until a coating is good", "[design][slow]") {
    DesignProblem problem = coating(
        {400},
        {.quantity = DesignQuantity::R, .wavelength_nm = steps(400, 700, 5), .angle_deg = {0}});
    NeedleSettings settings;

    problem.stack.materials.push_back(cauchy(2.25, 0.03));
    // the materials are where coating() has put them
    const std::size_t low = std::get<Layer>(problem.stack.elements[0].value).material;
    const std::size_t high = problem.stack.materials.size() - 1;
    settings.materials = {low, high};
    settings.max_layers = 8;
    settings.min_thickness_nm = 5;
    settings.search.evaluations = 60000;
    const NeedleResult result = needle_search(problem, settings);
    CHECK(result.merit < 0.003);
    CHECK(result.layers.size() <= 8);
    for (std::size_t i = 0; i < result.layers.size(); ++i) {
        CHECK(result.layers[i].thickness_nm >= 5);
        if (i > 0) CHECK(result.layers[i].material != result.layers[i - 1].material);
    }
    settings.search.threads = 1;
    const NeedleResult again = needle_search(problem, settings);
    REQUIRE(again.layers.size() == result.layers.size());
    for (std::size_t i = 0; i < again.layers.size(); ++i)
        CHECK(again.layers[i].thickness_nm == result.layers[i].thickness_nm);
}

TEST_CASE("needles need plain layers", "[design]") {
    DesignProblem problem = four_layers();
    NeedleSettings settings;
    CHECK_THROWS_AS(needle_search(problem, settings), DomainError);
    settings.materials = {0};
    problem.free[0].places.push_back(ThicknessOf{{2}});
    CHECK_THROWS_AS(needle_search(problem, settings), DomainError);
    problem.free[0].places = {RepeatOf{{0}}};
    CHECK_THROWS_AS(needle_search(problem, settings), DomainError);
}
