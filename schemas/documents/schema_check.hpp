#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace valijson {
class Schema;
}

namespace irido::schemas {

/// A violated rule of a document.
struct Problem {
    std::string pointer;  ///< JSON pointer of the value, "" for the document itself
    std::string message;  ///< the rule in words, with the value: "must be in [0, 1e9] (got -5)"
    bool operator==(const Problem&) const = default;
};

/// A compiled JSON schema (draft-07); compiling takes longer than checking a small document.
/// Thread-safe.
class Schema {
public:
    explicit Schema(const nlohmann::json& document);
    ~Schema();
    Schema(const Schema&) = delete;
    Schema& operator=(const Schema&) = delete;

    const valijson::Schema& rules() const { return *rules_; }

private:
    std::unique_ptr<valijson::Schema> rules_;
};

/// All violations, each once, at the deepest place that violates the rule; arrays in order, keys
/// alphabetically. Messages come from the keyword `errorMessage` next to the rule in the schema
/// (draft-07).
std::vector<Problem> check(const Schema& schema, const nlohmann::json& document);

/// A value for use in a message: JSON in at most about 40 characters, on one line.
std::string short_text(const nlohmann::json& value);

/// `key` as a step of a JSON pointer, with its slash in front.
std::string pointer_step(const std::string& key);

}  // namespace irido::schemas
