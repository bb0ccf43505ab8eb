#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/stack/stack.hpp"

namespace irido::schemas {

/// A stack as a document that depends only on its physics: no names or paths; equal materials are
/// written identically (library materials by name, a constant n as a number, file data as numbers);
/// groups with repeat 1 are dissolved. It is a valid stack document except for materials that stack
/// documents cannot express: those have `n` and `k` as functions, {"formula": NUMBER,
/// "coefficients": [...], "range_nm": [...]} (refractiveindex.info's formulas) or {"table": [[nm,
/// value], ...]}.
nlohmann::json canonical_stack(const Stack& stack);

}  // namespace irido::schemas
