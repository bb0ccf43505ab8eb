#pragma once

#include <string>
#include <vector>

#include "cli/options/command.hpp"
#include "schemas/documents/surface_document.hpp"

namespace irido::cli {

/// The surface, as given on the command line.
struct SurfaceOptions {
    schemas::StackRequest source;
    std::string alpha;         ///< "" if not given
    bool takes_stacks = true;  ///< with --alpha
};

/// Adds SURFACE, --alpha, --set and --material.
void add_surface_options(CLI::App& command, SurfaceOptions& options);

/// Adds --paths and --transmission for tables of layered surfaces.
void add_table_paths_options(CLI::App& command, std::string& paths, std::string& transmission);

/// Reads the surface and prints its notes. Throws InputError and UsageError.
schemas::SurfaceDocument read_noted_surface(const SurfaceOptions& options, bool quiet);

/// The title of a surface in a picture: its name, or the command-line argument.
std::string title_of(const schemas::SurfaceDocument& document, const SurfaceOptions& options);

/// Directions of light and view, as given on the command line.
struct DirectionOptions {
    std::string light_theta = "0", light_phi = "0", view_theta = "0", view_phi = "180";
    std::string file;  ///< "" if not given
};

/// Directions of light and view, both pointing away from the surface.
struct Directions {
    double light_theta_deg = 0, light_phi_deg = 0;  ///< theta in [0, 90]
    double view_theta_deg = 0, view_phi_deg = 180;

    /// The azimuth between light and view, folded into [0, 180].
    double azimuth_deg() const;
};

/// Adds --light-theta, --light-phi, --view-theta, --view-phi and --directions.
void add_direction_options(CLI::App& command, DirectionOptions& options);

/// All combinations, with view_phi varying fastest, or the rows of the file. Throws UsageError and
/// InputError, including for more than 1e7 directions.
std::vector<Directions> parse_directions(const DirectionOptions& options);

/// Only the light's polar angles. Throws UsageError if a file of directions was given.
std::vector<double> parse_light_thetas(const DirectionOptions& options);

}  // namespace irido::cli
