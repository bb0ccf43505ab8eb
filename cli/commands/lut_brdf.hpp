#pragma once

#include "cli/options/command.hpp"

namespace irido::cli {

/// irido lut brdf
void add_lut_brdf(CLI::App& lut, Run& run);

}  // namespace irido::cli
