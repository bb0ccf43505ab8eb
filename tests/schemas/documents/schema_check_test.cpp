#include "schemas/documents/schema_check.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/nearest.hpp"
#include "schemas/documents/plain_stack.hpp"
#include "schemas/documents/stack_document.hpp"

using irido::schemas::check;
using irido::schemas::is_plain_stack;
using irido::schemas::Problem;
using irido::schemas::Schema;
using nlohmann::json;

namespace {

const json& stack_schema_document() {
    static const json document = json::parse(irido::schemas::stack_schema_text());
    return document;
}

const Schema& stack_schema() {
    static const Schema schema(stack_schema_document());
    return schema;
}

/// A document that uses every key of the schema.
json complete_document() {
    std::ifstream file(IRIDO_SOURCE_DIR "/tests/data/complete-stack.json");
    return json::parse(file);
}

/// Pointers of all keys of objects inside a value.
void collect_fields(const json& value, const std::string& pointer, std::vector<std::string>& all) {
    if (value.is_object()) {
        for (const auto& member : value.items()) all.push_back(pointer + "/" + member.key());
    }
    if (!value.is_structured()) return;
    for (const auto& member : value.items()) {
        collect_fields(member.value(), pointer + "/" + member.key(), all);
    }
}

std::vector<std::string> fields_of(const json& document) {
    std::vector<std::string> all;
    collect_fields(document, "", all);
    return all;
}

std::string key_of(const std::string& pointer) {
    return pointer.substr(pointer.rfind('/') + 1);
}

std::string parent_of(const std::string& pointer) {
    return pointer.substr(0, pointer.rfind('/'));
}

/// All keys listed by any "properties" in the schema.
void collect_keys(const json& node, std::set<std::string>& keys) {
    if (!node.is_structured()) return;
    if (node.is_object() && node.contains("properties")) {
        for (const auto& member : node["properties"].items()) keys.insert(member.key());
    }
    for (const json& child : node) collect_keys(child, keys);
}

json simple_document() {
    return {{"incident", "air"},
            {"layers", {{{"material", 1.33}, {"thickness_nm", 380}}}},
            {"substrate", "air"}};
}

}  // namespace

TEST_CASE("A complete document has no problems and uses every key of the schema") {
    const json document = complete_document();
    CHECK(check(stack_schema(), document).empty());
    std::set<std::string> used;
    for (const std::string& field : fields_of(document)) used.insert(key_of(field));
    std::set<std::string> known;
    collect_keys(stack_schema_document(), known);
    CHECK(used == known);
}

TEST_CASE("A field that is deleted is missed, unless it is optional") {
    const std::set<std::string> optional{"$schema",
                                         "name",
                                         "comment",
                                         "k",
                                         "coherent",
                                         "thickness_sigma_nm",
                                         "extrapolate",
                                         "eps_infinity",
                                         "materials",
                                         "design",
                                         "reference_nm",
                                         "roughness_nm",
                                         "substrate_roughness_nm",
                                         "roughness_placement",
                                         "model",
                                         "profile",
                                         "axis"};
    for (const std::string& field : fields_of(complete_document())) {
        CAPTURE(field);
        json document = complete_document();
        document[json::json_pointer(parent_of(field))].erase(key_of(field));
        const std::vector<Problem> problems = check(stack_schema(), document);
        if (optional.contains(key_of(field))) {
            CHECK(problems.empty());
        } else {
            REQUIRE(!problems.empty());
            CHECK(problems.front().pointer == parent_of(field));
            const std::map<std::string, std::string> instead{{"qwot", "thickness_nm"},
                                                             {"graded", "material"}};
            const auto other = instead.find(key_of(field));
            const std::string missed = other == instead.end() ? key_of(field) : other->second;
            CHECK(problems.front().message.find("\"" + missed + "\"") != std::string::npos);
        }
    }
}

