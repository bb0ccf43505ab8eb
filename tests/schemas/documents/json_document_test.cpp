#include "schemas/documents/json_document.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "schemas/input_error.hpp"

using irido::schemas::parse_json;
using irido::schemas::set_value;
using nlohmann::json;

namespace {

template <class Function>
std::string error_of(Function function) {
    try {
        function();
    } catch (const irido::schemas::InputError& error) {
        return error.what();
    }
    return "accepted";
}

std::string parse_error_of(const std::string& text) {
    return error_of([&] { parse_json(text, "f"); });
}

json document() {
    return {{"incident", "air"},
            {"layers", {{{"material", "water"}, {"thickness_nm", 380}}}},
            {"substrate", "air"}};
}

json after(const char* assignment) {
    json changed = document();
    set_value(changed, assignment);
    return changed;
}

std::string set_error_of(const char* assignment) {
    return error_of([&] { after(assignment); });
}

}  // namespace

TEST_CASE("JSON is read as it stands") {
    const char* text = R"( {"a": [1, -2, 2.5, 1e3, true, false, null, "x\u00e9\n"], "b": {}} )";
    CHECK(parse_json(text, "f") == json::parse(text));
    CHECK(parse_json("\xEF\xBB\xBF{}", "f") == json::object());
    CHECK(parse_json("5", "f") == json(5));
    const std::string deepest = std::string(64, '[') + std::string(64, ']');
    CHECK(parse_json(deepest, "f") == json::parse(deepest));
    CHECK(parse_json("18446744073709551615", "f").is_number_float());
    CHECK(parse_json("9223372036854775807", "f") == json(9223372036854775807));
}

TEST_CASE("Text that is not JSON is refused with line and column") {
    CHECK(parse_error_of("") == "f: 1:1: unexpected end of input; expected '[', '{', or a literal");
    CHECK(parse_error_of("{\n  \"a\" 1}") == "f: 2:7: unexpected number literal; expected ':'");
    CHECK(parse_error_of("[1, 2,]") == "f: 1:7: unexpected ']'; expected '[', '{', or a literal");
    CHECK(parse_error_of("{} {}") == "f: 1:4: unexpected '{'; expected end of input");
    CHECK(parse_error_of("[tru]") == "f: 1:5: unknown word \"tru\"");
    CHECK(parse_error_of("{} // x") == "f: 1:4: comments are not part of JSON");
    CHECK(parse_error_of("/* x */ {}") == "f: 1:1: comments are not part of JSON");
    CHECK(parse_error_of("[\"\xC3\xA9\", 01]") ==
          "f: 1:8: unexpected number literal; expected ']'");
    CHECK(parse_error_of("[1e999]") == "f: 1:2: the number 1e999 is too large");
    CHECK(parse_error_of("[-1e999]") == "f: 1:2: the number -1e999 is too large");
    CHECK(parse_error_of("[\"\xFF\"]") == "f: 1:3: invalid UTF-8");
    CHECK(parse_error_of(std::string("{}\0x", 4)) == "f: 1:3: unexpected NUL byte");
    CHECK(parse_error_of("{\"a\":1,\n\"b\":{\"c\":1, \"c\":2}}") == "f: 2:13: duplicate key \"c\"");
    CHECK(parse_error_of(std::string(65, '[')) == "f: 1:65: nested more than 64 levels deep");
    CHECK(parse_error_of(std::string(1000000, '[')) == "f: 1:65: nested more than 64 levels deep");
    CHECK(parse_error_of("\xEF\xBB\xBFx") == "f: 1:1: unknown word \"x\"");
}

TEST_CASE("A value is set by its dotted path") {
    CHECK(after("layers.0.thickness_nm=420")["layers"][0]["thickness_nm"] == 420);
    CHECK(after("substrate=Ag")["substrate"] == "Ag");
    CHECK(after("substrate=\"Ag\"")["substrate"] == "Ag");
    CHECK(after("layers.0.material={\"n\":1.5}")["layers"][0]["material"] == json{{"n", 1.5}});
    CHECK(after("layers.0.material=1.9+1.5i")["layers"][0]["material"] ==
          json{{"n", 1.9}, {"k", 1.5}});
    CHECK(after("layers.0.coherent=false")["layers"][0]["coherent"] == false);
    CHECK(after("name=a=b")["name"] == "a=b");
    CHECK(after("name=2i")["name"] == "2i");
    CHECK(after("layers=[]")["layers"] == json::array());
}

