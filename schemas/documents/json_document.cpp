#include "schemas/documents/json_document.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/nearest.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/number.hpp"
#include "schemas/readers/stack_expression.hpp"
#include "schemas/readers/text_file.hpp"
#include "schemas/readers/utf8.hpp"

namespace irido::schemas {
namespace {

using nlohmann::json;

constexpr std::size_t kDeepest = 64;

/// Iterates over the characters of a text and records how far the parser has got.
struct Reading {
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    const char* at;
    const char** furthest;

    reference operator*() const { return *at; }
    Reading& operator++() {
        *furthest = ++at;
        return *this;
    }
    Reading operator++(int) {
        Reading before = *this;
        ++*this;
        return before;
    }
    bool operator==(const Reading& other) const { return at == other.at; }
};

/// Builds the document from the parser's events and stops at the first error.
class DocumentBuilder : public json::json_sax_t {
public:
    explicit DocumentBuilder(std::string_view text) : text_(text), furthest_(text.data()) {}

    Reading begin() { return {text_.data(), &furthest_}; }
    Reading end() { return {text_.data() + text_.size(), &furthest_}; }

    json document;
    std::string refusal;      ///< message of the error
    std::size_t refused = 0;  ///< its position in bytes

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override {
        if (value > std::uint64_t{std::numeric_limits<std::int64_t>::max()}) {
            return add(static_cast<double>(value));  // must not wrap to a negative number anywhere
        }
        return add(value);
    }
    bool number_float(number_float_t value, const string_t&) override { return add(value); }
    bool string(string_t& value) override { return add(std::move(value)); }
    bool binary(binary_t&) override { return false; }

