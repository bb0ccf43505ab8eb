#pragma once

#include <string>

#include "schemas/documents/stack_document.hpp"

namespace irido::cli {

/// Throws InputError if the source is a surface or a scene document, which cannot be `done`
/// ("drawn") yet, rather than a stack.
void refuse_other_documents(const schemas::StackSource& source, const std::string& done);

}  // namespace irido::cli
