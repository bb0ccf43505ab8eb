#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "schemas/documents/stack_document.hpp"

namespace irido::schemas {

/// A stack inside another document: inline, a file name or an expression. In messages an inline
/// stack is called by its JSON pointer, a file by its name in the document. Throws InputError whose
/// place is the pointer.
/// stack    a stack document, the path of one, or an expression
/// pointer  the stack's JSON pointer in the document
/// folder   base of the document's relative paths
StackSource inner_stack(const nlohmann::json& stack, const std::string& pointer,
                        const std::string& folder);

}  // namespace irido::schemas
