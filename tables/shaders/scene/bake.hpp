#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tables/shaders/scene/scene_plan.hpp"

namespace irido::tables {

/// The folder and manifest of a bake.
struct BakePlace {
    std::string folder;
    std::string manifest = "manifest.json";  ///< file name in the folder
};

/// Manifest entries of tables by id: file, kind, axes, channels, dtype, error, bytes, checksum,
/// notes; `values` instead of a file for a single sample.
using TableEntries = std::map<std::string, nlohmann::json>;

/// The existing bake of a scene in a folder.
struct Baked {
    nlohmann::json manifest;         ///< null if missing or unreadable
    TableEntries tables;             ///< from the manifest; empty if it is not trusted
    std::vector<std::string> files;  ///< table files made by bakes of this scene
    std::string note;                ///< why the manifest is not trusted, or ""
};

/// Reads the manifest of a place. Throws OutputError if it belongs to another scene.
Baked baked_scene(const BakePlace& place, const schemas::Scene& scene);

/// The files of `baked` that are still in the folder but not in `entries`.
std::vector<std::string> stale_files(const BakePlace& place, const Baked& baked,
                                     const TableEntries& entries);

/// Decision on whether a bake keeps an existing table.
struct Keeping {
    nlohmann::json entry;  ///< the table's entry, null if it must be made
    std::string why;       ///< why it must be made, in words
};

/// Decides whether a table is kept: its file must be a regular one of the size in the manifest and
/// untouched since the manifest was written. Otherwise, and always with `verify`, the file is read
/// and must have this table's id, be intact and agree with the manifest.
/// scene   the scene
/// plan    its plan
/// table   one of the plan's tables
/// baked   the existing bake
/// place   its folder and manifest
/// verify  read the file in any case
Keeping keeping_of(const schemas::Scene& scene, const ScenePlan& plan, const SceneTable& table,
                   const Baked& baked, const BakePlace& place, bool verify);

/// The expected entry of a table yet to be made, with the size that meets the tolerance, `samples`,
/// estimated `seconds`, and the errors of estimated_level_errors(). Throws ToleranceError.
nlohmann::json planned_entry(const SceneTable& table);

/// Options of a bake.
struct BakeRequest {
    BakePlace place;
    bool force = false;   ///< remakes every table
    bool verify = false;  ///< reads the tables that are kept
    bool prune = false;   ///< removes tables made for this scene that no material needs
    unsigned threads = 0;
    /// Receives the fraction done, [0, 1], and the table being made: material and kind.
    std::function<void(double done, const std::string& text)> progress{};
};

/// Reasons why materials failed, by name.
using MaterialFaults = std::map<std::string, std::vector<schemas::SceneFault>>;

/// Faults that are known before any table is computed.
MaterialFaults faults_of(const ScenePlan& plan);

/// Adds the error from making a table to all materials that use it.
/// faults  the faults so far, extended by the call
/// scene   the scene
/// table   the table that failed
/// error   the error caught
void add_faults(MaterialFaults& faults, const schemas::Scene& scene, const SceneTable& table,
                const std::exception& error);

struct BakeResult {
    std::vector<std::string> made, kept, pruned;  ///< files, or KIND-ID for numbers
    MaterialFaults faults;
    std::vector<std::string> notes;
    bool manifest_written = false;
};

/// Makes the tables of a plan in a folder, which is created if needed, and then the manifest, which
/// lists the materials made and why others failed. Tables with unchanged inputs are kept. Anything
/// else in a table's place is replaced, including symbolic links. Throws OutputError for files that
/// cannot be written, a manifest of another scene, or a folder locked by another bake.
BakeResult bake(const schemas::Scene& scene, const ScenePlan& plan, const BakeRequest& request);

/// All omissions of a material: those of the plan and those implied by the tables' entries.
std::vector<Omission> omissions_of(const ScenePlan& plan, const MaterialPlan& material,
                                   const TableEntries& entries);

/// Angles that a material's tables cover: those of the scene or, if it gives none, possibly fewer.
schemas::ValueRange served_angles(const ScenePlan& plan, const MaterialPlan& material,
                                  const TableEntries& entries);

/// The manifest of a scene, without `stale` and `checksum`.
/// scene    the scene
/// plan     its plan
/// entries  entries of the tables made or kept
/// faults   why materials failed
nlohmann::json manifest_of(const schemas::Scene& scene, const ScenePlan& plan,
                           const TableEntries& entries, const MaterialFaults& faults);

}  // namespace irido::tables
