#include "schemas/documents/schema_check.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <string_view>
#include <tuple>
#include <utility>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "core/error.hpp"
#include "core/nearest.hpp"

// valijson decides whether and where a document is invalid. Its own messages only serve to tell the
// kinds of errors apart. The messages for users come from two keywords registered in addition to
// its own: during validation they look at the errors just recorded for the same value and append a
// line to them.

namespace irido::schemas {
namespace {

using nlohmann::json;
using valijson::ValidationResults;
using valijson::adapters::Adapter;

/// Location of a value: valijson's "<root>", "[key]", "[3]", ...
using Place = std::vector<std::string>;

constexpr std::string_view kRule = "rule: ";               // ours: message of a violated rule
constexpr std::string_view kUnknownKey = "unknown key: ";  // ours: nearest known key
constexpr std::string_view kMissingKey = "Missing required property '";
constexpr std::string_view kStrayKey = "Object contains a property";
constexpr std::string_view kUmbrella = "Failed to validate";

bool is_plain(std::string_view error) {
    return !error.starts_with(kUmbrella) && !error.starts_with(kMissingKey) &&
           !error.starts_with(kStrayKey) && !error.starts_with(kUnknownKey);
}

/// True if any of the errors of the value at `place`, which are the last ones, is of this kind.
template <class Kind>
bool has_error(const ValidationResults& results, const Place& place, Kind is_kind) {
    for (auto error = results.end(); error != results.begin();) {
        --error;
        if (error->context.size() < place.size()) return false;
        if (!std::equal(place.begin(), place.end(), error->context.begin())) return false;
        if (error->context.size() > place.size()) continue;
        if (error->description.starts_with(kRule)) return false;
        if (is_kind(error->description)) return true;
    }
    return false;
}

/// A keyword that adds messages to errors and never affects validity.
template <class Keyword>
class Annotation : public valijson::constraints::PolyConstraint {
public:
    bool validate(const Adapter& value, const Place& place,
                  ValidationResults* results) const override {
        if (results != nullptr) static_cast<const Keyword*>(this)->explain(value, place, *results);
        return true;
    }

private:
    Constraint* cloneInto(void* memory) const override {
        return new (memory) Keyword(*static_cast<const Keyword*>(this));
    }
    std::size_t sizeOf() const override { return sizeof(Keyword); }
};

/// "errorMessage": the schema's message for a value that violates one of its rules.
class RuleInWords : public Annotation<RuleInWords> {
public:
    explicit RuleInWords(const Adapter& words) : words_(words.asString()) {}

    void explain(const Adapter& /*value*/, const Place& place, ValidationResults& results) const {
        if (!has_error(results, place, is_plain)) return;
        results.pushError(place, std::string(kRule) + words_);
    }

private:
    std::string words_;
};

/// "properties": reports every key that is not listed, where no others are allowed.
class KnownKeys : public Annotation<KnownKeys> {
public:
    explicit KnownKeys(const Adapter& properties) {
        properties.applyToObject([&](const std::string& key, const Adapter&) {
            keys_.push_back(key);
            return true;
        });
    }

