#include "schemas/readers/stack_expression.hpp"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/material/library.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/material_database.hpp"
#include "schemas/readers/material_file.hpp"

namespace irido::schemas {
namespace {

using nlohmann::json;

constexpr std::string_view kSpaces = " \t\r\n";
constexpr std::string_view kMarks = "|@()^!";
constexpr int kDeepest = 30;  // with the levels of the layers themselves, the limit of files

std::string_view trim(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kSpaces);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(kSpaces) - first + 1);
}

/// Removes and returns a decimal number at the start of `text`, with the spaces after it.
std::optional<double> take_number(std::string_view& text) {
    const bool has_plus = text.starts_with('+');
    const std::string_view digits = text.substr(has_plus ? 1 : 0);
    const std::size_t first = digits.starts_with('-') && !has_plus ? 1 : 0;
    if (digits.find_first_of("0123456789.") != first) return std::nullopt;  // no "inf", no "nan"
    double value = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc()) return std::nullopt;
    text = trim(text.substr(static_cast<std::size_t>(stop - text.data())));
    return value + 0.0;  // no negative zero
}

bool take(char mark, std::string_view& text) {
    if (!text.starts_with(mark)) return false;
    text = trim(text.substr(1));
    return true;
}

/// "i" or "j"
bool is_imaginary_unit(std::string_view text) {
    return text == "i" || text == "j";
}

/// The nm of "100", "100nm", "0.1um" or "1 mm", rounded once; empty for any other text.
std::optional<double> parse_thickness(std::string_view text) {
    std::string_view unit = text;
    const std::optional<double> value = take_number(unit);
    if (!value || unit.empty() || unit == "nm") return value;
    const bool is_um = unit == "um" || unit == "\u00B5m" || unit == "\u03BCm";
    if (!is_um && unit != "mm") return std::nullopt;
    const std::string_view digits = trim(text.substr(0, text.size() - unit.size()));
    const std::size_t mantissa = std::min(digits.find_first_of("eE"), digits.size());
    std::string_view exponent = digits.substr(std::min(mantissa + 1, digits.size()));
    const double shift = (is_um ? 3 : 6) + take_number(exponent).value_or(0);
    std::string shifted(digits.substr(0, mantissa));
    shifted += "e" + to_text(shift);
    std::string_view rest = shifted;
    return take_number(rest);
}

/// The number of "1Q".
std::optional<double> parse_quarter_waves(std::string_view text) {
    const std::optional<double> count = take_number(text);
    return text == "Q" ? count : std::nullopt;
}

json complex_index(double n, double k) {
    return {{"n", n}, {"k", k}};
}

/// Where the text says a value of the document.
struct TypedValue {
    std::string path;
    std::size_t begin, end;
};

std::string path_of_layer(const std::string& list, std::size_t number) {
    return list + "." + std::to_string(number);
}

class Parser {
public:
    explicit Parser(std::string_view text) : text_(text) {}

    json stack() {
        json document{{"incident", medium("the incident medium", "incident")},
                      {"layers", json::array()}};
        json& layers = document["layers"];
        expect('|');
        while (true) {
            const std::string path = path_of_layer("layers", layers.size());
            if (peek() == '(') {
                layers.push_back(group(1, path));
            } else {
                json material = medium("a layer or the substrate", path + ".material");
                if (peek() == '\0') {
                    typed_.back().path = "substrate";
                    document["substrate"] = std::move(material);
                    return document;
                }
                layers.push_back(layer(std::move(material), path));
            }
            if (peek() == '\0') fail("\"|\" and the substrate");
            expect('|');
        }
    }

    /// Of the last stack(), in the order of the text.
    const std::vector<TypedValue>& typed() const { return typed_; }

private:
    /// The next character that is not a space, '\0' at the end.
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

    /// The text up to the next mark, for reading and for messages.
    std::string next_word() {
        peek();
        const std::size_t end = std::min(text_.find_first_of(kMarks, at_), text_.size());
        const std::string_view word = trim(text_.substr(at_, end - at_));
        return std::string(word.empty() ? text_.substr(at_, 1) : word);
    }

