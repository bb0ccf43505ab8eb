#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/scratch/scratched_surface.hpp"
#include "schemas/input_error.hpp"

namespace irido::schemas {

/// Whether a surface document has scratches.
bool is_scratched(const nlohmann::json& document);

/// Builds the scratched surface of a document that surface.schema.json accepts, and collects what
/// else is wrong with it.
/// notes  of the readers of the base, and doubts about scratches that the model does not suit
ScratchedSurface read_scratched(const nlohmann::json& document, const std::string& file,
                                const std::string& folder, std::vector<InputError>& problems,
                                std::vector<std::string>& notes);

}  // namespace irido::schemas