    void explain(const Adapter& value, const Place& place, ValidationResults& results) const {
        const auto is_stray = [](const std::string& error) { return error.starts_with(kStrayKey); };
        if (!has_error(results, place, is_stray)) return;
        value.applyToObject([&](const std::string& key, const Adapter&) {
            if (std::find(keys_.begin(), keys_.end(), key) != keys_.end()) return true;
            Place stray = place;
            stray.push_back("[" + key + "]");
            results.pushError(stray, std::string(kUnknownKey) + nearest(key, keys_));
            return true;
        });
    }

private:
    std::vector<std::string> keys_;
};

template <class Keyword>
struct Builder : valijson::ConstraintBuilder {
    valijson::constraints::Constraint* make(const Adapter& value) const override {
        return new Keyword(value);
    }
};

ValidationResults validate(const Schema& schema, const json& document) {
    ValidationResults results;
    valijson::Validator().validate(schema.rules(),
                                   valijson::adapters::NlohmannJsonAdapter(document), &results);
    return results;
}

/// An error while it is being converted to a Problem.
struct Finding {
    Place place;
    std::string words;
    bool shows_value = false;
    bool is_placeholder = false;  ///< a violated rule whose message is still to come
};

std::string_view after(std::string_view prefix, std::string_view text) {
    return text.substr(prefix.size());
}

/// Converts one of valijson's errors, if it is relevant, and adds it to the findings.
void add_finding(const Place& place, std::string_view error, std::vector<Finding>& findings) {
    if (error.starts_with(kUmbrella) || error.starts_with(kStrayKey)) return;
    if (error.starts_with(kMissingKey)) {
        const std::string_view key = after(kMissingKey, error);
        findings.push_back(
            {place, "must have the key \"" + std::string(key.substr(0, key.rfind('\''))) + "\""});
    } else if (error.starts_with(kUnknownKey)) {
        const std::string known(after(kUnknownKey, error));
        findings.push_back({place, known.empty()
                                       ? "unknown key"
                                       : "unknown key (did you mean \"" + known + "\"?)"});
    } else if (error.starts_with(kRule)) {
        const auto explained = std::find_if(findings.rbegin(), findings.rend(), [&](const auto& f) {
            return !f.is_placeholder || f.place != place;
        });
        findings.erase(explained.base(), findings.end());
        findings.push_back({place, std::string(after(kRule, error)), true});
    } else {
        findings.push_back({place, "is not allowed here", true, true});
    }
}

/// A misspelt key explains why its object lacks a key: drops findings about the correct key.
void drop_consequences(std::vector<Finding>& findings) {
    std::multimap<Place, std::string> meant;
    constexpr std::string_view kMeant = "unknown key (did you mean ";
    for (const Finding& finding : findings) {
        if (!finding.words.starts_with(kMeant)) continue;
        const std::string_view key = after(kMeant, finding.words);
        meant.emplace(Place(finding.place.begin(), finding.place.end() - 1),
                      key.substr(0, key.size() - 2));
    }
    std::erase_if(findings, [&](const Finding& finding) {
        const auto [first, last] = meant.equal_range(finding.place);
        return std::any_of(first, last, [&](const auto& right) {
            return finding.words.find(right.second) != std::string::npos;
        });
    });
}

/// Order of two steps: "[10]" after "[9]", keys alphabetically.
bool step_before(const std::string& a, const std::string& b) {
    const auto is_index = [](const std::string& step) {
        return step.size() > 2 && std::isdigit(static_cast<unsigned char>(step[1])) != 0;
    };
    if (is_index(a) && is_index(b)) return std::tuple(a.size(), a) < std::tuple(b.size(), b);
    return a < b;
}

bool document_order(const Finding& a, const Finding& b) {
    return std::lexicographical_compare(a.place.begin(), a.place.end(), b.place.begin(),
                                        b.place.end(), step_before);
}

/// The value at a place; also writes its JSON pointer.
const json& follow(const Place& place, const json& document, std::string& pointer) {
    const json* value = &document;
    for (auto step = place.begin() + 1; step != place.end(); ++step) {
        const std::string key = step->substr(1, step->size() - 2);
        value = value->is_array() ? &value->at(std::stoul(key)) : &value->at(key);
        pointer += pointer_step(key);
    }
    return *value;
}

/// The names of "must be one of a, b, c"; none of other rules.
std::vector<std::string> names_of_rule(std::string_view words) {
    constexpr std::string_view kOneOf = "must be one of ", kSeparator = ", ";
    std::vector<std::string> names;
    if (!words.starts_with(kOneOf)) return names;
    words.remove_prefix(kOneOf.size());
    for (std::size_t end = 0; end != std::string_view::npos;) {
        end = words.find(kSeparator);
        names.emplace_back(words.substr(0, end));
        if (end != std::string_view::npos) words.remove_prefix(end + kSeparator.size());
    }
    return names;
}

/// "must be in [...]" also states the type if the value has a different one; "must be one of ..."
/// the name that was probably meant.
std::string with_value(std::string words, const json& value) {
    constexpr std::string_view kRange = "must be in [";
    const std::string meant =
        value.is_string() ? did_you_mean(value.get<std::string>(), names_of_rule(words)) : "";
    if (words.starts_with(kRange) && !value.is_number()) {
        words.replace(0, kRange.size(), "must be a number in [");
    }
    return words + " (got " + short_text(value) + ")" + meant;
}

}  // namespace

Schema::Schema(const json& document) : rules_(std::make_unique<valijson::Schema>()) {
    valijson::SchemaParser parser;
    parser.addConstraintBuilder("properties", new Builder<KnownKeys>);  // the parser deletes it
    parser.addConstraintBuilder("errorMessage", new Builder<RuleInWords>);
    parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(document), *rules_);
}

Schema::~Schema() = default;

std::string pointer_step(const std::string& key) {
    std::string step = "/";
    for (const char c : key) {
        if (c == '~') {
            step += "~0";
        } else if (c == '/') {
            step += "~1";
        } else {
            step += static_cast<unsigned char>(c) < ' ' ? '?' : c;  // a message is one line
        }
    }
    return step;
}

std::string short_text(const json& value) {
    constexpr std::size_t kLongest = 40;
    if (value.is_number()) return to_text(value.get<double>());
    std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
    if (text.size() <= kLongest) return text;
    std::size_t end = kLongest - 3;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
    return text.substr(0, end) + "...";
}

std::vector<Problem> check(const Schema& schema, const json& document) {
    std::vector<Finding> findings;
    for (const auto& error : validate(schema, document)) {
        add_finding(error.context, error.description, findings);
    }
    drop_consequences(findings);
    std::stable_sort(findings.begin(), findings.end(), document_order);

    std::vector<Problem> problems;
    for (const Finding& finding : findings) {
        Problem problem;
        const json& value = follow(finding.place, document, problem.pointer);
        problem.message = finding.shows_value ? with_value(finding.words, value) : finding.words;
        if (problems.empty() || problems.back() != problem) problems.push_back(std::move(problem));
    }
    return problems;
}

}  // namespace irido::schemas
