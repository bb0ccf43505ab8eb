#include "core/color/color_method.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "core/color/stack_color.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/error.hpp"
#include "core/stack/builder.hpp"

using namespace irido;

namespace {

Stack stack_of(std::size_t layers, std::uint64_t repeat = 1) {
    StackBuilder b(1);
    std::vector<Element> elements;
    for (std::size_t i = 0; i < layers; ++i) elements.push_back(b.layer(i % 2 ? 1.8 : 1.4, 150));
    if (!elements.empty()) b.add(StackBuilder::group(repeat, elements));
    return b.over(1.5);
}

}  // namespace

TEST_CASE("every colour method describes itself and has a place of its own", "[color_method]") {
    std::set<std::string_view> names;
    std::set<int> places;
    std::size_t exact = 0;
    for (const ColorMethodKind* const method : color_methods()) {
        CAPTURE(method->name);
        CHECK(find_color_method(method->name) == method);
        CHECK(method->prepare != nullptr);
        CHECK(method->help.starts_with(method->name));
        CHECK(method->help.size() > method->name.size() + 3);
        const MethodTrials& trials = method->trials;
        CHECK((trials.last_power > 0 || !trials.counts.empty()));
        // a page says what is computed at counts; tolerances need no words
        CHECK(trials.what.empty() == trials.counts.empty());
        const MethodNumber& number = method->number;
        for (const std::size_t count : trials.counts) {
            if (count == 0) continue;
            CHECK(static_cast<double>(count - number.offset) >= number.fewest);
            CHECK(static_cast<double>(count - number.offset) <= number.most);
        }
        names.insert(method->name);
        places.insert(method->place);
        exact += method->use == MethodUse::exact;
    }
    CHECK(places.size() == color_methods().size());
    CHECK(*places.begin() == 1);
    CHECK(*places.rbegin() == static_cast<int>(color_methods().size()));
    CHECK(names.size() == color_methods().size());
    CHECK(exact == 4);
    CHECK(color_methods().front() == ColorMethod().kind);
    CHECK(find_color_method("fourier_constant") == nullptr);
    CHECK_THROWS_WITH(color_method("gausian"), "unknown colour method gausian");
}

// each on stacks of no, one, two and six layers: it refuses what its fault() says and nothing else
TEST_CASE("a colour method takes every stack in which it finds no fault", "[color_method]") {
    const ColorTables tables(Sensitivity(observer(2), illuminant("D65")));
    const double angle_deg = 20;
    std::size_t taken = 0, refused = 0;
    for (const ColorMethodKind* const method : color_methods())
        for (const std::size_t layers : {0U, 1U, 2U, 6U})
            for (const Side side : {Side::reflected, Side::transmitted}) {
                const Stack stack = stack_of(layers);
                const ColorRequest request{.sides = {side}, .tolerance = 1e-4};
                const std::string fault = method->fault_in(stack, request);
                CAPTURE(method->name, layers, fault);
                const ColorMethod with_count{method, method->number.fallback};
                if (!fault.empty()) {
                    CHECK_THROWS_WITH(color_algorithm(tables, stack, with_count, request), fault);
                    ++refused;
                    continue;
                }
                const StackColor color =
                    stack_color(tables, stack, with_count, request, {&angle_deg, 1}).front();
                CHECK(find_color_method(color.method) != nullptr);
                if (method != ColorMethod().kind) CHECK(color.method == method->name);
                if (method->use == MethodUse::exact) CHECK(color.error <= request.tolerance);
                if (method->use == MethodUse::baseline) CHECK(std::isinf(color.error));
                if (method->needs_reflected_film) CHECK((layers == 1 && side == Side::reflected));
                ++taken;
            }
    CHECK(taken == 8 * 4 + 2 * 4 + 2 * 2 + 3);
    CHECK(refused == color_methods().size() * 8 - taken);
}
