#include "schemas/stack_expression.hpp"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "schemas/input_error.hpp"

namespace irido {
namespace {

using nlohmann::json;

constexpr std::string_view kSpaces = " \t\r\n";
constexpr int kDeepest = 30;  // with the layers' own levels, what a file may have

std::string_view trim(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kSpaces);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(kSpaces) - first + 1);
}

/// A decimal number at the start of `text`, taken off it with the spaces behind.
std::optional<double> take_number(std::string_view& text) {
    const bool has_plus = text.starts_with('+');
    const std::string_view digits = text.substr(has_plus ? 1 : 0);
    const std::size_t first = digits.starts_with('-') && !has_plus ? 1 : 0;
    if (digits.find_first_of("0123456789.") != first) return std::nullopt;  // no "inf", no "nan"
    double value = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc()) return std::nullopt;
    text = trim(text.substr(static_cast<std::size_t>(stop - text.data())));
    return value;
}

bool take(char mark, std::string_view& text) {
    if (!text.starts_with(mark)) return false;
    text = trim(text.substr(1));
    return true;
}

json complex_index(double n, double k) {
    return {{"n", n}, {"k", k}};
}

class Parser {
public:
    explicit Parser(std::string_view text) : text_(text) {}

    json stack() {
        json document{{"incident", medium("the incident medium")}, {"layers", json::array()}};
        expect('|');
        while (true) {
            if (peek() == '(') {
                document["layers"].push_back(group(1));
            } else {
                json material = medium("a layer or the substrate");
                if (peek() == '\0') {
                    document["substrate"] = std::move(material);
                    return document;
                }
                document["layers"].push_back(layer(std::move(material)));
            }
            if (peek() == '\0') fail("\"|\" and the substrate");
            expect('|');
        }
    }

private:
    /// The next character that is no space, '\0' at the end.
    char peek() {
        at_ = std::min(text_.find_first_not_of(kSpaces, at_), text_.size());
        return at_ < text_.size() ? text_[at_] : '\0';
    }

    [[noreturn]] void fail(const std::string& expected) {
        const std::string found = peek() == '\0' ? "the end" : "\"" + next_word() + "\"";
        refuse("expected " + expected + ", found " + found);
    }

    [[noreturn]] void refuse(const std::string& words) {
        const auto characters =
            std::count_if(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_),
                          [](char c) { return (c & 0xC0) != 0x80; });
        throw InputError("\"" + std::string(text_) + "\"",
                         "column " + std::to_string(characters + 1), words);
    }

    void expect(char mark) {
        if (peek() != mark) fail(std::string("\"") + mark + "\"");
        ++at_;
    }

    /// What stands before the next mark, for reading and for messages.
    std::string next_word() {
        peek();
        const std::size_t end = std::min(text_.find_first_of("|@()^", at_), text_.size());
        const std::string_view word = trim(text_.substr(at_, end - at_));
        return std::string(word.empty() ? text_.substr(at_, 1) : word);
    }

    json medium(const std::string& expected) {
        const char first = peek();
        if (first == '\0' || std::string_view("|@()^").find(first) != std::string_view::npos) {
            fail(expected);
        }
        const std::string word = next_word();
        json material = parse_index(word);
        if (material.is_null()) {
            if (std::string_view("+-.0123456789").find(first) != std::string_view::npos) {
                fail("an index such as 1.5 or 1.9+1.5i, or the name of a material");
            }
            material = word;
        }
        at_ += word.size();
        return material;
    }

    double number(const std::string& expected) {
        peek();
        const std::string word = next_word();
        std::string_view rest = word;
        const std::optional<double> value = take_number(rest);
        if (!value || !rest.empty()) fail(expected);
        at_ += word.size();
        return *value;
    }

    json layer(json material) {
        if (peek() != '@') fail("\"@\" and the thickness of the layer");
        ++at_;
        return {{"material", std::move(material)}, {"thickness_nm", number("a thickness in nm")}};
    }

    json group(int depth) {
        if (depth > kDeepest) refuse("groups nest at most 30 deep");
        json layers = json::array();
        do {
            ++at_;  // the "(" or the "|" before
            layers.push_back(peek() == '(' ? group(depth + 1) : layer(medium("a layer")));
        } while (peek() == '|');
        expect(')');
        json result{{"repeat", 1}, {"layers", std::move(layers)}};
        if (peek() == '^') {
            ++at_;
            result["repeat"] = number("how many times the group repeats");
        }
        return result;
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

}  // namespace

json parse_index(std::string_view text) {
    std::string_view rest = trim(text);
    const std::optional<double> first = take_number(rest);
    if (!first) return nullptr;
    if (rest.empty()) return *first;
    if (rest == "i") return complex_index(0, *first);
    const double sign = rest[0] == '-' ? -1 : 1;
    if (!take('+', rest) && !take('-', rest)) return nullptr;
    if (rest.starts_with('-') || rest.starts_with('+')) return nullptr;
    const std::optional<double> second = take_number(rest);
    if (!second || rest != "i") return nullptr;
    return complex_index(*first, sign * *second);
}

json parse_stack_expression(std::string_view text) {
    return Parser(text).stack();
}

namespace {

std::string medium_text(const Material& material) {
    if (!material.name.empty()) return material.name;
    const auto index = index_at(material, 550);
    const std::string n = to_text(index.real()), k = to_text(std::abs(index.imag()));
    return index.imag() == 0 ? n : n + (index.imag() < 0 ? "-" : "+") + k + "i";
}

/// The elements with "|" between them.
std::string items_text(const Stack& stack, const std::vector<Element>& elements) {
    std::string text;
    for (const Element& element : elements) {
        if (!text.empty()) text += " | ";
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            text +=
                medium_text(stack.materials[layer->material]) + "@" + to_text(layer->thickness_nm);
        } else {
            const Group& group = std::get<Group>(element.value);
            text += "(" + items_text(stack, group.elements) + ")^" + std::to_string(group.repeat);
        }
    }
    return text;
}

}  // namespace

std::string stack_expression(const Stack& stack) {
    const std::string items = items_text(stack, stack.elements);
    return medium_text(stack.materials[stack.incident]) + " | " +
           (items.empty() ? "" : items + " | ") + medium_text(stack.materials[stack.substrate]);
}

}  // namespace irido
