#pragma once

#include "schemas/documents/design_document.hpp"

namespace irido::schemas {

/// Reads the free values of a task; internal to design documents. Fills problem.free, paths and,
/// where a value needs it, problem.rebuild, and gives each layer its own copy of a material whose
/// numbers are free in it. Throws InputError.
/// free  the document's array
void read_free(const nlohmann::json& free, DesignTask& task);

/// Reads the targets of a task. Throws InputError.
void read_targets(const nlohmann::json& targets, const std::string& folder, DesignTask& task);

}  // namespace irido::schemas
