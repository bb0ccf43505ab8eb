#pragma once

#include <string>

#include "cli/queries/comparison_query.hpp"

namespace irido::cli {

/// Engines whose inputs are those of glTF.
inline constexpr const char* kAssetEngines = "gltf,three,babylon,materialx-gltf";

/// Compares engines with exact colours for every iridescent material of a .gltf or .glb file:
/// columns material, thickness_nm (both ends if there is a texture), then those of EngineRows. A
/// grey base is the real index with its F0; other bases have no exact colour. Throws InputError,
/// also if no material is iridescent, and UsageError for engines that do not take F0.
/// file       the .gltf or .glb file
/// typed      options of the comparison
/// execution  threads and SIMD level
/// say        receives the text of a note
tables::Records asset_rows(const std::string& file, const ComparisonQueryOptions& typed,
                           const Execution& execution,
                           const std::function<void(const std::string&)>& say);

}  // namespace irido::cli
