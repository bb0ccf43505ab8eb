#pragma once

#include <string>

#include "cli/queries/comparison_query.hpp"

namespace irido::cli {

/// Engines that take glTF's inputs.
inline constexpr const char* kAssetEngines = "gltf,three,babylon,materialx-gltf";

/// Engines against exact colours of every iridescent material of a .gltf or .glb file: columns
/// material, thickness_nm (both ends where there is a texture), then those of EngineRows. A gray
/// base is the real index that has its F0; colours of others are not known exactly. Throws
/// InputError, also where no material is iridescent, and UsageError for engines that take no F0.
tables::Records asset_rows(const std::string& file, const ComparisonQueryOptions& typed,
                           const Execution& execution,
                           const std::function<void(const std::string&)>& say);

}  // namespace irido::cli
