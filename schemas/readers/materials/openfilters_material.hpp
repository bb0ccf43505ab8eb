#pragma once

#include <string>
#include <string_view>

#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// Whether a text is a material of OpenFilters: lines "Keyword: value", Kind and Model among them.
bool is_openfilters_material(std::string_view text);

/// Its material, of model constant, table, Cauchy or Sellmeier, where a negative imaginary part is
/// loss. Tables are linear between their rows here, monotone cubics there; Urbach tails become
/// tables. Mixtures are refused. Throws InputError with file `name` and "line:column".
MaterialFile read_openfilters_material(std::string_view text, const std::string& name);

}  // namespace irido::schemas
