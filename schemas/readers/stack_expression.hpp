#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/stack/stack.hpp"

namespace irido::schemas {

/// "air | (TiO2@58.5 | SiO2@94.2)^10 | BK7@1mm! | air" as the document that a file would hold:
/// media from the incident side to the substrate, thickness after @ in nm or in the unit that
/// follows it,
/// "!" for a layer that is not coherent; groups nest up to 30 deep.
///     stack  = medium "|" { item "|" } medium
///     item   = medium "@" number [ "nm" | "um" | "mm" | "Q" ] [ "!" ]
///            | "(" item { "|" item } ")" [ "^" repeat ]
///     medium = name  |  real  |  real +- imaginary "i"  |  imaginary "i"     ("j" is "i")
/// A name is that of a material or a material file, in double quotes where it has one of |@()^!.
/// Throws InputError("EXPRESSION" in quotes, "column N", what was expected and found).
nlohmann::json parse_stack_expression(std::string_view text);

/// The material that "1.5", "1.9+1.5i", "1.9+1.5j" or "2i" stands for; null for any other text.
nlohmann::json parse_index(std::string_view text);

/// A medium of a stack in text: the name where it leads back to the same material, else the index
/// at 550 nm. What that loses is added to `losses`.
std::string medium_text(const Material& material, std::vector<std::string>& losses);

/// A stack as an expression, and what it cannot hold, one entry each.
struct StackExpression {
    std::string text;
    std::vector<std::string> losses;
};

/// The expression of a stack: names of built-in materials and of material files, of all others the
/// index at 550 nm. thickness_sigma_nm is left out.
StackExpression stack_expression(const Stack& stack);

}  // namespace irido::schemas
