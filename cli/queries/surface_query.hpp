#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/options/color_options.hpp"
#include "cli/options/scratch_options.hpp"
#include "cli/options/surface_options.hpp"
#include "core/rough/layered/layered_scattering.hpp"
#include "tables/pictures/raster.hpp"
#include "tables/pictures/rows_figure.hpp"
#include "tables/records/records.hpp"

namespace irido::cli {

/// A parsed query about a surface. Each kind of surface uses what it supports and refuses the rest
/// by name.
struct SurfaceQuery {
    std::string quantity = "brdf";  ///< brdf, albedo, transmissivity, sampling, density
    DirectionOptions directions;
    std::vector<double> wavelengths_nm;
    std::string paths = "single";         ///< single, all, simulation, simulation-single
    std::string transmission = "single";  ///< single, multiple
    ScratchOptions scratch;
    std::string samples, seed, facets, shard;  ///< of simulations; "" if not typed
    std::vector<std::string> merge;            ///< files of shards
    bool wants_color = false;
    bool scatterogram = false;
    ColorOptions color;  ///< illuminant, observer, space, adaptation and tolerance
    Execution execution{0};
    std::function<void(const std::string&)> note = [](const std::string&) {};
};

/// Rows, and the meaning of their columns in a picture.
struct SurfaceRows {
    tables::Records records;
    tables::RowPlot plot;
    std::optional<tables::Pixels> pixels = {};  ///< a picture other than a plot of the rows
};

// Parsers of option values; each throws UsageError.
Paths parse_paths(const std::string& text);
Paths parse_closed_paths(const std::string& text);  ///< single or all, without simulations
Crossings parse_crossings(const std::string& text);

/// A layered surface and the query as metadata has them.
nlohmann::json surface_facts(const LayeredSurface& surface, const SurfaceQuery& query);

/// Notes materials of the layers that colours clamp to their end values; see report_held_ranges().
/// surface      the surface
/// document     its document, to name in messages
/// sensitivity  determines the fraction of X, Y, Z affected
/// query        the query
void report_held_layers(const LayeredSurface& surface, const schemas::SurfaceDocument& document,
                        const Sensitivity& sensitivity, const SurfaceQuery& query);

/// Two discs of directions for each surface: in a white environment, where a pixel is the albedo,
/// and in a beam from the light's direction, pi times the BRDF; of several surfaces side by side,
/// the beam's below. Throws as rows_of_surface() does.
SurfaceRows layered_scatterogram(std::span<const schemas::SurfaceDocument> documents,
                                 const SurfaceQuery& query);

/// Evaluates a layered surface. Throws UsageError and InputError.
SurfaceRows rows_of_surface(const LayeredSurface& surface, const schemas::SurfaceDocument& document,
                            const SurfaceQuery& query);

/// Evaluates a scratched surface. Throws UsageError and InputError.
SurfaceRows rows_of_surface(const ScratchedSurface& surface,
                            const schemas::SurfaceDocument& document, const SurfaceQuery& query);

}  // namespace irido::cli