TEST_CASE("A field of the wrong type is refused where it is") {
    for (const std::string& field : fields_of(complete_document())) {
        for (const json& wrong : {json(nullptr), json(true), json(-1.5e300)}) {
            if (wrong.is_boolean() && key_of(field) == "coherent") continue;
            CAPTURE(field, wrong.dump());
            json document = complete_document();
            document[json::json_pointer(field)] = wrong;
            const std::vector<Problem> problems = check(stack_schema(), document);
            REQUIRE(problems.size() == 1);
            CHECK(problems[0].pointer == field);
            CHECK(problems[0].message.starts_with("must be "));
            CHECK(
                problems[0].message.ends_with(" (got " + irido::schemas::short_text(wrong) + ")"));
        }
    }
}

TEST_CASE("A number of an array out of range or of another type is refused where it is") {
    for (const std::string place :
         {"/layers/1/layers/1/material/table/0/1", "/layers/2/material/cauchy/1",
          "/layers/3/material/sellmeier/0/1", "/substrate/lorentz_drude/oscillators/1/2"}) {
        for (const json& wrong : {json(1e10), json("x")}) {
            CAPTURE(place, wrong.dump());
            json document = complete_document();
            document.at(json::json_pointer(place)) = wrong;
            const std::vector<Problem> problems = check(stack_schema(), document);
            REQUIRE(problems.size() == 1);
            CHECK(problems[0].pointer == place);
        }
    }
}

TEST_CASE("The ends of the closed ranges are allowed and their neighbours are not") {
    const auto accepts = [](const char* key, const json& value) {
        json document = simple_document();
        document["layers"][0][key] = value;
        return check(stack_schema(), document).empty();
    };
    CHECK(accepts("thickness_nm", 0));
    CHECK(accepts("thickness_nm", 1e9));
    CHECK_FALSE(accepts("thickness_nm", -5e-324));
    CHECK_FALSE(accepts("thickness_nm", 1000000000.0000001));
    CHECK(accepts("material", 1e4));
    CHECK(accepts("material", {{"n", 0}, {"k", -1e4}}));
    CHECK_FALSE(accepts("material", {{"n", 1}, {"k", -10000.000000000002}}));

    const auto repeats = [](const json& value) {
        json document = simple_document();
        document["layers"] = {{{"repeat", value}, {"layers", document["layers"]}}};
        return check(stack_schema(), document).empty();
    };
    CHECK(repeats(1));
    CHECK(repeats(10.0));
    CHECK(repeats(1e9));
    CHECK_FALSE(repeats(0.999999999));
    CHECK_FALSE(repeats(1.5));
    CHECK_FALSE(repeats(1000000001));
}

TEST_CASE("All problems come, each once, in the order of the document") {
    json document = simple_document();
    const json bad = {{"material", -1}, {"thickness_nm", "abc"}};
    document["layers"] = json::array({{{"thicknes_nm", 1}, {"material", 1}}});
    for (int i = 0; i < 10; ++i) document["layers"].push_back(bad);
    document.erase("substrate");
    const std::vector<Problem> problems = check(stack_schema(), document);
    REQUIRE(problems.size() == 2 + 2 * 10);
    CHECK(problems[0] == Problem{"", "must have the key \"substrate\""});
    CHECK(problems[1] ==
          Problem{"/layers/0/thicknes_nm", "unknown key (did you mean \"thickness_nm\"?)"});
    CHECK(problems[2].pointer == "/layers/1/material");
    CHECK(problems[3] ==
          Problem{"/layers/1/thickness_nm", "must be a number in [0, 1e9] (got \"abc\")"});
    CHECK(problems[20].pointer == "/layers/10/material");
    CHECK(problems[21].pointer == "/layers/10/thickness_nm");
}

TEST_CASE("A schema without words of its own still tells the place and the value") {
    const Schema schema(json{{"properties", {{"a", {{"type", "string"}}}}}});
    CHECK(check(schema, {{"a", 5}, {"b", 1}}) ==
          std::vector<Problem>{{"/a", "is not allowed here (got 5)"}});
}

