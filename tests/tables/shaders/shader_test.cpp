#include "tables/shaders/shader.hpp"

#include <catch2/catch.hpp>
#include <regex>
#include <utility>

#include "tables/shaders/wgsl.hpp"

using namespace irido;
using namespace irido::tables;
using Catch::Matchers::Contains;

TEST_CASE("samplers of GLSL have the precision of the tables", "[tables][lut]") {
    // ES would use lowp, the default for sampler2D, and thereby truncate 32-bit tables to halves
    const std::regex without_precision("[^p] sampler[23]D");
    for (const std::string_view name : shader_names()) {
        const std::string source = shader_source(name, "glsl");
        INFO(name);
        CHECK_FALSE(std::regex_search(source, without_precision));
    }
    CHECK_THAT(shader_source("color", "glsl"), Contains("(highp sampler2D table, "));
}

TEST_CASE("every layout of a table of colours has a function that reads it", "[tables][lut]") {
    const std::string source = shader_source("color", "hlsl");
    for (const char* name :
         {"irido_color(", "irido_color_of_angle(", "irido_color_of_two(", "irido_color_of_spread("})
        CHECK_THAT(source, Contains(name));
    CHECK_THAT(shader_source("transmissivity", "hlsl"), Contains("irido_transmissivity_volume("));
}

TEST_CASE("snippets mix the mip levels on both sides of a level", "[tables][lut]") {
    for (const auto& [snippet, function] :
         {std::pair{"sensitivity", "void irido_sensitivity("},
          std::pair{"sensitivity", "vec3 irido_sensitivity_real("},
          std::pair{"color", "vec3 irido_color_of_spread("}}) {
        const std::string source = shader_source(snippet, "glsl");
        const std::size_t start = source.find(function);
        const std::string body = source.substr(start, source.find("\n}", start) - start);
        INFO(function);
        CHECK_THAT(body, Contains("floor(level)") && Contains("mix(") && Contains("low + 1.0"));
    }
}

TEST_CASE("snippets in WGSL have the functions of the others", "[tables][lut]") {
    const std::regex function(R"((?:^|\n)(?:fn|bool|float\d?|void) (irido_\w+)\()");
    const auto functions = [&](const std::string& source) {
        std::vector<std::string> names;
        for (auto at = std::sregex_iterator(source.begin(), source.end(), function);
             at != std::sregex_iterator(); ++at)
            names.push_back((*at)[1]);
        return names;
    };
    for (const std::string_view name : shader_names()) {
        INFO(name);
        const std::string wgsl = shader_source(name, "wgsl");
        const auto names = functions(wgsl);
        CHECK_FALSE(names.empty());
        CHECK(names == functions(shader_source(name, "hlsl")));
        CHECK_THAT(wgsl, !Contains("float") && !Contains("#if") && !Contains("SAMPLE"));
    }
}

TEST_CASE("declarations of WGSL", "[tables][lut]") {
    CHECK(wgsl_declarations("f32 f(f32 x, vec2f y)\n{\n    f32 a = max(x, 1.0), b, c[3];\n}\n") ==
          "fn f(x: f32, y: vec2f) -> f32\n{\n    var a: f32 = max(x, 1.0); var b: f32; var c: "
          "array<f32, 3>;\n}\n");
    CHECK(wgsl_declarations("#define A 1\nvoid f(r: ptr<function, vec3f>)\n{\n}\n") ==
          "fn f(r: ptr<function, vec3f>)\n{\n}\n");
    CHECK(wgsl_declarations("for (i32 i = 0; i < 3; i++) { f32(i); }  // f32 x, y;\n") ==
          "for (var i: i32 = 0; i < 3; i++) { f32(i); }  // f32 x, y;\n");
}
