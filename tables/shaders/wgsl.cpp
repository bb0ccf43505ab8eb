#include "tables/shaders/wgsl.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace irido::tables {

namespace {

constexpr std::array<std::string_view, 7> kWgslTypes{"f32", "vec2f", "vec3f", "vec4f",
                                                     "i32", "bool",  "void"};

bool is_of_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string_view name_at(std::string_view text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && is_of_name(text[end])) ++end;
    return text.substr(at, end - at);
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0)
        text.remove_prefix(1);
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0)
        text.remove_suffix(1);
    return text;
}

/// The first place from `at` on where `end` stands outside of all brackets.
std::size_t find_outside(std::string_view text, std::size_t at, char end,
                         std::string_view brackets = "()") {
    int depth = 0;
    for (; at < text.size(); ++at) {
        if (depth == 0 && text[at] == end) return at;
        depth += text[at] == brackets[0] ? 1 : text[at] == brackets[1] ? -1 : 0;
    }
    return at;
}

/// Parts between commas outside of brackets.
std::vector<std::string_view> parts_of(std::string_view text, std::string_view brackets) {
    std::vector<std::string_view> parts;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = find_outside(text, at, ',', brackets);
        parts.push_back(trimmed(text.substr(at, end - at)));
        at = end + 1;
    }
    return parts;
}

bool is_type(std::string_view word) {
    return std::ranges::find(kWgslTypes, word) != kWgslTypes.end();
}

/// "f32 x" as "x: f32"; others are as WGSL has them.
std::string parameter_of(std::string_view typed) {
    const std::string_view type = name_at(typed, 0);
    if (!is_type(type)) return std::string(typed);
    return std::string(trimmed(typed.substr(type.size()))) + ": " + std::string(type);
}

std::string declaration_of(std::string_view type, std::string_view one) {
    const std::string_view name = name_at(one, 0);
    std::string_view rest = trimmed(one.substr(name.size()));
    std::string whole(type);
    if (rest.starts_with('[')) {
        const std::size_t close = rest.find(']');
        whole = "array<" + whole + ", " + std::string(rest.substr(1, close - 1)) + ">";
        rest = trimmed(rest.substr(close + 1));
    }
    std::string text = "var " + std::string(name) + ": " + whole;
    return rest.empty() ? text : text + " " + std::string(rest);
}

}  // namespace

std::string wgsl_declarations(std::string_view code) {
    std::string out;
    for (std::size_t at = 0; at < code.size();) {
        const bool is_line_start = at == 0 || code[at - 1] == '\n';
        if ((is_line_start && code[at] == '#') || code.substr(at).starts_with("//")) {
            const std::size_t end = std::min(code.find('\n', at), code.size());
            if (code[at] == '#')
                at = std::min(end + 1, code.size());
            else
                out += code.substr(at, end - at), at = end;
            continue;
        }
        if (!is_of_name(code[at])) {
            out += code[at++];
            continue;
        }
        const std::string_view word = name_at(code, at);
        const std::size_t next = at + word.size();
        const bool declares = is_type(word) && next + 1 < code.size() && code[next] == ' ' &&
                              is_of_name(code[next + 1]);
        if (!declares) {
            out += word;
            at = next;
            continue;
        }
        const std::string_view name = name_at(code, next + 1);
        const std::size_t after = next + 1 + name.size();
        if (is_line_start && after < code.size() && code[after] == '(') {
            const std::size_t close = find_outside(code, after + 1, ')');
            std::string head = "fn " + std::string(name) + "(";
            const std::string indent = ",\n    " + std::string(head.size() - 4, ' ');
            std::size_t width = head.size();
            bool is_first = true;
            for (const std::string_view typed :
                 parts_of(code.substr(after + 1, close - after - 1), "<>")) {
                const std::string one = parameter_of(typed);
                const bool breaks = !is_first && width + 2 + one.size() > 96;
                head += is_first ? "" : breaks ? indent : ", ";
                width = (breaks ? indent.size() - 2 : width + 2) + one.size();
                head += one;
                is_first = false;
            }
            out += head + ")" + (word == "void" ? "" : " -> " + std::string(word));
            at = close + 1;
            continue;
        }
        const std::size_t end = find_outside(code, next, ';');
        bool is_first = true;
        for (const std::string_view one : parts_of(code.substr(next, end - next), "()")) {
            out += (is_first ? "" : "; ") + declaration_of(word, one);
            is_first = false;
        }
        at = end;
    }
    return out;
}

}  // namespace irido::tables
