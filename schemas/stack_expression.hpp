#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "core/stack/stack.hpp"

namespace irido {

/// "air | (TiO2@58.5 | SiO2@94.2)^10 | BK7" as the document that a file would hold: media from the
/// incident side to the substrate, thickness in nm after @, groups nest up to 30 deep.
///     stack  = medium "|" { item "|" } medium
///     item   = medium "@" nm  |  "(" item { "|" item } ")" [ "^" repeat ]
///     medium = name  |  real  |  real +- imaginary "i"  |  imaginary "i"
/// Throws InputError("EXPRESSION" in quotes, "column N", what was expected and found).
nlohmann::json parse_stack_expression(std::string_view text);

/// The material that "1.5", "1.9+1.5i" or "2i" stands for; null for any other text.
nlohmann::json parse_index(std::string_view text);

/// The expression of a stack: names of materials that have one, else their index at 550 nm. What an
/// expression cannot say (spread and incoherent layers) is left out.
std::string stack_expression(const Stack& stack);

}  // namespace irido
