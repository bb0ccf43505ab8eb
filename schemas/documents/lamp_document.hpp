#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/render/lamp.hpp"

namespace irido::schemas {

/// A lamp as it was read, and its illuminant's name or file; "" for that of the picture.
struct LampDocument {
    Lamp lamp;
    std::string illuminant;
    nlohmann::json document;
};

/// Lamps: JSON text, which begins with { or [, or the path of a file. Checked against
/// lamp.schema.json and to be lamps that Lamp takes. Throws InputError.
std::vector<LampDocument> read_lamps(const std::string& text_or_path);

/// The text of lamp.schema.json.
const char* lamp_schema_text();

}  // namespace irido::schemas
