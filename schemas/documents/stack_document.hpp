#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/stack/stack.hpp"
#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// What the user typed to name a stack.
struct StackRequest {
    std::string stack;             ///< a file, "-" for standard input, or an expression (has a '|')
    std::vector<std::string> set;  ///< PATH=VALUE, applied in this order
    std::vector<std::string> media = {};  ///< NAME=MATERIAL, added to the document's materials
};

/// A stack document as it was read, not yet checked.
struct StackSource {
    nlohmann::json document;
    std::string file;    ///< its name in messages
    std::string folder;  ///< paths of material files start here
};

/// A stack document as plain values. Equal materials are one, whatever they are called.
struct StackDocument {
    Stack stack;
    std::string file;                            ///< its name in messages
    std::string name;                            ///< "" if the document has none
    std::vector<std::string> notes;              ///< what the readers of material files say
    std::vector<std::string> material_pointers;  ///< of the first use of stack.materials[i]
};

/// Reads the text that a request names and sets its values. Throws InputError.
StackSource load_stack(const StackRequest& request);

/// Checks a document against stack.schema.json and what a schema cannot say, and builds its stack.
/// Throws InputError for the first thing that is wrong.
StackDocument read_stack(const nlohmann::json& document, const std::string& file,
                         const std::string& folder);

/// The same; material files that `files` has read are not read again.
StackDocument read_stack(const nlohmann::json& document, const std::string& file,
                         const std::string& folder, MaterialFiles& files);

/// The reading of a request and of its document.
StackDocument read_stack(const StackRequest& request);

/// Material files of a document that lies in one folder, as seen from another one.
void move_files(nlohmann::json& document, const std::string& from, const std::string& to);

/// Everything that is wrong with a stack document, one line each, "FILE: POINTER: message"; nothing
/// if it can be used.
std::vector<std::string> stack_problems(const nlohmann::json& document, const std::string& file,
                                        const std::string& folder);

/// The same of a file ("-" for standard input). Throws InputError if it cannot be read.
std::vector<std::string> validate_stack_file(const std::string& path);

/// What to say of an incident medium whose k is not 0, but small.
std::string incident_note(double k);

/// The text of stack.schema.json.
const char* stack_schema_text();

}  // namespace irido::schemas
