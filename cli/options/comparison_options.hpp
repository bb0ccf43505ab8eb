#pragma once

#include <string>
#include <vector>

#include "cli/options/color_options.hpp"
#include "cli/options/command.hpp"
#include "core/colorimetry/sensitivity.hpp"
#include "core/comparison/compared_engine.hpp"

namespace irido::cli {

/// Options that every comparison of engines has, as typed.
struct ComparisonOptions {
    std::string engines = "all";
    ColorOptions color;  ///< of which illuminant and observer count
    std::string white = "own";
    bool as_cie_rgb = false;
    bool strict = false;
};

void add_comparison_options(CLI::App& command, ComparisonOptions& options);

/// Every engine by its name, equal/16 standing for equal/N.
std::vector<std::string> engine_names();

/// The names of all that are formulas, with commas.
std::string formula_names();

/// --engine: names with commas, or all. Throws UsageError.
std::vector<ComparedEngine> parse_engines(const std::string& text);

/// --illuminant and --observer. Throws UsageError or InputError.
Sensitivity parse_sensitivity(const ComparisonOptions& options);

/// --white and --as-cie-rgb, under the illuminant's white. Throws UsageError.
EngineDifference parse_difference(const ComparisonOptions& options, const Triple& white);

/// "r 1.2, g 1.3, b 1.4", or the number if all are the same.
std::string channels_text(const Triple& values);

}  // namespace irido::cli
