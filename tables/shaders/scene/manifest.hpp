#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "schemas/documents/scene_document.hpp"
#include "tables/lut/lut.hpp"

namespace irido::tables {

/// Suffix of a companion's file name.
inline constexpr const char* kCompanion = ".json";

/// Whether a path is a regular file and not a symbolic link.
bool is_regular(const std::string& path);

/// Size in bytes of a table's file and its companion; 0 unless both are regular files.
std::size_t size_of_table(const std::string& path);

/// Whether a file name is that of a baked table, KIND-ID.FORMAT, or of its companion.
bool is_table_file(const std::string& name);

/// Whether a table has a single sample, which is stored in the manifest.
bool is_one_sample(const Lut& lut);

/// The manifest entry of a table, without its file.
nlohmann::json entry_of(const Lut& lut, const nlohmann::json& metadata);

/// The entry of a grid of scratches of so many bytes, by the header in its companion.
nlohmann::json grid_entry(const nlohmann::json& header, const std::string& file, std::size_t bytes);

/// The entry of the table in a file of the folder. Throws LutError or InputError unless it is
/// intact and has this id.
nlohmann::json found_entry(const std::string& folder, const std::string& file,
                           const std::string& id);

/// The angles in the entry of a table that serves fewer than its scene asks for, [first, last] in
/// degrees, else null.
nlohmann::json served_angles_of(const nlohmann::json& entry);

/// The name of the scene's file in its manifest.
std::string source_of(const schemas::Scene& scene);

/// The checksum of a manifest or a plan, without its own key.
std::string checksum_of(nlohmann::json manifest);

/// The manifest in a file; null if the file is not a manifest.
nlohmann::json read_manifest(const std::string& path);

/// Files listed in a manifest, including stale ones.
std::vector<std::string> files_of(const nlohmann::json& manifest);

/// The problems of a manifest, one line each: violations of manifest.schema.json or, without any, a
/// wrong checksum and unknown tables; and, unless `folder` is "", files that differ from the
/// manifest.
std::vector<std::string> manifest_problems(const nlohmann::json& document, const std::string& file,
                                           const std::string& folder = "");

/// The text of manifest.schema.json.
const char* manifest_schema_text();

}  // namespace irido::tables
