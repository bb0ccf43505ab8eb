#pragma once

#include <string>
#include <vector>

#include "cli/options/color_options.hpp"
#include "cli/options/command.hpp"
#include "core/colorimetry/sensitivity.hpp"
#include "core/comparison/compared_engine.hpp"

namespace irido::cli {

/// Options common to all comparisons of engines, as given on the command line.
struct ComparisonOptions {
    std::string engines = "all";
    ColorOptions color;  ///< only illuminant and observer are used
    std::string white = "own";
    bool as_cie_rgb = false;
    bool strict = false;
};

void add_comparison_options(CLI::App& command, ComparisonOptions& options);

/// The names of all engines, with equal/16 as an example of equal/N.
std::vector<std::string> engine_names();

/// The names of all engines that are formulas, separated by commas.
std::string formula_names();

/// Parses --engine: names separated by commas, or all. Throws UsageError.
std::vector<ComparedEngine> parse_engines(const std::string& text);

/// Evaluates --illuminant and --observer. Throws UsageError or InputError.
Sensitivity parse_sensitivity(const ComparisonOptions& options);

/// Evaluates --white and --as-cie-rgb for the illuminant's white. Throws UsageError.
EngineDifference parse_difference(const ComparisonOptions& options, const Triple& white);

/// "r 1.2, g 1.3, b 1.4", or a single number if all are equal.
std::string channels_text(const Triple& values);

}  // namespace irido::cli
