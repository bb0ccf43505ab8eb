#pragma once

#include <string>
#include <string_view>

#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

/// Whether a text is an OpenFilters material: lines "Keyword: value", including Kind and Model.
bool is_openfilters_material(std::string_view text);

/// Reads a material with model constant, table, Cauchy or Sellmeier; a negative imaginary part
/// means loss. Tables are interpolated linearly here, by monotone cubics in OpenFilters; Urbach
/// tails become tables. Mixtures are refused. Throws InputError with file `name` and "line:column".
MaterialFile read_openfilters_material(std::string_view text, const std::string& name);

}  // namespace irido::schemas
