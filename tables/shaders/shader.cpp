#include "tables/shaders/shader.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

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

/// Snippets available in WGSL, complete.
constexpr Snippet kWgslSnippets[] = {
#include "wgsl_shaders.inc"
};

/// Parts of other snippets, useless on their own.
constexpr std::array<std::string_view, 2> kParts{"common", "complex"};

struct Word {
    std::string_view word, glsl, hlsl;
};

/// Types and functions. $ stands for the first argument, & for the others with their commas.
constexpr Word kWords[] = {
    {"float2", "vec2", "float2"},
    {"float3", "vec3", "float3"},
    {"float4", "vec4", "float4"},
    {"lerp", "mix", "lerp"},
    {"fract", "fract", "frac"},
    {"atan2", "atan", "atan2"},
    {"TEXTURE2D", "highp sampler2D $", "Texture2D $, SamplerState $_sampler"},
    {"TEXTURE3D", "highp sampler3D $", "Texture3D $, SamplerState $_sampler"},
    {"PASS2D", "$", "$, $_sampler"},
    {"SAMPLE2D", "textureLod($&)", "$.SampleLevel($_sampler&)"},
    {"SAMPLE3D", "textureLod($&)", "$.SampleLevel($_sampler&)"},
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

std::string translated(std::string_view text, bool is_glsl);

/// A word that takes arguments, with these filled in.
std::string filled(std::string_view pattern, std::string_view arguments, bool is_glsl) {
    const std::size_t comma = arguments.find(',');
    const std::string_view first = arguments.substr(0, comma);
    std::string result;
    for (const char c : pattern) {
        if (c == '$')
            result += first;
        else if (c == '&')
            result += comma == std::string_view::npos
                          ? std::string()
                          : translated(arguments.substr(comma), is_glsl);
        else
            result += c;
    }
    return result;
}

std::string translated(std::string_view text, bool is_glsl) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
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
        const std::string_view pattern = is_glsl ? known->glsl : known->hlsl;
        if (pattern.find('$') == std::string_view::npos) {
            result += pattern;
            continue;
        }
        const std::size_t close = after_parentheses(text, i);
        result += filled(pattern, text.substr(i + 1, close - i - 2), is_glsl);
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
    return {"glsl", "hlsl", "wgsl"};
}

std::vector<std::string_view> shader_names_in(std::string_view language) {
    if (language != "wgsl") return shader_names();
    std::vector<std::string_view> names;
    for (const Snippet& s : kWgslSnippets) names.push_back(s.name);
    return names;
}

std::string shader_source(std::string_view name, std::string_view language) {
    std::string body;
    std::vector<std::string_view> there;
    const bool is_wgsl = language == "wgsl";
    if (is_wgsl)
        body = "\n" + std::string(std::ranges::find(kWgslSnippets, name, &Snippet::name)->text);
    else
        append(body, name, there);
    std::string head = "// irido " + this_build().version + ": " + std::string(name) + ", ";
    head += is_wgsl              ? "WGSL\n"
            : language == "glsl" ? "GLSL (ES 3.00 and later; needs highp float)\n"
                                 : "HLSL (shader model 4 and later)\n";
    head += "// SPDX-License-Identifier: MIT-0. No notice is needed where you paste this.\n";
    head += "// Tables: bilinear filtering, clamped to the edge. Lengths in nm.\n";
    return head + (is_wgsl ? body : translated(body, language == "glsl"));
}

}  // namespace irido::tables
