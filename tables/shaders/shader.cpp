#include "tables/shaders/shader.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

#include "tables/shaders/wgsl.hpp"
#include "tables/version.hpp"

namespace irido::tables {

namespace {

struct Snippet {
    std::string_view name, text;
};

/// Written once, using the words below for the language.
constexpr Snippet kSnippets[] = {
#include "shaders.inc"
};

/// Parts of others, nothing by themselves.
constexpr std::array<std::string_view, 2> kParts{"common", "complex"};

struct Word {
    std::string_view word;
    std::array<std::string_view, 3> in;  ///< glsl, hlsl, wgsl
};

constexpr std::array<std::string_view, 3> kLanguages{"glsl", "hlsl", "wgsl"};
constexpr std::size_t kWgsl = 2;

/// Types and functions. $1, $2, $3 stand for arguments.
constexpr Word kWords[] = {
    {"float", {"float", "float", "f32"}},
    {"float2", {"vec2", "float2", "vec2f"}},
    {"float3", {"vec3", "float3", "vec3f"}},
    {"float4", {"vec4", "float4", "vec4f"}},
    {"int", {"int", "int", "i32"}},
    {"lerp", {"mix", "lerp", "mix"}},
    {"fract", {"fract", "frac", "fract"}},
    {"atan2", {"atan", "atan2", "atan2"}},
    // a condition, and values for true and false
    {"PICK", {"($1 ? $2 : $3)", "($1 ? $2 : $3)", "select($3, $2, $1)"}},
    // parameters: tables, an array of numbers (name, length), results (type, name)
    {"TEXTURE2D",
     {"highp sampler2D $1", "Texture2D $1, SamplerState $1_sampler",
      "$1: texture_2d<f32>, $1_sampler: sampler"}},
    {"TEXTURE3D",
     {"highp sampler3D $1", "Texture3D $1, SamplerState $1_sampler",
      "$1: texture_3d<f32>, $1_sampler: sampler"}},
    {"FLOATS", {"float $1[$2]", "float $1[$2]", "$1: array<f32, $2>"}},
    {"OUT", {"out $1 $2", "out $1 $2", "$2: ptr<function, $1>"}},
    // a table handed on, or looked up; a result that is set, or asked for
    {"PASS2D", {"$1", "$1, $1_sampler", "$1, $1_sampler"}},
    {"SAMPLE2D",
     {"textureLod($1, $2, $3)", "$1.SampleLevel($1_sampler, $2, $3)",
      "textureSampleLevel($1, $1_sampler, $2, $3)"}},
    {"SAMPLE3D",
     {"textureLod($1, $2, $3)", "$1.SampleLevel($1_sampler, $2, $3)",
      "textureSampleLevel($1, $1_sampler, $2, $3)"}},
    {"RESULT", {"$1", "$1", "*$1"}},
    {"ASK", {"$1", "$1", "&$1"}},
};

bool is_letter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

const Snippet& snippet(std::string_view name) {
    return *std::ranges::find(kSnippets, name, &Snippet::name);
}

/// The position after the parenthesis that closes the one at `open`.
std::size_t after_parentheses(std::string_view text, std::size_t open) {
    int depth = 0;
    std::size_t i = open;
    do {
        depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
        ++i;
    } while (depth > 0);
    return i;
}

std::string translated(std::string_view text, std::size_t language);

/// Arguments between commas that are in no parentheses, translated.
std::vector<std::string> arguments_of(std::string_view text, std::size_t language) {
    std::vector<std::string> arguments;
    int depth = 0;
    std::size_t from = 0;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        const bool ends = i == text.size() || (text[i] == ',' && depth == 0);
        if (!ends) {
            depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
            continue;
        }
        const std::string_view one = text.substr(from, i - from);
        const std::size_t first = std::min(one.find_first_not_of(" \n"), one.size());
        arguments.push_back(translated(one.substr(first), language));
        from = i + 1;
    }
    return arguments;
}

/// A word that takes arguments, with them filled in.
std::string filled(std::string_view pattern, const std::vector<std::string>& arguments) {
    std::string result;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        if (pattern[i] == '$')
            result += arguments.at(static_cast<std::size_t>(pattern[++i] - '1'));
        else
            result += pattern[i];
    }
    return result;
}

std::string translated(std::string_view text, std::size_t language) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        if (text.substr(i).starts_with("//")) {
            const std::size_t end = std::min(text.find('\n', i), text.size());
            result += text.substr(i, end - i);
            i = end;
            continue;
        }
        if (!is_letter(text[i])) {
            result += text[i++];
            continue;
        }
        std::size_t end = i;
        while (end < text.size() && is_letter(text[end])) ++end;
        const std::string_view word = text.substr(i, end - i);
        const auto* const known = std::ranges::find(kWords, word, &Word::word);
        i = end;
        if (known == std::end(kWords)) {
            result += word;
            continue;
        }
        const std::string_view pattern = known->in[language];
        const bool takes_arguments = known->in[kWgsl].find('$') != std::string_view::npos;
        if (!takes_arguments) {
            result += pattern;
            continue;
        }
        const std::size_t close = after_parentheses(text, i);
        result += filled(pattern, arguments_of(text.substr(i + 1, close - i - 2), language));
        i = close;
    }
    return result;
}

/// Appends a snippet after those that it uses and that are not there yet.
void append(std::string& out, std::string_view name, std::vector<std::string_view>& there) {
    constexpr std::string_view use = "//! use:";
    if (std::ranges::find(there, name) != there.end()) return;
    there.push_back(name);
    std::string_view text = snippet(name).text;
    if (text.starts_with(use)) {
        const std::size_t line = text.find('\n');
        std::istringstream names(std::string(text.substr(use.size(), line - use.size())));
        for (std::string used; names >> used;) append(out, snippet(used).name, there);
        text.remove_prefix(line + 1);
    }
    out += '\n';
    out += text;
}

}  // namespace

std::vector<std::string_view> shader_names() {
    std::vector<std::string_view> names;
    for (const Snippet& s : kSnippets)
        if (std::ranges::find(kParts, s.name) == kParts.end()) names.push_back(s.name);
    return names;
}

std::vector<std::string_view> shader_languages() {
    return {kLanguages.begin(), kLanguages.end()};
}

std::string shader_source(std::string_view name, std::string_view language) {
    constexpr std::array<std::string_view, 3> titles{"GLSL (ES 3.00 and later; needs highp float)",
                                                     "HLSL (shader model 4 and later)", "WGSL"};
    std::string body;
    std::vector<std::string_view> there;
    append(body, name, there);
    const auto place =
        static_cast<std::size_t>(std::ranges::find(kLanguages, language) - kLanguages.begin());
    body = translated(body, place);
    if (place == kWgsl) body = wgsl_declarations(body);
    return "// irido " + this_build().version + ": " + std::string(name) + ", " +
           std::string(titles[place]) +
           "\n// SPDX-License-Identifier: MIT-0. No notice is needed where you paste this.\n"
           "// Tables: bilinear filtering, clamped to the edge. Lengths in nm.\n" +
           body;
}

}  // namespace irido::tables
