#pragma once

#include <string>

#include "schemas/documents/stack_document.hpp"

namespace irido::cli {

/// Throws InputError if the source is not a stack but a surface or scene document, which cannot be
/// `done` ("drawn") yet.
void refuse_other_documents(const schemas::StackSource& source, const std::string& done);

}  // namespace irido::cli
