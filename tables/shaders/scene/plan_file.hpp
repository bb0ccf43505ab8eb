#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tables/shaders/scene/scene_plan.hpp"

namespace irido::tables {

/// What a plan's file says of a table, for those who read it and for use_plan(): id, kind, axes,
/// notes, and angles_deg if they are fewer than the scene's.
///   entry  of planned_entry(), or of a manifest
nlohmann::json planned_table(const SceneTable& table, const nlohmann::json& entry);

/// The text of a plan's file: the document with the version, the scene's name and a checksum.
std::string plan_text(const schemas::Scene& scene, nlohmann::json document);

/// Lets the tables of a plan have the sizes that a file of plan_text() has for the same ids: a bake
/// then makes the same bytes without looking for them. Tables that the file does not have are left
/// as they are.
///   path  "-" is standard input
/// Throws InputError if that is no such file, if it was edited, and for a plan of another scene or
/// of a version of irido with other numbers.
void use_plan(ScenePlan& plan, const schemas::Scene& scene, const std::string& path);

/// The problems of a plan, one line each: violations of plan.schema.json, else a wrong checksum.
std::vector<std::string> plan_problems(const nlohmann::json& document, const std::string& file);

/// The text of plan.schema.json.
const char* plan_schema_text();

}  // namespace irido::tables
