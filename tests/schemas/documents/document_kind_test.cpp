#include "schemas/documents/document_kind.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"

using namespace irido;
using namespace irido::schemas;
using nlohmann::json;

TEST_CASE("the kind of a document is judged by its keys", "[documents]") {
    const auto kind = [](const char* text) { return kind_of(json::parse(text)); };
    using Kind = DocumentKind;
    CHECK(kind(R"({"incident": 1, "layers": [], "substrate": 2})") == Kind::stack);
    CHECK(kind(R"({"materials": {"H": 2}, "layers": []})") == Kind::stack);
    CHECK(kind(R"({"materials": {"H": 2}})") == Kind::stack);
    CHECK(kind(R"({"design": {}, "incident": 1, "layers": [], "substrate": 2})") == Kind::stack);
    CHECK(kind(R"({"incident": 1, "layers": [{"alpha": 0.1}]})") == Kind::stack);
    CHECK(kind(R"({"layers": [{"stack": "1 | 2", "alpha": 0.1}]})") == Kind::surface);
    CHECK(kind(R"({"scratches": [], "substrate": 1})") == Kind::surface);
    CHECK(kind(R"({"base": {"albedo": 0.5}})") == Kind::surface);
    CHECK(kind(R"({"stack": "1 | 2", "targets": [], "materials": []})") == Kind::design);
    CHECK(kind(R"({"materials": []})") == Kind::scene);
    CHECK(kind(R"({"tables": []})") == Kind::plan);
    CHECK(kind(R"({"tables": {}})") == Kind::manifest);
    for (const char* unclear : {"{}", "[]", "1", "null", R"("stack")"}) {
        CHECK(kind(unclear) == Kind::stack);
        CHECK(other_kind(json::parse(unclear), Kind::scene).empty());
    }
    CHECK(other_kind(json::parse(R"({"materials": []})"), Kind::scene).empty());
    CHECK(other_kind(json::parse(R"({"materials": []})"), Kind::stack).starts_with("is a scene"));
}

TEST_CASE("validate and the commands agree on the kind of a document", "[cli][documents]") {
    // keys of two kinds, as by mistake: validate checks it as what the other commands take it for
    const std::string both =
        R"({"incident": 1, "layers": [], "substrate": 1.5, "base": {"albedo": 0.5}})";
    CHECK_THAT(test::run_irido({"validate", "-"}, both).out,
               Catch::Matchers::Contains("/incident: unknown key"));
    test::check_refused(test::run_irido({"spectrum", "-"}, both),
                        "<stdin>: is a surface; irido brdf, lut, render and scenes read it");
    const std::string media = R"({"materials": {"H": 2.3}, "layers": []})";
    for (const char* command : {"spectrum", "view", "validate"}) {
        std::vector<std::string> arguments{command, "-"};
        if (arguments[0] == "view") arguments.insert(arguments.end(), {"-o", "x.html"});
        const test::Outcome outcome = test::run_irido(arguments, media);
        CHECK_THAT(outcome.out + outcome.err,
                   Catch::Matchers::Contains("must have the key \"incident\""));
    }
}
