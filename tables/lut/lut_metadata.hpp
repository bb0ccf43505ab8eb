#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "tables/lut/lut_format.hpp"

namespace irido::tables {

/// The text of schemas/lut.schema.json.
const char* lut_schema_text();

/// An axis as metadata: name, unit, first, last, count, mapping, and the values of a list.
nlohmann::json axis_metadata(const LutAxis& axis);

/// Metadata as text: one line, keys sorted. Throws LutError if it violates lut.schema.json.
std::string metadata_text(const nlohmann::json& metadata);

/// The companion FILE.json: the metadata and a line feed.
LutFile companion_of(const Lut& lut);

/// A table without values from a companion's bytes. Throws LutError, also if they are missing.
Lut lut_from_companion(std::string_view bytes);

/// Throws LutError for a layout that only ktx2 supports.
void check_plain(const LutLayout& layout, std::string_view format);

}  // namespace irido::tables
