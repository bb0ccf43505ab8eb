#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/colorimetry/sensitivity.hpp"
#include "core/math/simd_level.hpp"
#include "core/stack/stack.hpp"

namespace irido::tables {

/// What a stack lacks for the mirror of the snippet bragg, in words; "" if nothing.
std::string mirror_fault(const Stack& stack);

/// Whether no light returns from the substrate of a stack, as it absorbs at kShaderIndices_nm.
bool is_opaque(const Stack& stack, const Sensitivity& sensitivity);

/// All problems of a scene that are known before its tables are computed, one line each:
/// "FILE: POINTER: material NAME: reason".
/// document   the scene
/// file       its name in messages
/// folder     where its relative paths start
/// execution  threads and SIMD level
std::vector<std::string> problems_of_scene(const nlohmann::json& document, const std::string& file,
                                           const std::string& folder, const Execution& execution);

}  // namespace irido::tables
