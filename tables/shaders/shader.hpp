#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace irido::tables {

/// Names of the shader snippets: one for each kind of table, and those that need no table.
std::vector<std::string_view> shader_names();

/// Names of the languages: glsl (ES 3.00 and later), hlsl (shader model 4 and later) and wgsl.
std::vector<std::string_view> shader_languages();

/// A snippet with its dependencies, as a file to include. Both names must be known.
std::string shader_source(std::string_view name, std::string_view language);

}  // namespace irido::tables
