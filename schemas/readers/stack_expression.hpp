#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/stack/stack.hpp"

namespace irido::schemas {

/// Parses "air | (TiO2@58.5 | SiO2@94.2)^10 | BK7@1mm! | air" into the equivalent stack document:
/// media from the incident side to the substrate, thickness after @ in nm or in the unit that
/// follows it, "!" for an incoherent layer; groups nest up to 30 deep.
///     stack  = medium "|" { item "|" } medium
///     item   = medium "@" number [ "nm" | "um" | "mm" | "Q" ] [ "!" ]
///            | "(" item { "|" item } ")" [ "^" repeat ]
///     medium = name  |  real  |  real +- imaginary "i"  |  imaginary "i"     ("j" is "i")
/// A name is that of a material or a material file, in double quotes if it contains any of |@()^!.
/// Throws InputError("EXPRESSION" in quotes, "column N", expected and found tokens).
nlohmann::json parse_stack_expression(std::string_view text);

/// An expression with other values, as of a title; throws as parse_stack_expression() does.
/// text    the expression
/// values  a dotted path of its document and the text to be written in the place of what is typed
///         there; paths without a place are ignored, and of a path to a part, or to more than one
///         value, an ellipsis is written
std::string expression_with(std::string_view text,
                            const std::vector<std::pair<std::string, std::string>>& values);

/// The material denoted by "1.5", "1.9+1.5i", "1.9+1.5j" or "2i"; null for any other text.
nlohmann::json parse_index(std::string_view text);

/// A medium of a stack as text: its name if reading that name gives the same material, otherwise
/// its index at 550 nm. Adds what is lost to `losses`.
std::string medium_text(const Material& material, std::vector<std::string>& losses);

/// A stack as an expression, and a list of what could not be expressed.
struct StackExpression {
    std::string text;
    std::vector<std::string> losses;
};

/// The expression of a stack: built-in materials and material files by name, all others by their
/// index at 550 nm. thickness_sigma_nm is omitted.
StackExpression stack_expression(const Stack& stack);

}  // namespace irido::schemas
