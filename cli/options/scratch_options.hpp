#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/options/command.hpp"
#include "core/scratch/scratched_scattering.hpp"

namespace irido::cli {

/// Options of scratched surfaces, as given on the command line; "" if not given.
struct ScratchOptions {
    std::string at, footprint, footprint_shape, area_light, light_integral, energy;
    bool coherent = false, ensemble = false;

    /// The first option that was given, "" if none was.
    std::string typed() const;
};

/// Adds --at, --footprint, --footprint-shape, --coherent, --ensemble, --area-light,
/// --light-integral and --energy.
void add_scratch_options(CLI::App& command, ScratchOptions& options);

// Parsers of option values; each throws UsageError.
SurfacePoint parse_at(const ScratchOptions& options);
std::optional<Footprint> parse_footprint(const ScratchOptions& options);
ScratchSum parse_scratch_sum(const ScratchOptions& options);
LightIntegral parse_light_integral(const ScratchOptions& options);

}  // namespace irido::cli
