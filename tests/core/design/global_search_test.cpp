#include "core/design/global_search.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/design/problem_values.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/random.hpp"
#include "tests/core/design/problems.hpp"

using namespace irido;

namespace {

constexpr double kBestAntireflection = 0.005993925905931101;  // best known, 2e6 evaluations

DesignProblem near_best() {
    return antireflection({96.1, 115.7, 49.5, 24.6, 38.3, 132.2, 41.3, 15.1});
}

/// A mirror of n = 1 and 1.5, with N and everything else free; the target colours are those of 8
/// periods of 152 and 96 nm (Lab rounded to 1e-6).
DesignProblem mirror() {
    DesignProblem problem;
    StackBuilder builder;
    const std::size_t air = builder.material(Complex(1));
    builder.add(StackBuilder::group(10, {builder.layer(1.0, 150), builder.layer(1.5, 150)}));
    problem.stack = builder.over_material(air);
    problem.stack.materials.push_back(problem.stack.materials[1]);
    auto& elements = std::get<Group>(problem.stack.elements[0].value).elements;
    std::get<Layer>(elements[1].value).material = 2;
    problem.free = {{"N", 10, 6, 11, true, {RepeatOf{{0}}}},
                    {"d1", 150, 40, 500, false, {ThicknessOf{{0, 0}}}},
                    {"d2", 150, 40, 500, false, {ThicknessOf{{0, 1}}}},
                    {"n2", 1.5, 1.2, 2.2, false, {MaterialNumber{2, MaterialNumber::Part::n, 0}}}};
    problem.targets = {
        color_target({0, 10, 20, 30, 40, 50, 60, 70, 80}, {{94.591987, -9.060041, 89.688112},
                                                           {95.656066, -13.300683, 87.308827},
                                                           {97.432672, -21.934914, 75.690791},
                                                           {96.65649, -33.589301, 41.804862},
                                                           {86.338209, -34.864989, -7.460684},
                                                           {71.072225, -13.145748, -26.920717},
                                                           {64.235637, -18.170904, -21.565516},
                                                           {66.084599, 3.811101, -23.361424},
                                                           {79.830161, -10.588934, -15.420119}})};
    problem.merit = MeritKind::delta_e_76;
    return problem;
}

}  // namespace

TEST_CASE("a refinement beside an optimum ends there, inside the bounds", "[design]") {
    const SearchResult result = refine(near_best(), {});
    CHECK(result.merit < 1.0001 * kBestAntireflection);
    CHECK(exact_merit(near_best(), result.x) == Approx(result.merit).epsilon(1e-9));
    for (const double x : result.x) {
        CHECK(x >= 0);
        CHECK(x <= 250);
    }
}

TEST_CASE("refinements never end above their start", "[design]") {
    Random random(5);
    for (const MeritKind merit : {MeritKind::rms, MeritKind::mean_abs, MeritKind::chi2}) {
        for (int i = 0; i < 10; ++i) {
            std::vector<double> start;
            for (int l = 0; l < 5; ++l) start.push_back(random.uniform(0, 250));
            DesignProblem problem = antireflection(start);
            problem.merit = merit;
            if (i % 2) problem.targets[0].target.assign(entry_count(problem.targets[0]), 0.3);
            for (FreeValue& value : problem.free) {
                value.low = std::max(0.0, value.start - random.uniform(0, 60));
                value.high = value.start + random.uniform(0, 60);
            }
            DesignModel model(problem);
            const double before = model.merit(model.objective(start));
            for (const auto& search_of : {least_squares, quasi_newton}) {
                if (merit == MeritKind::mean_abs && search_of == least_squares) continue;
                const LocalResult local = search_of(model, start, {});
                CHECK(model.merit(local.objective) <= before);
                CHECK(model.objective(local.x) == local.objective);
                for (std::size_t l = 0; l < local.x.size(); ++l) {
                    CHECK(local.x[l] >= problem.free[l].low);
                    CHECK(local.x[l] <= problem.free[l].high);
                }
            }
        }
    }
}

TEST_CASE("both local searches find the same optimum from beside it", "[design]") {
    DesignModel model(near_best());
    const LocalResult a = least_squares(model, model.start(), {}),
                      b = quasi_newton(model, model.start(), {});
    CHECK(model.merit(a.objective) == Approx(kBestAntireflection).epsilon(1e-6));
    CHECK(model.merit(b.objective) == Approx(kBestAntireflection).epsilon(1e-3));
}

TEST_CASE("a global search finds the best antireflection coating from any seed", "[design][slow]") {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const SearchResult result = search(
            antireflection({94.4, 58.5, 94.4, 58.5, 94.4, 58.5, 94.4, 58.5}), {.seed = seed});
        CHECK(result.merit < 1.01 * kBestAntireflection);
        CHECK(result.runs.size() == kSearchRuns);
        CHECK(result.runs_within >= 1);
    }
}

TEST_CASE("the threads and the SIMD level do not change what a search finds", "[design][slow]") {
    const DesignProblem problem = antireflection({90, 60, 90, 20, 90, 50});
    SearchSettings settings{.seed = 9, .evaluations = 20000, .threads = 1};
    const SearchResult one = search(problem, settings);
    settings.threads = 3;
    const SearchResult three = search(problem, settings);
    settings.simd = SimdLevel::baseline;
    const SearchResult baseline = search(problem, settings);
    CHECK(one.x == three.x);
    CHECK(one.evaluations == three.evaluations);
    CHECK(one.x == baseline.x);
}

TEST_CASE("a search ends when it is asked to", "[design]") {
    SearchSettings settings{.evaluations = std::size_t{1} << 40};
    int asked = 0;
    settings.threads = 1;
    settings.should_stop = [&] { return ++asked > 300; };
    const SearchResult result = search(antireflection({90, 60, 90, 20}), settings);
    CHECK(result.is_stopped);
    CHECK(result.x.size() == 4);
    DesignProblem unbounded = antireflection({90, 60});
    unbounded.free[1].high = kInfinity;
    CHECK_THROWS_AS(search(unbounded, {}), DomainError);
}

TEST_CASE("the colour of an oxide on titanium comes as near as it can", "[design][slow]") {
    // constant indices stand in for the metal and its oxide; a scan over thickness is the reference
    DesignProblem problem;
    StackBuilder builder;
    builder.add(builder.layer(2.45, 100));
    problem.stack = builder.over({2.6, 3.6});
    problem.free = {{"d", 100, 5, 250, false, {ThicknessOf{{0}}}}};
    problem.targets = {color_target({0}, {{40, 30, -45}})};
    problem.merit = MeritKind::delta_e_2000;
    DesignModel model(problem);
    double best = kInfinity;
    model.adapt_colors(model.start(), 1e-6);
    for (double d = 5; d <= 250; d += 0.25)
        best = std::min(best, model.merit(model.objective(std::vector{d})));
    const SearchResult result = search(problem, {});
    CHECK(result.merit <= best + 1e-9);
    CHECK(result.merit > 0.99 * best);
}

TEST_CASE("a mirror is recovered from its colours over the angle", "[design][slow]") {
    const SearchResult result = search(mirror(), {});
    CHECK(result.merit < 0.01);
    CHECK(result.x[0] == 8);
    CHECK(result.x[1] == Approx(152).margin(0.05));
    CHECK(result.x[2] == Approx(96).margin(0.05));
    CHECK(result.x[3] == Approx(1.5).margin(5e-4));
}
