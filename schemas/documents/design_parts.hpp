#pragma once

#include "schemas/documents/design_document.hpp"

namespace irido::schemas {

/// The free values of a task. Internal to design documents.
/// free  the document's array
/// Fills problem.free, paths and, where a value needs it, problem.rebuild; gives materials whose
/// numbers are free to the layers that they belong to. Throws InputError.
void read_free(const nlohmann::json& free, DesignTask& task);

/// The targets of a task. Throws InputError.
void read_targets(const nlohmann::json& targets, const std::string& folder, DesignTask& task);

}  // namespace irido::schemas
