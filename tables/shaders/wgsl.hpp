#pragma once

#include <string>
#include <string_view>

namespace irido::tables {

/// WGSL of code whose types and functions are WGSL's already and whose declarations are those of
/// C: `f32 f(f32 x)` becomes `fn f(x: f32) -> f32`, `f32 a = 1, b[3];` becomes `var a: f32 = 1;`
/// and `var b: array<f32, 3>;`. Lines of the preprocessor are left out. Functions begin at the
/// start of a line, bodies of conditions and loops are in braces, and parameters do not change.
std::string wgsl_declarations(std::string_view code);

}  // namespace irido::tables