    /// Steps over a value of the document.
    void pass(std::string path, std::size_t length) {
        typed_.push_back({std::move(path), at_, at_ + length});
        at_ += length;
    }

    json medium(const std::string& expected, std::string path) {
        const char first = peek();
        if (first == '\0' || kMarks.find(first) != std::string_view::npos) fail(expected);
        if (first == '"') return quoted_name(std::move(path));
        const std::string word = next_word();
        json material = parse_index(word);
        if (material.is_null()) {
            const bool is_number =
                std::string_view("+-0123456789").find(first) != kMarks.npos ||
                (first == '.' && !word.starts_with("./") && !word.starts_with("../"));
            if (is_number && !is_material_file(word)) {
                fail("an index such as 1.5 or 1.9+1.5i, or the name of a material");
            }
            material = word;
        }
        pass(std::move(path), word.size());
        return material;
    }

    /// A name in double quotes, which may contain any mark.
    json quoted_name(std::string path) {
        const std::size_t end = text_.find('"', at_ + 1);
        if (end == text_.npos) fail("a closing \" after the name");
        if (end == at_ + 1) refuse("a name must not be empty");
        std::string name(text_.substr(at_ + 1, end - at_ - 1));
        pass(std::move(path), end + 1 - at_);
        return name;
    }

    double repeat(const std::string& path) {
        const std::string word = next_word();
        std::string_view rest = word;
        const std::optional<double> value = take_number(rest);
        if (!value || !rest.empty()) fail("the number of repetitions");
        pass(path + ".repeat", word.size());
        return *value;
    }

    json layer(json material, const std::string& path) {
        if (peek() != '@') fail("\"@\" and the thickness of the layer");
        ++at_;
        const std::string word = next_word();
        json result{{"material", std::move(material)}};
        if (const std::optional<double> quarters = parse_quarter_waves(word)) {
            result["qwot"] = *quarters;
        } else if (const std::optional<double> thickness_nm = parse_thickness(word)) {
            result["thickness_nm"] = *thickness_nm;
        } else {
            std::string_view rest = word;
            fail(take_number(rest) ? "a thickness such as 100, 100nm, 0.1um, 1mm or 1Q"
                                   : "a thickness in nm");
        }
        pass(path + (result.contains("qwot") ? ".qwot" : ".thickness_nm"), word.size());
        if (peek() == '!') {
            ++at_;
            result["coherent"] = false;
        }
        return result;
    }

    json group(int depth, const std::string& path) {
        if (depth > kDeepest) refuse("groups must nest at most 30 deep");
        json layers = json::array();
        do {
            ++at_;  // the preceding "(" or "|"
            const std::string inner = path_of_layer(path + ".layers", layers.size());
            layers.push_back(peek() == '(' ? group(depth + 1, inner)
                                           : layer(medium("a layer", inner + ".material"), inner));
        } while (peek() == '|');
        expect(')');
        json result{{"repeat", 1}, {"layers", std::move(layers)}};
        if (peek() == '^') {
            ++at_;
            result["repeat"] = repeat(path);
        }
        return result;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::vector<TypedValue> typed_;
};

/// Whether one of two dotted paths leads to the other's value or to a part of it.
bool overlap(std::string_view a, std::string_view b) {
    const std::size_t shorter = std::min(a.size(), b.size());
    if (a.substr(0, shorter) != b.substr(0, shorter)) return false;
    return a.size() == b.size() || (a.size() > shorter ? a : b)[shorter] == '.';
}

}  // namespace

json parse_index(std::string_view text) {
    std::string_view rest = trim(text);
    const std::optional<double> first = take_number(rest);
    if (!first) return nullptr;
    if (rest.empty()) return *first;
    if (is_imaginary_unit(rest)) return complex_index(0, *first);
    const double sign = rest[0] == '-' ? -1 : 1;
    if (!take('+', rest) && !take('-', rest)) return nullptr;
    if (rest.starts_with('-') || rest.starts_with('+')) return nullptr;
    const std::optional<double> second = take_number(rest);
    if (!second || !is_imaginary_unit(rest)) return nullptr;
    return complex_index(*first, sign * *second);
}

