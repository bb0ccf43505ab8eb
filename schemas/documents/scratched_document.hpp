#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/scratch/scratched_surface.hpp"
#include "schemas/input_error.hpp"

namespace irido::schemas {

/// Whether a surface document has scratches.
bool is_scratched(const nlohmann::json& document);

/// Builds the scratched surface of a document that surface.schema.json accepts.
/// document  the surface
/// file      its name in messages
/// folder    base of its relative paths
/// problems  receives violations of further rules
/// notes     receives notes from reading the base, and warnings about scratches outside the model's
///           validity
ScratchedSurface read_scratched(const nlohmann::json& document, const std::string& file,
                                const std::string& folder, std::vector<InputError>& problems,
                                std::vector<std::string>& notes);

}  // namespace irido::schemas
