#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scratch/light.hpp"

namespace irido::schemas {

/// Reads area lights from JSON text, which begins with { or [, or from a file. Checks them against
/// light.schema.json and the rules of LightCone. Throws InputError.
std::vector<AreaLight> read_lights(const std::string& text_or_path);

/// The text of light.schema.json.
const char* light_schema_text();

}  // namespace irido::schemas
