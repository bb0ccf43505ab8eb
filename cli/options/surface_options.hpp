#pragma once

#include <string>
#include <vector>

#include "cli/options/command.hpp"
#include "schemas/documents/surface_document.hpp"

namespace irido::cli {

/// The surface, as typed.
struct SurfaceOptions {
    schemas::StackRequest source;
    std::string alpha;  ///< "" if not typed
};

/// SURFACE, --alpha, --set and --material.
void add_surface_options(CLI::App& command, SurfaceOptions& options);

/// --paths and --transmission of tables of layered surfaces.
void add_table_paths_options(CLI::App& command, std::string& paths, std::string& transmission);

/// Reads the surface and says what is to be noted. Throws InputError and UsageError.
schemas::SurfaceDocument read_noted_surface(const SurfaceOptions& options, bool quiet);

/// What a surface is called in a picture: its name, or what was typed.
std::string title_of(const schemas::SurfaceDocument& document, const SurfaceOptions& options);

/// Directions of light and view, as typed.
struct DirectionOptions {
    std::string light_theta = "0", light_phi = "0", view_theta = "0", view_phi = "180";
    std::string file;  ///< "" if not typed
};

/// Where the light comes from and where it is seen: directions that point away from the surface.
struct Directions {
    double light_theta_deg = 0, light_phi_deg = 0;  ///< theta in [0, 90]
    double view_theta_deg = 0, view_phi_deg = 180;

    /// The azimuth between them, folded into [0, 180].
    double azimuth_deg() const;
};

/// --light-theta, --light-phi, --view-theta, --view-phi and --directions
void add_direction_options(CLI::App& command, DirectionOptions& options);

/// Every combination, view_phi fastest, or the rows of the file. Throws UsageError and InputError,
/// among others for more than 1e7 of them.
std::vector<Directions> parse_directions(const DirectionOptions& options);

/// The light's polar angles alone. Throws UsageError if a file of directions was typed.
std::vector<double> parse_light_thetas(const DirectionOptions& options);

}  // namespace irido::cli
