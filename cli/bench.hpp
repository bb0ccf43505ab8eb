#pragma once

#include "cli/command.hpp"

namespace irido {

/// The subcommands of `irido bench`, each in a file of its own.
void add_bench_speed(CLI::App& bench, Run& run);
void add_bench_stability(CLI::App& bench, Run& run);

}  // namespace irido
