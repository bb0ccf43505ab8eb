#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tables/lut/lut.hpp"

namespace irido::tables {

/// What stands after a file's name in that of its companion.
inline constexpr const char* kCompanion = ".json";

/// Whether there is a file of that name that is no symbolic link.
bool is_regular(const std::string& path);

/// Bytes of a table's file and of its companion, 0 if they are not both regular files.
std::size_t size_of_table(const std::string& path);

/// Whether a file may be a table of a bake: KIND-ID.FORMAT or its companion.
bool is_table_file(const std::string& name);

/// Whether a table has one sample, which stands in the manifest.
bool is_one_sample(const Lut& lut);

/// What a manifest says of a table, but for its file.
nlohmann::json entry_of(const Lut& lut, const nlohmann::json& metadata);

/// The entry of a table in a file of the folder. Throws LutError or InputError, in words what is
/// wrong with it, if it is not a whole one that was made for this id.
nlohmann::json found_entry(const std::string& folder, const std::string& file,
                           const std::string& id);

/// Of all that a manifest says but its checksum.
std::string checksum_of(nlohmann::json manifest);

/// The manifest in a file; null if it is none.
nlohmann::json read_manifest(const std::string& path);

/// Files that a manifest has, and those that are stale.
std::vector<std::string> files_of(const nlohmann::json& manifest);

/// What is wrong with a manifest, one line each: broken rules of manifest.schema.json; else a
/// checksum that is not its own and tables that are not there; in a `folder` that is not empty,
/// files that are not what the manifest says.
std::vector<std::string> manifest_problems(const nlohmann::json& document, const std::string& file,
                                           const std::string& folder = "");

/// The text of manifest.schema.json.
const char* manifest_schema_text();

}  // namespace irido::tables
