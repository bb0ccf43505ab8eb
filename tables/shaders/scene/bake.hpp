#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tables/shaders/scene/scene_plan.hpp"

namespace irido::tables {

/// Where a scene is baked.
struct BakePlace {
    std::string folder;
    std::string manifest = "manifest.json";  ///< its file's name in the folder
};

/// What the manifest says of a table: file, kind, axes, channels, dtype, error, bytes, checksum,
/// notes; `values` in place of a file where one sample is enough.
using TableEntries = std::map<std::string, nlohmann::json>;

/// What a folder has of a scene.
struct Baked {
    nlohmann::json manifest;         ///< null if there is none that can be read
    TableEntries tables;             ///< of the manifest, by id; none if it is not to be believed
    std::vector<std::string> files;  ///< of tables that bakes of this scene have made
    std::string note;                ///< why the manifest is not to be believed, or ""
};

/// Reads the manifest of a place. Throws OutputError if it is that of another scene.
Baked baked_scene(const BakePlace& place, const schemas::Scene& scene);

/// The files among those of `baked` that are still in the folder and are none of `entries`.
std::vector<std::string> stale_files(const BakePlace& place, const Baked& baked,
                                     const TableEntries& entries);

/// Whether a bake keeps a table as it is.
struct Keeping {
    nlohmann::json entry;  ///< the table's entry, null if it must be made
    std::string why;       ///< it must be made, in words
};

/// A table is kept if the manifest has it and its file is a regular one of the right size that has
/// not been touched since the manifest was written. All others, and every table with `verify`, are
/// read: they must be made for this table's id, whole, and what the manifest says.
Keeping keeping_of(const schemas::Scene& scene, const ScenePlan& plan, const SceneTable& table,
                   const Baked& baked, const BakePlace& place, bool verify);

/// A table's entry without its values' file, size found by the tolerance: for a plan. It has
/// `samples` and `seconds`, an estimate of what making it takes, and the errors of mip levels as
/// estimated_level_errors() has them. Throws ToleranceError.
nlohmann::json planned_entry(const SceneTable& table);

struct BakeRequest {
    BakePlace place;
    bool force = false;   ///< make every table again
    bool verify = false;  ///< read the tables that are kept
    bool prune = false;   ///< remove tables that this scene made and no material needs
    unsigned threads = 0;
    /// The part that is done, and what is being made: material and role.
    std::function<void(double done, const std::string& text)> progress{};
};

/// Materials that could not be, by name, and why.
using MaterialFaults = std::map<std::string, std::vector<schemas::SceneFault>>;

/// Those that are known before any table is computed.
MaterialFaults faults_of(const ScenePlan& plan);

/// Adds what came up while a table was made to all materials that use it.
void add_faults(MaterialFaults& faults, const schemas::Scene& scene, const SceneTable& table,
                const std::exception& error);

struct BakeResult {
    std::vector<std::string> made, kept, pruned;  ///< files, or KIND-ID for numbers
    MaterialFaults faults;
    std::vector<std::string> notes;
    bool manifest_written = false;
};

/// Makes the tables of a plan in a folder, which is made if it is not there, and then the manifest,
/// which has the materials that could be made and the reasons for the others. Tables whose inputs
/// are those of before are kept as they are. What stands in a table's place is replaced, symbolic
/// links, too. Two bakes of one folder at a time: the second throws OutputError. Throws OutputError
/// for what cannot be written, and for a manifest of another scene.
BakeResult bake(const schemas::Scene& scene, const ScenePlan& plan, const BakeRequest& request);

/// Everything that a material does without: by the plan, and what its tables' sizes came to, as far
/// as there are entries.
std::vector<Omission> omissions_of(const ScenePlan& plan, const MaterialPlan& material,
                                   const TableEntries& entries);

/// Angles that a material's tables serve: those of the scene, or fewer where it gives none.
schemas::ValueRange served_angles(const ScenePlan& plan, const MaterialPlan& material,
                                  const TableEntries& entries);

/// What a scene's manifest says, from its tables' entries, but for what is stale and the checksum.
nlohmann::json manifest_of(const schemas::Scene& scene, const ScenePlan& plan,
                           const TableEntries& entries, const MaterialFaults& faults);

}  // namespace irido::tables
