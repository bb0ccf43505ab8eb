#pragma once

#include <string>
#include <vector>

#include "cli/queries/comparison_query.hpp"
#include "core/comparison/engine_fit.hpp"

namespace irido::cli {

/// A fit and the engine that it belongs to.
struct NamedFit {
    std::string engine;
    EngineFit fit;
};

/// --weights: as many as there are angles, or "" for equal ones. Throws UsageError.
std::vector<double> parse_weights(const std::string& text, std::size_t angles);

/// Fits the query's engines to the exact colours of a prepared stack at the query's angles; says
/// which engines have no match. Throws UsageError for engines without parameters.
std::vector<NamedFit> fits_of(const ComparisonQuery& query, const PreparedStack& prepared,
                              const std::vector<double>& weights, unsigned threads,
                              const std::function<void(const std::string&)>& say);

/// engine, parameter, value; the last two of an engine are delta_e_mean and delta_e_max.
tables::Records fit_rows(const std::vector<NamedFit>& fits);

/// Whether a format is one of material_text(): gltf, mtlx, py.
bool is_material_format(const std::string& format);

/// Throws UsageError unless such a format suits an engine: gltf those of gltf, three and babylon,
/// mtlx those of materialx, materialx-gltf and openpbr, py those of cycles and cycles-principled.
void check_material_format(const std::string& format, const std::string& engine);

/// A material with the fitted parameters: a glTF file, a MaterialX document or a script for
/// Blender.
std::string material_text(const std::string& format, const NamedFit& fit, const std::string& name);

}  // namespace irido::cli
