#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "schemas/documents/stack_document.hpp"

namespace irido::schemas {

/// A stack that another document holds, names or spells: an inline stack is called by its pointer,
/// a file as the document calls it. Throws InputError whose place is the pointer.
/// stack    a stack document, the path of one, or an expression
/// pointer  of it in the document
/// folder   where the document's relative paths start
StackSource inner_stack(const nlohmann::json& stack, const std::string& pointer,
                        const std::string& folder);

}  // namespace irido::schemas