TEST_CASE("Every rule of the stack schema has words beside it") {
    const std::set<std::string> rules{"minimum", "maximum",    "minItems", "maxItems",
                                      "enum",    "multipleOf", "minLength"};
    std::vector<const json*> nodes{&stack_schema_document()};
    while (!nodes.empty()) {
        const json& node = *nodes.back();
        nodes.pop_back();
        for (const auto& member : node.items()) {
            // conditions have no message of their own
            const bool condition = member.key() == "if" || member.key() == "not";
            if (member.value().is_structured() && !condition) nodes.push_back(&member.value());
            if (rules.contains(member.key())) CHECK(node.contains("errorMessage"));
        }
    }
}

TEST_CASE("Keys and values keep a message on one short line") {
    const Schema schema(json{{"additionalProperties", false}, {"properties", json::object()}});
    const std::vector<Problem> problems = check(schema, {{"a/b~c\nd", 1}});
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].pointer == "/a~1b~0c?d");
    CHECK(irido::schemas::short_text(std::string(100, 'x')).size() == 40);
    CHECK(irido::schemas::short_text("\xC3\xA9\n\xFF") == "\"\xC3\xA9\\n\xEF\xBF\xBD\"");
    std::string accents;
    for (int i = 0; i < 50; ++i) accents += "\xC3\xA9";
    const std::string text = irido::schemas::short_text(accents);
    CHECK(text == json(text).get<std::string>());
    CHECK_NOTHROW(json(text).dump());  // no character cut in two
}

TEST_CASE("nearest finds misspellings and nothing far-fetched") {
    const std::vector<std::string> keys{
        "material", "thickness_nm", "thickness_sigma_nm", "coherent", "n", "k"};
    CHECK(irido::nearest("thicknes", keys) == "thickness_nm");
    CHECK(irido::nearest("thickness", keys) == "thickness_nm");
    CHECK(irido::nearest("Material", keys) == "material");
    CHECK(irido::nearest("matreial", keys) == "material");
    CHECK(irido::nearest("nn", keys) == "n");
    CHECK(irido::nearest("x", keys).empty());
    CHECK(irido::nearest("colour", keys).empty());
    CHECK(irido::nearest("", keys).empty());
    CHECK(irido::nearest(std::string(1000000, 'm'), keys).empty());
}

TEST_CASE("A plain document has no problems, whatever stands in its fields") {
    CHECK(is_plain_stack(simple_document()));
    const json plain{
        {"$schema", "x"},
        {"name", "plain"},
        {"incident", 1},
        {"layers",
         {{{"repeat", 10}, {"layers", {{{"material", "TiO2"}, {"thickness_nm", 58.5}}}}},
          {{"material", {{"n", 1.5}, {"k", 0.1}}},
           {"thickness_nm", 100},
           {"thickness_sigma_nm", 5},
           {"coherent", false}}}},
        {"substrate", "Si"}};
    CHECK(is_plain_stack(plain));
    const std::vector<json> values{nullptr,     true,          -1,
                                   0,           1e-7,          0.5,
                                   1,           1.5,           1e9,
                                   1e10,        -1e300,        "",
                                   "x",         "air",         {1, 2},
                                   json{},      json::array(), {{"n", 1.5}},
                                   {{"n", -1}}, {{"k", 1}},    {{"n", 1.5}, {"k", -1}},
                                   {{"x", 1}}};
    int still_plain = 0;
    for (const json& document : {simple_document(), plain, complete_document()}) {
        for (const std::string& field : fields_of(document)) {
            json without = document;
            without[json::json_pointer(parent_of(field))].erase(key_of(field));
            if (is_plain_stack(without)) CHECK(check(stack_schema(), without).empty());
            json extra = document;
            extra[json::json_pointer(parent_of(field))]["other"] = 1;
            CHECK_FALSE(is_plain_stack(extra));
            for (const json& value : values) {
                CAPTURE(field, value.dump());
                json changed = document;
                changed[json::json_pointer(field)] = value;
                if (!is_plain_stack(changed)) continue;
                ++still_plain;
                CHECK(check(stack_schema(), changed).empty());
            }
        }
    }
    CHECK(still_plain > 50);
}
