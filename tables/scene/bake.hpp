#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tables/scene/scene_plan.hpp"

namespace irido {

/// What the manifest says of a table: file, kind, axes, channels, dtype, error, bytes, checksum,
/// notes; `values` in place of a file where one sample is enough.
using TableEntries = std::map<std::string, nlohmann::json>;

/// The tables of the manifest in a folder, by their id; none if there is no manifest that can be
/// read.
TableEntries baked_tables(const std::string& folder);

/// True if the folder still has what the entry says: files of its size that are not newer than the
/// manifest are believed; newer ones, and all with `verify`, are read, and must have its checksum.
bool is_kept(const SceneTable& table, const nlohmann::json& entry, const std::string& folder,
             bool verify);

/// A table's entry without its values' file, size found by the tolerance: for a plan.
/// Throws LutToleranceError.
nlohmann::json planned_entry(const SceneTable& table);

struct BakeRequest {
    std::string folder;
    bool force = false;   ///< make every table again
    bool verify = false;  ///< read the tables that are kept
    bool prune = false;   ///< remove tables that no material needs
    unsigned threads = 0;
    std::function<void(double done)> progress;
};

struct BakeResult {
    std::vector<std::string> made, kept, pruned;  ///< files, or KIND-ID for numbers
    std::map<std::string, std::string> faults;    ///< of materials that could not be
    bool manifest_written = false;
};

/// Makes the tables of a plan in a folder, which is made if it is not there, and then the manifest
/// if all went well. Tables whose inputs are those of before are kept as they are. Two bakes of one
/// folder at a time: the second throws OutputError. Throws OutputError for what cannot be written.
BakeResult bake(const Scene& scene, const ScenePlan& plan, const BakeRequest& request);

/// Everything that a material does without: by the plan, and what its tables' sizes came to, as far
/// as there are entries.
std::vector<Omission> omissions_of(const ScenePlan& plan, const MaterialPlan& material,
                                   const TableEntries& entries);

/// What a scene's manifest says, from its tables' entries.
nlohmann::json manifest_of(const Scene& scene, const ScenePlan& plan, const TableEntries& entries);

/// The broken rules of manifest.schema.json, one line each.
std::vector<std::string> manifest_problems(const nlohmann::json& document, const std::string& file);

/// The text of manifest.schema.json.
const char* manifest_schema_text();

}  // namespace irido
