#include "cli/bench/bench.hpp"

namespace irido::cli {

void add_bench_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "bench", "Benchmarks: speed, accuracy and stability on this machine.");
    command->require_subcommand(1);
    add_bench_design(*command, run);
    add_bench_layered(*command, run);
    add_bench_pareto(*command, run);
    add_bench_render(*command, run);
    add_bench_scene(*command, run);
    add_bench_scratch(*command, run);
    add_bench_speed(*command, run);
    add_bench_stability(*command, run);
    set_examples(*command, {"irido bench pareto -o pareto.csv --plot pareto.svg",
                            "irido bench design --cases ar8", "irido bench scene --count 100",
                            "irido bench speed --cases film,40", "irido bench scratch",
                            "irido bench stability --count 10"});
}

}  // namespace irido::cli
