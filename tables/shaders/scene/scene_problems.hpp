#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/math/simd_level.hpp"
#include "core/stack/stack.hpp"

namespace irido::tables {

/// What a stack lacks for the mirror of the snippet bragg, in words; "" if nothing.
std::string mirror_fault(const Stack& stack);

/// All problems of a scene that are known before its tables are computed, one line each:
/// "FILE: POINTER: material NAME: reason".
/// document   the scene
/// file       its name in messages
/// folder     where its relative paths start
/// execution  threads and SIMD level
std::vector<std::string> problems_of_scene(const nlohmann::json& document, const std::string& file,
                                           const std::string& folder, const Execution& execution);

}  // namespace irido::tables
