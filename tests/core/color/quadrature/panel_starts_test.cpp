#include <catch2/catch.hpp>
#include <memory>
#include <vector>

#include "core/color/quadrature/panel_starts.hpp"
#include "core/color/stack_color.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/truth/color_cases.hpp"

using namespace irido;

namespace {

/// One algorithm for each of some random stacks of every kind.
struct ManyStacks {
    std::vector<ColorFamily> families;
    std::vector<std::unique_ptr<ColorAlgorithm>> algorithms;

    ManyStacks(const ColorTables& tables, std::uint64_t count, double tolerance) {
        for (const ColorCase& one : color_cases()) {
            if (!one.is_set) continue;
            for (ColorFamily& family : color_families(one, count, 1))
                families.push_back(std::move(family));
        }
        ColorRequest request;
        request.tolerance = tolerance;
        for (const ColorFamily& family : families)
            algorithms.push_back(color_algorithm(tables, family.variants.front(),
                                                 color_method("quadrature"), request));
    }
    StackColor color(std::size_t i) const {
        StackColor result;
        (*algorithms[i])(families[i].variants.front(), families[i].angles_deg, {&result, 1});
        return result;
    }
};

bool are_same(const StackColor& a, const StackColor& b) {
    return a.xyz == b.xyz && a.error == b.error && a.evaluations == b.evaluations;
}

}  // namespace

TEST_CASE("colours do not depend on the stacks whose colours were computed before") {
    const ColorTables tables(Sensitivity(observer(2), illuminant("D65")));
    const ManyStacks stacks(tables, 8, 1e-4);
    std::vector<StackColor> in_order;
    for (std::size_t i = 0; i < stacks.families.size(); ++i) in_order.push_back(stacks.color(i));
    for (std::size_t i = stacks.families.size(); i-- > 0;) {
        CHECK(are_same(stacks.color(i), in_order[i]));
        CHECK(are_same(stacks.color(i), in_order[i]));
        CHECK(are_same(stacks.color(0), in_order[0]));
    }
    const ColorTables other(Sensitivity(observer(2), illuminant("D65")));
    const ManyStacks again(other, 8, 1e-4);
    for (std::size_t i = again.families.size(); i-- > 0;)
        CHECK(are_same(again.color(i), in_order[i]));
}

TEST_CASE("stacks of constant indices share their panels until there are many") {
    const ColorTables tables(Sensitivity(observer(2), illuminant("D65")));
    const std::shared_ptr<const PanelStarts> first = tables.constant_starts();
    CHECK(tables.constant_starts() == first);
    const PanelTree::Start& start = first->at({0, false, 1e-3, 1});
    for (std::size_t most = 2; first->size() <= ColorTables::kMostShared; ++most) {
        REQUIRE(most <= ColorTables::kMostShared + 1);
        first->at({0, false, 1e-3, most});
    }
    CHECK(tables.constant_starts() != first);
    CHECK(&first->at({0, false, 1e-3, 1}) == &start);
}

TEST_CASE("first wavelengths suit a smaller tolerance where few are needed") {
    CHECK(first_tolerance(1) == 1e-4);
    CHECK(first_tolerance(1e-2) == 1e-4);
    CHECK(first_tolerance(3e-4) == Approx(3e-5));
    CHECK(first_tolerance(1e-5) == 1e-5);
    CHECK(first_tolerance(1e-9) == 1e-9);
    for (double tolerance = 1; tolerance > 1e-12; tolerance /= 3)
        CHECK(first_tolerance(tolerance) <= tolerance);
}
