#pragma once

#include <span>
#include <string>

#include "core/spectrum/cone.hpp"

namespace CLI {
class App;
}

namespace irido::cli {

/// --cone and --f-number, as given on the command line; "" if not given.
struct ConeOptions {
    std::string half_angle, f_number;
};

void add_cone_options(CLI::App& command, ConeOptions& options);

/// The cone, or none. Throws UsageError, also if it extends past 90 degrees about one of the
/// angles.
ConeSize parse_cone(const ConeOptions& options, std::span<const double> angles_deg);

}  // namespace irido::cli
