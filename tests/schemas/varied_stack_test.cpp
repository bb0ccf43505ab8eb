#include "schemas/varied_stack.hpp"

#include <array>
#include <catch2/catch.hpp>

#include "schemas/input_error.hpp"

using namespace irido;

namespace {

StackSource mirror() {
    return load_stack({"1 | (1.5@100 | 2@80)^10 | 1.3@300 | BK7", {}});
}

Stack with(const std::string& set) {
    return read_stack({"1 | (1.5@100 | 2@80)^10 | 1.3@300 | BK7", {set}}).stack;
}

}  // namespace

TEST_CASE("thicknesses vary without reading the document again", "[varied]") {
    const VariedStack stack(mirror(), {"layers.0.layers.1.thickness_nm", "layers.1.thickness_nm"});
    CHECK(stack.varies_thickness_only());
    const std::array values{85.5, 300.0};
    CHECK(stack.at(values) == with("layers.0.layers.1.thickness_nm=85.5"));
    CHECK_THROWS_AS(stack.at(std::array{-1.0, 300.0}), InputError);
}

TEST_CASE("any other number of the document varies, too", "[varied]") {
    const VariedStack index(mirror(), {"layers.1.material"});
    CHECK_FALSE(index.varies_thickness_only());
    CHECK(index.at(std::array{1.7}) == with("layers.1.material=1.7"));
    const VariedStack repeat(mirror(), {"layers.0.repeat"});
    CHECK(repeat.at(std::array{20.0}) == with("layers.0.repeat=20"));
    CHECK_THROWS_AS(repeat.at(std::array{0.5}), InputError);
}

TEST_CASE("paths that lead nowhere are refused", "[varied]") {
    for (const std::string path : {"layers.7.thickness_nm", "layers.1.layers.0.thickness_nm",
                                   "layers.x.thickness_nm", "substrat", "layers.0.thickness_nm"}) {
        CAPTURE(path);
        CHECK_THROWS_AS(VariedStack(mirror(), {path}).at(std::array{1.0}), InputError);
    }
}

TEST_CASE("no path at all is the stack itself", "[varied]") {
    CHECK(VariedStack(mirror(), {}).at({}) == with("layers.1.thickness_nm=300"));
}
