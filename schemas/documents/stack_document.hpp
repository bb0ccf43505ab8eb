#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/stack/stack.hpp"
#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// The options that select a stack, as given on the command line.
struct StackRequest {
    std::string stack;             ///< a file, "-" for standard input, or an expression (has a '|')
    std::vector<std::string> set;  ///< PATH=VALUE, applied in this order
    std::vector<std::string> media = {};  ///< NAME=MATERIAL, added to the document's materials
    std::string reference_nm = {};        ///< for quarter waves, "" for the document's
    bool reverse = false;                 ///< light comes from the substrate
};

/// A stack document as read, not yet checked.
struct StackSource {
    nlohmann::json document;
    std::string file;      ///< its name in messages
    std::string folder;    ///< base of the paths of material files
    bool reverse = false;  ///< apply reversed() to the stack after reading; paths refer to the
                           ///< unreversed document
};

/// A stack document as plain values. Equal materials are merged, whatever their names.
struct StackDocument {
    Stack stack;
    std::string file;                            ///< its name in messages
    std::string name;                            ///< "" if the document has none
    std::vector<std::string> notes;              ///< notes from reading material files
    std::vector<std::string> material_pointers;  ///< where stack.materials[i] is first used
};

/// Reads the file or expression of a request and sets its values. Throws InputError.
StackSource load_stack(const StackRequest& request);

/// Adds the request's media to a source and sets its values. Throws InputError.
void set_values(StackSource& source, const StackRequest& request);

/// Checks a document against stack.schema.json and further rules, and builds its stack. Throws
/// InputError for the first problem.
/// document  the stack
/// file      its name in messages
/// folder    base of its relative paths
StackDocument read_stack(const nlohmann::json& document, const std::string& file,
                         const std::string& folder);

/// Reads a stack with a cache of material files. Throws InputError for the first problem.
/// document  the stack
/// file      its name in messages
/// folder    base of its relative paths
/// files     the cache: files in it are not read again
StackDocument read_stack(const nlohmann::json& document, const std::string& file,
                         const std::string& folder, MaterialFiles& files);

/// Reads the stack of a source, reversed if source.reverse is set. Throws InputError.
StackDocument read_source(const StackSource& source);

/// Reads `document` in place of the source's own, with a cache of material files. Throws
/// InputError.
StackDocument read_source(const StackSource& source, const nlohmann::json& document,
                          MaterialFiles& files);

/// Loads and reads the stack of a request. Throws InputError.
StackDocument read_stack(const StackRequest& request);

/// Rewrites relative paths of material files from one folder to another.
void move_files(nlohmann::json& document, const std::string& from, const std::string& to);

/// All problems of a stack document, one line each: "FILE: POINTER: message".
std::vector<std::string> stack_problems(const nlohmann::json& document, const std::string& file,
                                        const std::string& folder);

/// All problems of a stack file ("-" for standard input), one line each. Throws InputError if it
/// cannot be read.
std::vector<std::string> validate_stack_file(const std::string& path);

/// The note about an incident medium with a small k.
std::string incident_note(double k);

/// The text of stack.schema.json.
const char* stack_schema_text();

}  // namespace irido::schemas
