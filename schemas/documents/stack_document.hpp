#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/stack/stack.hpp"
#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// The options that select a stack, as typed.
struct StackRequest {
    std::string stack;             ///< a file, "-" for standard input, or an expression (has a '|')
    std::vector<std::string> set;  ///< PATH=VALUE, applied in this order
    std::vector<std::string> media = {};  ///< NAME=MATERIAL, added to the document's materials
    std::string reference_nm = {};        ///< wavelength of quarter waves, "" for the document's
    bool reverse = false;                 ///< light comes from the substrate
};

/// A stack document as it was read, not yet checked.
struct StackSource {
    nlohmann::json document;
    std::string file;      ///< its name in messages
    std::string folder;    ///< paths of material files start here
    bool reverse = false;  ///< its stack is reversed() once it is read; paths are those of the
                           ///< document
};

/// A stack document as plain values. Equal materials are one, whatever they are called.
struct StackDocument {
    Stack stack;
    std::string file;                            ///< its name in messages
    std::string name;                            ///< "" if the document has none
    std::vector<std::string> notes;              ///< notes of the readers of material files
    std::vector<std::string> material_pointers;  ///< of the first use of stack.materials[i]
};

/// Reads the text that a request names and sets its values. Throws InputError.
StackSource load_stack(const StackRequest& request);

/// Adds the request's media to a source and sets its values. Throws InputError.
void set_values(StackSource& source, const StackRequest& request);

/// Checks a document against stack.schema.json and rules beyond it, and builds its stack. Throws
/// InputError for the first problem.
/// document  the stack
/// file      its name in messages
/// folder    where its relative paths start
StackDocument read_stack(const nlohmann::json& document, const std::string& file,
                         const std::string& folder);

/// Reads a stack with a cache of material files. Throws InputError for the first problem.
/// document  the stack
/// file      its name in messages
/// folder    where its relative paths start
/// files     cache: files in it are not read again
StackDocument read_stack(const nlohmann::json& document, const std::string& file,
                         const std::string& folder, MaterialFiles& files);

/// Reads the stack of a source, reversed if it says so. Throws InputError.
StackDocument read_source(const StackSource& source);

/// The same with a cache of material files, of another document in its place.
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
