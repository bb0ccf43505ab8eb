#pragma once

#include <nlohmann/json_fwd.hpp>

namespace irido::schemas {

/// Whether a stack document holds nothing but what most do, within the ranges of its schema: names,
/// indices, thicknesses, repeats. The schema has no complaint about it then, and compiling the
/// schema takes longer than most answers.
bool is_plain_stack(const nlohmann::json& document);

}  // namespace irido::schemas
