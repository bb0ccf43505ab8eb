#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/design/design_problem.hpp"
#include "schemas/documents/stack_document.hpp"

namespace irido::schemas {

/// A design task as plain values, with the data needed to write the resulting stack.
struct DesignTask {
    DesignProblem problem;
    std::string file;  ///< its name in messages
    std::string name;
    std::string method = "refine";
    bool has_method = false;  ///< whether the task gives a method
    std::uint64_t seed = 1;
    std::optional<double> time_s;
    std::optional<std::size_t> evaluations;
    bool has_merit = false;                       ///< whether the task gives a merit
    bool has_sigma = false;                       ///< whether any target states a sigma
    StackSource source;                           ///< the stack's document
    std::vector<std::vector<std::string>> paths;  ///< of each free value in the document
    std::vector<std::string> notes;
    /// Materials that needles choose from: indices into the stack's materials, and as written in
    /// the document.
    std::vector<std::size_t> materials;
    std::vector<nlohmann::json> material_documents;
    std::size_t max_layers = 20;
    double min_thickness_nm = 2;
    /// Index of each of problem.targets among the document's targets.
    std::vector<std::size_t> target_numbers;
};

/// Checks a document against design.schema.json and further rules, and reads its stack and the
/// files that it names. Throws InputError for the first problem.
/// file      its name in messages
/// folder    base of its relative paths
DesignTask read_design(const nlohmann::json& document, const std::string& file,
                       const std::string& folder);

/// The stack document with these values, one for each free value.
nlohmann::json designed_stack(const DesignTask& task, const std::vector<double>& values);

/// A layer of a modified stack of the task: one of the document's, or a new one.
struct OtherLayer {
    std::optional<std::size_t> origin;  ///< index among the document's layers
    std::size_t material = 0;           ///< otherwise index into the stack's materials
    double thickness_nm = 0;
};

/// The task with these layers in its stack (all but the fixed ones free) and with `problem`.
DesignTask with_layers(const DesignTask& task, const std::vector<OtherLayer>& layers,
                       DesignProblem problem);

/// The problems of a document, one line each.
std::vector<std::string> design_problems(const nlohmann::json& document, const std::string& file,
                                         const std::string& folder);

/// The text of design.schema.json.
const char* design_schema_text();

}  // namespace irido::schemas
