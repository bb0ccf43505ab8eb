#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/stack/stack.hpp"

namespace irido::schemas {

/// A stack as a document that depends on its physics alone: without names and paths, equal
/// materials written alike (a library's material by its name, a constant n as a number, data of
/// files as numbers), groups of repeat 1 dissolved. It is a stack document again, but for
/// materials that no stack document can say: those have `n` and `k` as functions,
/// {"formula": NUMBER, "coefficients": [...], "range_nm": [...]} (refractiveindex.info's formulas)
/// or {"table": [[nm, value], ...]}.
nlohmann::json canonical_stack(const Stack& stack);

}  // namespace irido::schemas
