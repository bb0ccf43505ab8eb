#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scratch/light.hpp"

namespace irido::schemas {

/// Area lights: JSON text, which begins with { or [, or the path of a file. Checked against
/// light.schema.json and to be lights that LightCone takes. Throws InputError.
std::vector<AreaLight> read_lights(const std::string& text_or_path);

/// The text of light.schema.json.
const char* light_schema_text();

}  // namespace irido::schemas
