#include "schemas/readers/stack_expression.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "schemas/documents/stack_document.hpp"
#include "schemas/input_error.hpp"

using irido::schemas::parse_index;
using irido::schemas::parse_stack_expression;
using nlohmann::json;

namespace {

std::string error_of(const std::string& expression) {
    try {
        parse_stack_expression(expression);
    } catch (const irido::schemas::InputError& error) {
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
    CHECK(error_of(nested(31)) == "column 37: groups must nest at most 30 deep");
    CHECK(error_of(nested(1000000)) == "column 37: groups must nest at most 30 deep");
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
    CHECK(parse_index("1.38+0.01j") == complex(1.38, 0.01));
    CHECK(parse_index("0.05-60j") == complex(0.05, -60));
    CHECK(parse_index("2j") == complex(0, 2));
    for (const char* text :
         {"", "i", "1+i", "1.5+2", "1.5+-2i", "1.5++2i", "1.5i+2", "1,5", "inf", "nan", "0x10",
          "1e999", "1.5 2i", "SiO2", "1.5x", "j", "1+j", "1+2ij"}) {
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
          "column 14: expected the number of repetitions, found \"|\"");
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
        const irido::Stack stack = irido::schemas::read_stack({text, {}}).stack;
        const irido::schemas::StackExpression expression = irido::schemas::stack_expression(stack);
        CHECK(expression.text == text);
        CHECK(expression.losses.empty());
        CHECK(irido::schemas::read_stack({expression.text, {}}).stack == stack);
    }
}

TEST_CASE("What an expression cannot say is listed, once each") {
    const json document = json::parse(R"({"incident": 1, "substrate": "Ag", "layers": [
        {"material": {"name": "sol", "cauchy": [1.5, 0.01]}, "thickness_nm": 5,
         "thickness_sigma_nm": 1},
        {"material": {"name": "ITO", "extrapolate": "clamp"}, "thickness_nm": 6,
         "thickness_sigma_nm": 2}]})");
    const irido::schemas::StackExpression expression =
        irido::schemas::stack_expression(irido::schemas::read_stack(document, "f", "").stack);
    CHECK(expression.text ==
          "1 | " + irido::to_text(1.5 + 0.01 / (0.55 * 0.55)) + "@5 | ITO@6 | Ag");
    CHECK(expression.losses == std::vector<std::string>{"sol: written as its index at 550 nm",
                                                        "thickness_sigma_nm", "ITO: extrapolate"});
}

TEST_CASE("Thicknesses have units, each rounded once") {
    const auto thickness = [](const std::string& text) {
        return parse_stack_expression("1 | 1.5@" + text + " | 1")["layers"][0]["thickness_nm"]
            .get<double>();
    };
    CHECK(thickness("100nm") == 100);
    CHECK(thickness("100 nm") == 100);
    CHECK(thickness("0.1um") == 100);
    CHECK(thickness("0.1\xC2\xB5m") == 100);  // the micro sign
    CHECK(thickness("0.1\xCE\xBCm") == 100);  // a Greek mu
    CHECK(thickness("1mm") == 1e6);
    CHECK(thickness("1e-4 mm") == 100);
    CHECK(thickness("1.0005e+1um") == 10005);
    // the double nearest to the decimal number, which a product of two doubles often is not
    for (int i = 1; i < 1000; ++i) {
        const std::string digits = std::to_string(i);
        const std::string um = "0." + std::string(4 - digits.size(), '0') + digits + "7";
        CAPTURE(um);
        REQUIRE(thickness(um + "um") == std::stod(um + "e3"));
        REQUIRE(thickness(um + "mm") == std::stod(um + "e6"));
    }
    CHECK(error_of("1 | 1.5@1px | 1") ==
          "column 9: expected a thickness such as 100, 100nm, 0.1um, 1mm or 1Q, found \"1px\"");
    CHECK(error_of("1 | 1.5@1m | 1").starts_with("column 9: expected a thickness such as"));
    CHECK(error_of("1 | 1.5@um | 1") == "column 9: expected a thickness in nm, found \"um\"");
    CHECK(error_of("1 | 1.5@1e308mm | 1").starts_with("column 9: expected a thickness"));
}

TEST_CASE("! after a thickness marks a layer that is not coherent") {
    json plate = layer("BK7", 1e6);
    plate["coherent"] = false;
    CHECK(parse_stack_expression("air | BK7@1mm! | air") ==
          stack("air", json::array({plate}), "air"));
    CHECK(parse_stack_expression("air|(BK7@1e6 !|2@3)^2|air") ==
          stack("air", json::array({group(2, {plate, layer(2, 3)})}), "air"));
    CHECK(
        irido::schemas::stack_expression(irido::schemas::read_stack({"1 | BK7@1mm! | 1", {}}).stack)
            .text == "1 | BK7@1e+06! | 1");
    CHECK(error_of("air! | 1@2 | air") == "column 4: expected \"|\", found \"!\"");
    CHECK(error_of("air | 1@2!! | air") == "column 11: expected \"|\", found \"!\"");
    CHECK(error_of("air | (1@2)^3! | air") == "column 14: expected \"|\", found \"!\"");
    CHECK(error_of("air | 1!@2 | air") ==
          "column 8: expected \"@\" and the thickness of the layer, found \"!\"");
}

TEST_CASE("Names of files and names in quotes are media") {
    CHECK(parse_stack_expression("gaas.csv | (alas.csv@78 | ../2024/gaas.yml@66)^20 | 1.5.csv") ==
          stack("gaas.csv",
                json::array({group(20, {layer("alas.csv", 78), layer("../2024/gaas.yml", 66)})}),
                "1.5.csv"));
    CHECK(parse_stack_expression("1 | \"a (1)|b.csv\"@2 | 1") ==
          stack(1, json::array({layer("a (1)|b.csv", 2)}), 1));
    CHECK(error_of("1 | \"a@2 | 1") ==
          "column 5: expected a closing \" after the name, found \"\"a\"");
    CHECK(error_of("1 | \"\"@2 | 1") == "column 5: a name must not be empty");
}
