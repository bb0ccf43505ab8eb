#pragma once

#include <nlohmann/json_fwd.hpp>

namespace irido::schemas {

/// Whether a stack document contains only the most common keys (names, indices, thicknesses,
/// repeats) with values in the schema's ranges. Such a document is valid, and the schema, which
/// takes longer to compile than most results take to compute, need not be loaded.
bool is_plain_stack(const nlohmann::json& document);

}  // namespace irido::schemas