    bool start_object(std::size_t) override { return open(json::object()); }
    bool start_array(std::size_t) override { return open(json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        const auto [member, is_new] =
            open_.back()->get_ref<json::object_t&>().try_emplace(name, nullptr);
        member_ = &member->second;
        if (is_new) return true;
        return refuse("duplicate key \"" + name + "\"", bytes_read() - name.size() - 2);
    }

    bool parse_error(std::size_t, const std::string& token,
                     const nlohmann::detail::exception& error) override;

private:
    std::size_t bytes_read() const { return static_cast<std::size_t>(furthest_ - text_.data()); }

    bool refuse(std::string words, std::size_t where) {
        refusal = std::move(words);
        refused = std::min(where, text_.size());
        return false;
    }

    json& place(json value) {
        if (open_.empty()) return document = std::move(value);
        if (open_.back()->is_object()) return *member_ = std::move(value);
        open_.back()->push_back(std::move(value));
        return open_.back()->back();
    }
    bool add(json value) {
        place(std::move(value));
        return true;
    }
    bool open(json container) {
        if (open_.size() == kDeepest) {
            return refuse("nested more than 64 levels deep", bytes_read() - 1);
        }
        open_.push_back(&place(std::move(container)));
        return true;
    }
    bool close() {
        open_.pop_back();
        return true;
    }

    std::string_view text_;
    const char* furthest_;
    std::vector<json*> open_;  ///< the containers around the next value
    json* member_ = nullptr;   ///< destination of the value of the last key
};

/// The word of letters and digits around a byte offset.
std::string word_at(std::string_view text, std::size_t byte) {
    const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
    std::size_t first = byte;
    std::size_t end = byte;
    while (first > 0 && is_letter(text[first - 1])) --first;
    while (end < text.size() && is_letter(text[end])) ++end;
    return std::string(text.substr(first, end - first));
}

/// The parser's message without its prefix, position and excerpt.
std::string plain_words(std::string words) {
    const std::size_t dash = words.find(" - ");
    if (dash != std::string::npos) words.erase(0, dash + 3);
    words.erase(std::min(words.find("; last read"), words.size()));
    if (words.find("UTF-8") != std::string::npos) return "invalid UTF-8";
    return words;
}

bool DocumentBuilder::parse_error(std::size_t position, const std::string& token,
                                  const nlohmann::detail::exception& error) {
    constexpr int kNumberOverflow = 406;
    if (position > text_.size()) return refuse(plain_words(error.what()), text_.size());
    if (error.id == kNumberOverflow) {
        return refuse("the number " + token + " is too large", position - token.size());
    }
    const std::size_t last = position - std::min<std::size_t>(position, 1);
    const std::string words = plain_words(error.what());
    if (text_[last] == '/') return refuse("comments are not part of JSON", last);
    if (words == "invalid literal") {
        const std::string word = word_at(text_, last);
        return refuse(word.empty() ? "unexpected character" : "unknown word \"" + word + "\"",
                      last);
    }
    const bool has_token =
        words.starts_with("unexpected string") || words.starts_with("unexpected number");
    return refuse(words, has_token ? position - std::min(position, token.size()) : last);
}

/// Removes and returns the first step of a dotted path.
std::string take_step(std::string_view& path) {
    const std::size_t end = std::min(path.find('.'), path.size());
    std::string step(path.substr(0, end));
    path.remove_prefix(std::min(end + 1, path.size()));
    return step;
}

/// The same, indices without leading zeros.
std::string take_plain_step(std::string_view& path) {
    std::string step = take_step(path);
    const bool is_index = step.find_first_not_of("0123456789") == std::string::npos;
    if (is_index) step.erase(0, std::min(step.find_first_not_of('0'), step.size()));
    return step;
}

std::vector<std::string> keys_of(const json& object) {
    std::vector<std::string> keys;
    for (const auto& member : object.items()) keys.push_back(member.key());
    return keys;
}

/// The array element that a step of a path names.
json& element(json& array, const std::string& step, const std::string& path) {
    std::size_t index = 0;
    const char* const end = step.data() + step.size();
    const auto [stop, error] = std::from_chars(step.data(), end, index);
    if (error == std::errc() && stop == end && index < array.size()) return array[index];
    const std::size_t count = array.size();
    const std::string rule = count == 0 ? "names an element of an empty array"
                             : count == 1
                                 ? "the index must be 0, the array has one element"
                                 : "the index must be in [0, " + std::to_string(count - 1) + "]";
    throw InputError(path, "", rule + " (got \"" + step + "\")");
}

}  // namespace

json parse_json(std::string_view text, const std::string& file) {
    text = without_byte_order_mark(text);
    const std::size_t nul = text.find('\0');  // the parser would take it for the end
    DocumentBuilder builder(text.substr(0, nul));
    if (!json::sax_parse(builder.begin(), builder.end(), &builder)) {
        throw InputError(file, line_and_column(text, builder.refused), builder.refusal);
    }
    if (nul != text.npos) throw InputError(file, line_and_column(text, nul), "unexpected NUL byte");
    return std::move(builder.document);
}

void set_value(json& document, std::string_view path, json value) {
    const std::string whole(path);
    if (path.empty()) throw InputError("", "", "must name a value, as in layers.0.thickness_nm");
    if (std::count(path.begin(), path.end(), '.') >= std::ptrdiff_t{kDeepest}) {
        throw InputError(whole, "", "must be at most 64 levels deep");
    }
    json* place = &document;
    while (!path.empty()) {
        const std::string step = take_step(path);
        if (place->is_array()) {
            place = &element(*place, step, whole);
        } else if (!place->is_object()) {
            throw InputError(whole, "", "the value before \"" + step + "\" has no members");
        } else if (path.empty() || place->contains(step)) {
            place = &(*place)[step];
        } else {
            throw InputError(whole, "",
                             "unknown key \"" + step + "\"" + did_you_mean(step, keys_of(*place)));
        }
    }
    *place = std::move(value);
}

bool has_value(const json& document, std::string_view path) {
    const json* place = &document;
    while (!path.empty()) {
        const std::string step = take_step(path);
        if (place->is_array()) {
            const std::optional<double> index = parse_number(step);
            if (!index || !(*index >= 0 && *index < static_cast<double>(place->size())))
                return false;
            place = &(*place)[static_cast<std::size_t>(*index)];
        } else if (place->is_object() && place->contains(step)) {
            place = &(*place)[step];
        } else {
            return false;
        }
    }
    return true;
}

bool is_part_of(std::string_view path, std::string_view whole) {
    while (!path.empty() && !whole.empty())
        if (take_plain_step(path) != take_plain_step(whole)) return false;
    return whole.empty();
}

std::optional<PathOverlap> overlap_of(const std::vector<std::string>& paths) {
    std::unordered_map<std::string, std::size_t> known;  // by their plain steps
    for (std::size_t i = 0; i < paths.size(); ++i) {
        std::string plain;
        for (std::string_view rest = paths[i]; !rest.empty();) plain += take_plain_step(rest) + '.';
        const auto [found, is_new] = known.emplace(std::move(plain), i);
        if (!is_new) return PathOverlap{found->second, i, true};
    }
    for (std::size_t i = 0; i < paths.size(); ++i) {
        std::string plain;
        for (std::string_view rest = paths[i]; !rest.empty();) {
            plain += take_plain_step(rest) + '.';
            const auto outer = known.find(plain);
            if (outer != known.end() && !rest.empty()) return PathOverlap{i, outer->second};
        }
    }
    return std::nullopt;
}

json value_from_text(std::string_view path, std::string_view text) {
    constexpr std::array<std::string_view, 9> kMaterials{"material",      "incident", "substrate",
                                                         "inclusion",     "host",     "ordinary",
                                                         "extraordinary", "from",     "to"};
    const std::string_view key = path.substr(path.rfind('.') + 1);
    if (std::find(kMaterials.begin(), kMaterials.end(), key) != kMaterials.end()) {
        json index = parse_index(text);
        if (!index.is_null()) return index;
    }
    const std::string file = std::string(path) + "=" + std::string(text);
    const bool must_be_json = !text.empty() && std::string_view("{[\"").find(text[0]) <= 2;
    try {
        return parse_json(text, file);
    } catch (const InputError&) {
        if (must_be_json) throw;
        return std::string(text);
    }
}

void set_value(json& document, std::string_view path_equals_value) {
    const std::size_t equals = path_equals_value.find('=');
    if (equals == std::string_view::npos || equals == 0) {
        throw InputError("", "",
                         "must be PATH=VALUE, as in layers.0.thickness_nm=400 (got " +
                             in_quotes(path_equals_value) + ")");
    }
    const std::string_view path = path_equals_value.substr(0, equals);
    if (!is_well_formed(path_equals_value)) throw InputError(well_formed(path), "", kNoText);
    set_value(document, path, value_from_text(path, path_equals_value.substr(equals + 1)));
}

void shorten_numbers(json& value) {
    constexpr double kLargestWhole = 9007199254740992;
    if (value.is_structured()) {
        for (json& item : value) shorten_numbers(item);
    } else if (value.is_number_float()) {
        const double number = value.get<double>();
        if (number == std::floor(number) && std::abs(number) < kLargestWhole)
            value = static_cast<std::int64_t>(number);
    }
}

std::vector<std::string_view> split_values(std::string_view text) {
    std::vector<std::string_view> values;
    std::size_t start = 0;
    int depth = 0;
    bool in_quotes = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == ',' && depth <= 0 && !in_quotes) {
            values.push_back(trimmed(text.substr(start, i - start)));
            start = i + 1;
        } else if (in_quotes && c == '\\') {
            ++i;  // skips the escaped character
        } else if (c == '"') {
            in_quotes = !in_quotes;
        } else if (!in_quotes) {
            depth += (c == '[' || c == '{') - (c == ']' || c == '}');
        }
    }
    values.push_back(trimmed(text.substr(start)));
    return values;
}

}  // namespace irido::schemas
