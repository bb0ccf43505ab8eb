#pragma once

#include <string_view>

#include "cli/options/command.hpp"
#include "cli/queries/surface_query.hpp"

namespace irido::cli {

inline constexpr std::string_view kLutBrdfSummary =
    "BRDF of a rough layered surface, as a table or as a file that renderers read.";
inline constexpr std::string_view kLutBrdfAxes = "phi_d_deg, theta_h_deg, theta_d_deg";
inline constexpr std::string_view kLutLayeredSummary =
    "All that a shader needs of a rough layered surface: colours, and straight light at nodes.";

/// irido lut brdf and irido lut layered, whose tables are of surfaces.
void add_lut_brdf(CLI::App& lut, Run& run);
void add_lut_layered(CLI::App& lut, Run& run);

}  // namespace irido::cli
