#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/shard.hpp"
#include "cli/queries/surface_colors.hpp"
#include "cli/queries/surface_query.hpp"
#include "core/rough/walk/simulation.hpp"

namespace irido::cli {

/// A simulation as it was asked for.
struct SimulationPlan {
    SimulationRequest request;        ///< the samples of the whole
    std::optional<double> tolerance;  ///< instead of samples
    std::optional<Shard> shard;       ///< the part to compute
    std::vector<std::string> merge;   ///< files of parts, instead of a simulation
    nlohmann::json facts;             ///< what parts have in common, if there are some
};

bool is_simulated(const SurfaceQuery& query);

/// Throws UsageError.
SimulationPlan parse_simulation(const LayeredSurface& surface, const SurfaceQuery& query,
                                Crossings crossings);

/// Throws UsageError if options of simulations were typed for none.
void require_no_simulation(const SurfaceQuery& query);

/// Where a shard belongs.
struct ShardFacts {
    std::uint64_t first = 0, all_samples = 0;
    double request = 0;  ///< a whole number, the same for all shards of a request
};

/// Means and standard errors of a simulation, of all its samples or one shard, or of merged files.
struct SimulatedValues {
    LayeredSimulation::Values values;
    std::optional<ShardFacts> shard;
};

/// Runs `once` for the simulation's paths. With a tolerance as often as it takes until every
/// standard error is at most that part of max(floor, |value|); throws ToleranceError where more
/// than 1e9 samples would be needed. Merged files must be of this request, and their samples those
/// of the whole, each once; else throws InputError.
///   keys   the rows' key columns
///   names  the columns of values, in their order in a row: one, or X, Y and Z
SimulatedValues simulate(const schemas::SurfaceDocument& document, const SimulationPlan& plan,
                         LayeredSimulation& simulation,
                         const std::function<LayeredSimulation::Values()>& once,
                         const NumberColumns& keys, const std::vector<std::string>& names,
                         double floor);

/// Appends stderr, the largest of each row's values, and what a shard needs to be merged.
///   names  the columns of values
void add_simulated_columns(const SimulatedValues& simulated, const std::vector<std::string>& names,
                           SurfaceRows& rows);

/// Appends what tells whether the files of shards belong together: the light and the space of
/// colours, the build, the SIMD level, and a digest of all cells.
void add_shard_marks(const SurfaceQuery& query, SurfaceRows& rows);

/// The rows of the whole from the files of all of its shards alone, `query.merge`; colours in the
/// light and space of the shards, which options of the query must not contradict. Throws
/// InputError.
SurfaceRows rows_of_shards(const SurfaceQuery& query);

}  // namespace irido::cli