TEST_CASE("A path that leads nowhere is refused") {
    CHECK(set_error_of("layers.1.thickness_nm=5") ==
          "layers.1.thickness_nm: the index must be 0, the array has one element (got \"1\")");
    CHECK(set_error_of("layers.-1=5") ==
          "layers.-1: the index must be 0, the array has one element (got \"-1\")");
    CHECK(set_error_of("layers.x=5") ==
          "layers.x: the index must be 0, the array has one element (got \"x\")");
    CHECK(set_error_of("layer.0.thickness_nm=5") ==
          "layer.0.thickness_nm: unknown key \"layer\" (did you mean \"layers\"?)");
    CHECK(set_error_of("substrate.n=5") == "substrate.n: the value before \"n\" has no members");
    CHECK(set_error_of("substrate") ==
          "must be PATH=VALUE, as in layers.0.thickness_nm=400 (got 'substrate')");
    CHECK(set_error_of("=5") == "must be PATH=VALUE, as in layers.0.thickness_nm=400 (got '=5')");
    CHECK(set_error_of("substrate={\"n\":") ==
          "substrate={\"n\":: 1:6: unexpected end of input; expected '[', '{', or a literal");
    std::string deep = "a";
    for (int i = 0; i < 64; ++i) deep += ".a";
    CHECK(set_error_of((deep + "=1").c_str()) == deep + ": must be at most 64 levels deep");
    json empty{{"layers", json::array()}};
    CHECK(error_of([&] { set_value(empty, "layers.0", 1); }) ==
          "layers.0: names an element of an empty array (got \"0\")");
}

TEST_CASE("A text stands for JSON, for an index where a material is, or for itself") {
    using irido::schemas::value_from_text;
    CHECK(value_from_text("substrate", "1.9+1.5i") == json{{"n", 1.9}, {"k", 1.5}});
    CHECK(value_from_text("layers.0.material", "2") == 2);
    CHECK(value_from_text("layers.0.name", "1+2i") == "1+2i");
    CHECK(value_from_text("substrate", "Ag") == "Ag");
    CHECK(value_from_text("layers.0.coherent", "false") == false);
    CHECK(value_from_text("substrate", R"({"n": 1.5})") == json{{"n", 1.5}});
    CHECK(error_of([] { value_from_text("substrate", "{1}"); }) ==
          "substrate={1}: 1:2: unexpected number literal; expected string literal");
}

TEST_CASE("Paths that name parts of each other are found") {
    const auto overlap = [](const std::vector<std::string>& paths) {
        const auto found = irido::schemas::overlap_of(paths);
        if (!found) return std::string();
        return paths[found->inner] + (found->is_same ? " = " : " in ") + paths[found->outer];
    };
    CHECK(overlap({}).empty());
    CHECK(overlap({"a.1", "a.10", "a.1b", "b", "ba"}).empty());
    CHECK(overlap({"a.b", "c", "a.b"}) == "a.b = a.b");
    CHECK(overlap({"a.01.n", "a.1.n"}) == "a.01.n = a.1.n");
    CHECK(overlap({"a.0", "a.1", "a.00.b"}) == "a.00.b in a.0");
    CHECK(overlap({"a.b.c.d", "a.b"}) == "a.b.c.d in a.b");
    for (const auto& [path, whole] :
         {std::pair("a.b", "a"), {"a", "a.b"}, {"a.00", "a.0"}, {"ab", "a"}, {"", ""}})
        CHECK(irido::schemas::is_part_of(path, whole) ==
              (std::string(overlap({path, whole})) == std::string(path) + " in " + whole ||
               overlap({path, whole}).find(" = ") != std::string::npos));
}

TEST_CASE("Lists of values are split at the commas between them") {
    const auto split = [](std::string_view text) {
        const auto parts = irido::schemas::split_values(text);
        return std::vector<std::string>(parts.begin(), parts.end());
    };
    using Parts = std::vector<std::string>;
    CHECK(split("Ag,Au,Cu") == Parts{"Ag", "Au", "Cu"});
    CHECK(split(" Ag , Au") == Parts{"Ag", "Au"});
    CHECK(split("") == Parts{""});
    CHECK(split("Ag,,") == Parts{"Ag", "", ""});
    CHECK(split(R"({"n":1.5,"k":0.1},[[1,2],[3,4]],"a,b",2)") ==
          Parts{R"({"n":1.5,"k":0.1})", "[[1,2],[3,4]]", R"("a,b")", "2"});
    CHECK(split(R"("a\",b]",{"x":"}"},c)") == Parts{R"("a\",b]")", R"({"x":"}"})", "c"});
    // unbalanced brackets are left for the reader of the items
    CHECK(split("{a,b") == Parts{"{a,b"});
    CHECK(split("a],b") == Parts{"a]", "b"});
    CHECK(split("\"a,b") == Parts{"\"a,b"});
    CHECK(split("\"a\\") == Parts{"\"a\\"});
}
