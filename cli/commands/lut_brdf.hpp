#pragma once

#include "cli/options/command.hpp"

namespace irido::cli {

/// irido lut brdf and irido lut layered, whose tables describe surfaces rather than stacks.
void add_lut_brdf(CLI::App& lut, Run& run);
void add_lut_layered(CLI::App& lut, Run& run);

}  // namespace irido::cli
