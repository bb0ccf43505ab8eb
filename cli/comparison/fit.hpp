#pragma once

#include <string>
#include <vector>

#include "cli/queries/comparison_query.hpp"
#include "core/comparison/engine_fit.hpp"

namespace irido::cli {

/// A fit and its engine.
struct NamedFit {
    std::string engine;
    EngineFit fit;
};

/// Parses --weights: one per angle, or "" for equal weights. Throws UsageError.
std::vector<double> parse_weights(const std::string& text, std::size_t angles);

/// Fits the query's engines to the exact colours of a prepared stack at the query's angles, and
/// reports engines that have no match. Throws UsageError for engines without parameters.
/// query     the engines and angles
/// prepared  the stack
/// weights   one per angle
/// threads   number of threads
/// say       receives the text of a note
std::vector<NamedFit> fits_of(const ComparisonQuery& query, const PreparedStack& prepared,
                              const std::vector<double>& weights, unsigned threads,
                              const std::function<void(const std::string&)>& say);

/// Columns engine, parameter, value; each engine's last two rows are delta_e_mean and delta_e_max.
tables::Records fit_rows(const std::vector<NamedFit>& fits);

/// Whether material_text() supports a format: gltf, mtlx, py.
bool is_material_format(const std::string& format);

/// Throws UsageError unless the format suits the engine: gltf is for gltf, three and babylon, mtlx
/// for materialx, materialx-gltf and openpbr, py for cycles and cycles-principled.
void check_material_format(const std::string& format, const std::string& engine);

/// A material with the fitted parameters: a glTF file, a MaterialX document or a Blender script.
std::string material_text(const std::string& format, const NamedFit& fit, const std::string& name);

}  // namespace irido::cli
