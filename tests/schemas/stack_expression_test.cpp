#include "schemas/stack_expression.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "schemas/input_error.hpp"
#include "schemas/stack_document.hpp"

using irido::parse_index;
using irido::parse_stack_expression;
using nlohmann::json;

namespace {

std::string error_of(const std::string& expression) {
    try {
        parse_stack_expression(expression);
    } catch (const irido::InputError& error) {
        CHECK(error.file == "\"" + expression + "\"");
        CHECK(error.where.starts_with("column "));
        return error.where + ": " + error.message;
    }
    return "accepted";
}

json layer(const json& material, double thickness_nm) {
    return {{"material", material}, {"thickness_nm", thickness_nm}};
}

json group(double repeat, const json& layers) {
    return {{"repeat", repeat}, {"layers", layers}};
}

json stack(const json& incident, const json& layers, const json& substrate) {
    return {{"incident", incident}, {"layers", layers}, {"substrate", substrate}};
}

}  // namespace

TEST_CASE("Expressions become the document that a file would hold") {
    CHECK(parse_stack_expression("air | 1.33@380 | air") ==
          stack("air", json::array({layer(1.33, 380)}), "air"));
    CHECK(parse_stack_expression("air|BK7") == stack("air", json::array(), "BK7"));
    CHECK(
        parse_stack_expression("air | (TiO2@58.5 | SiO2@94.2)^10 | BK7") ==
        stack("air", json::array({group(10, {layer("TiO2", 58.5), layer("SiO2", 94.2)})}), "BK7"));
    CHECK(parse_stack_expression("  1.2 |\n1.39 @ 505\t| 1.2+0.5i ") ==
          stack(1.2, json::array({layer(1.39, 505)}), {{"n", 1.2}, {"k", 0.5}}));
    CHECK(parse_stack_expression("air | N-BK7@1e6 | TiO2-rutile-e@1.5e1 | air") ==
          stack("air", {layer("N-BK7", 1e6), layer("TiO2-rutile-e", 15)}, "air"));
}

TEST_CASE("Groups nest and repeat once unless told otherwise") {
    const json inner = group(2, json::array({layer(1.5, 1)}));
    CHECK(parse_stack_expression("air | ((1.5@1)^2 | 2@3 | (1.5@1)^2) | 1@4 | air") ==
          stack("air", {group(1, {inner, layer(2, 3), inner}), layer(1, 4)}, "air"));
    const auto nested = [](std::size_t depth) {
        return "air | " + std::string(depth, '(') + "1.5@1" + std::string(depth, ')') + " | air";
    };
    CHECK_NOTHROW(parse_stack_expression(nested(30)));
    CHECK(error_of(nested(31)) == "column 37: groups nest at most 30 deep");
    CHECK(error_of(nested(1000000)) == "column 37: groups nest at most 30 deep");
}

TEST_CASE("An index is real or complex") {
    const auto complex = [](double n, double k) { return json{{"n", n}, {"k", k}}; };
    CHECK(parse_index("1.5") == json(1.5));
    CHECK(parse_index(" +.5 ") == json(0.5));
    CHECK(parse_index("1e3") == json(1000));
    CHECK(parse_index("-2") == json(-2));
    CHECK(parse_index("1.9+1.5i") == complex(1.9, 1.5));
    CHECK(parse_index("1.9 + 1.5i") == complex(1.9, 1.5));
    CHECK(parse_index("0.05-60i") == complex(0.05, -60));
    CHECK(parse_index("2i") == complex(0, 2));
    CHECK(parse_index("1e-3+2e2i") == complex(1e-3, 200));
    for (const char* text : {"", "i", "1+i", "1.5+2", "1.5+-2i", "1.5++2i", "1.5i+2", "1,5", "inf",
                             "nan", "0x10", "1e999", "1.5 2i", "SiO2", "1.5x"}) {
        CAPTURE(text);
        CHECK(parse_index(text).is_null());
    }
}

TEST_CASE("Errors of expressions tell the column, what was expected and what is there") {
    CHECK(error_of("air | 1.33@ | air") == "column 13: expected a thickness in nm, found \"|\"");
    CHECK(error_of("air | 1.33@x | air") == "column 12: expected a thickness in nm, found \"x\"");
    CHECK(error_of("|") == "column 1: expected the incident medium, found \"|\"");
    CHECK(error_of("air |") == "column 6: expected a layer or the substrate, found the end");
    CHECK(error_of("air | | air") == "column 7: expected a layer or the substrate, found \"|\"");
    CHECK(error_of("air@5 | air") == "column 4: expected \"|\", found \"@\"");
    CHECK(error_of("air | 1.33 | air") ==
          "column 12: expected \"@\" and the thickness of the layer, found \"|\"");
    CHECK(error_of("air | 1.33@5") == "column 13: expected \"|\" and the substrate, found the end");
    CHECK(error_of("air | (1.33@5 | air") ==
          "column 20: expected \"@\" and the thickness of the layer, found the end");
    CHECK(error_of("air | (1.33@5 | 1@5") == "column 20: expected \")\", found the end");
    CHECK(error_of("air | () | air") == "column 8: expected a layer, found \")\"");
    CHECK(error_of("air | (1@5)^ | air") ==
          "column 14: expected how many times the group repeats, found \"|\"");
    CHECK(error_of("air | 1.33@5 | air)") ==
          "column 19: expected \"@\" and the thickness of the layer, found \")\"");
    CHECK(error_of("air | 1.5x@5 | air") ==
          "column 7: expected an index such as 1.5 or 1.9+1.5i, or the name of a material, "
          "found \"1.5x\"");
    CHECK(error_of("\xC3\xA9t\xC3\xA9 @ 5") == "column 5: expected \"|\", found \"@\"");
}

TEST_CASE("A stack's expression reads back to the same stack") {
    for (const char* text : {"1 | 1.33", "air | 1.33@380 | BK7", "1.2 | 1.9+1.5i@0 | 0.05-2i",
                             "air | (TiO2@58.5 | (1.46@1e-07 | 2@3)^2)^1000000000 | SiO@7 | Cu"}) {
        const irido::Stack stack = irido::read_stack({text, {}}).stack;
        CHECK(irido::stack_expression(stack) == text);
        CHECK(irido::read_stack({irido::stack_expression(stack), {}}).stack == stack);
    }
}