json parse_stack_expression(std::string_view text) {
    return Parser(text).stack();
}

std::string expression_with(std::string_view text,
                            const std::vector<std::pair<std::string, std::string>>& values) {
    Parser parser(text);
    parser.stack();
    std::string changed;
    std::size_t at = 0;
    for (const TypedValue& typed : parser.typed()) {
        changed += text.substr(at, typed.begin - at);
        std::string value(text.substr(typed.begin, typed.end - typed.begin));
        for (const auto& [path, other] : values) {
            if (!overlap(path, typed.path)) continue;
            const bool is_number = path.ends_with(".qwot") && !other.ends_with("\u2026");
            value = path != typed.path ? "\u2026" : is_number ? other + "Q" : other;
        }
        changed += value;
        at = typed.end;
    }
    return changed.append(text.substr(at));
}

std::string medium_text(const Material& material, std::vector<std::string>& losses) {
    const auto built_in = find_material(material.name);
    const bool is_known = built_in && built_in->material.model == material.model;
    const bool is_of_database = material.name.starts_with(kDatabaseMark);
    if (is_known || is_of_database || is_material_file(material.name)) {
        if (material.outside == Outside::clamp &&
            !(is_known && built_in->material.outside == Outside::clamp))
            losses.push_back(material.name + ": extrapolate");
        return material.name;
    }
    if (is_uniaxial(material))
        losses.push_back(material.name + ": uniaxial, written as its ordinary index at 550 nm");
    else if (!is_constant(material))
        losses.push_back(material.name + ": written as its index at 550 nm");
    Material clamped = material;
    clamped.outside = Outside::clamp;
    const auto index = index_at(clamped, 550);
    const std::string n = to_text(index.real()), k = to_text(std::abs(index.imag()));
    return index.imag() == 0 ? n : n + (index.imag() < 0 ? "-" : "+") + k + "i";
}

namespace {

/// Writes a stack as an expression and collects what it cannot express.
class Writer {
public:
    Writer(const Stack& stack, std::vector<std::string>& losses) : stack_(stack), losses_(losses) {}

    std::string text() {
        const std::string items = items_text(stack_.elements);
        const std::string incident = medium(stack_.incident);
        return incident + " | " + (items.empty() ? "" : items + " | ") + medium(stack_.substrate);
    }

private:
    std::string medium(std::size_t place) {
        std::vector<std::string> lost;
        const std::string text = medium_text(stack_.materials[place], lost);
        for (const std::string& what : lost) lose(what);
        return parse_index(text).is_null() ? quoted_where_needed(text) : text;
    }

    static std::string quoted_where_needed(const std::string& name) {
        const bool has_mark = name.find_first_of(kMarks) != name.npos;
        return has_mark ? "\"" + name + "\"" : name;
    }

    /// The elements with "|" between them.
    std::string items_text(const std::vector<Element>& elements) {
        std::string text;
        for (const Element& element : elements) {
            if (!text.empty()) text += " | ";
            if (const Layer* layer = std::get_if<Layer>(&element.value)) {
                text += medium(layer->material) + "@" + to_text(layer->thickness_nm) +
                        (layer->coherent ? "" : "!");
                if (layer->thickness_sigma_nm != 0) lose("thickness_sigma_nm");
            } else {
                const Group& group = std::get<Group>(element.value);
                text += "(" + items_text(group.elements) + ")^" + std::to_string(group.repeat);
            }
        }
        return text;
    }

    void lose(const std::string& what) {
        if (std::find(losses_.begin(), losses_.end(), what) == losses_.end())
            losses_.push_back(what);
    }

    const Stack& stack_;
    std::vector<std::string>& losses_;
};

}  // namespace

StackExpression stack_expression(const Stack& stack) {
    StackExpression result;
    result.text = Writer(stack, result.losses).text();
    return result;
}

}  // namespace irido::schemas
