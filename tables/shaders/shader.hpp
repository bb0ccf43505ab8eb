#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace irido::tables {

/// Names of the shader snippets: one for each kind of table, and those that need no table.
std::vector<std::string_view> shader_names();

/// Names of the languages: glsl (ES 3.00 and later), hlsl (shader model 4 and later) and wgsl.
std::vector<std::string_view> shader_languages();

/// The snippets available in a language; only some are available in wgsl.
std::vector<std::string_view> shader_names_in(std::string_view language);

/// A snippet with its dependencies, as a file to include. Both names must be known, and the snippet
/// must be available in that language.
std::string shader_source(std::string_view name, std::string_view language);

}  // namespace irido::tables
