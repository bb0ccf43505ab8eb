#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/color_options.hpp"
#include "cli/options/scratch_options.hpp"
#include "cli/options/surface_options.hpp"
#include "core/rough/layered/layered_scattering.hpp"
#include "tables/pictures/rows_figure.hpp"
#include "tables/records/records.hpp"

namespace irido::cli {

/// What is asked of a surface, parsed. Each kind of surface takes what it knows and refuses the
/// rest by name.
struct SurfaceQuery {
    std::string quantity = "brdf";  ///< brdf, albedo, transmissivity, sampling, density
    DirectionOptions directions;
    std::vector<double> wavelengths_nm;
    std::string paths = "single";         ///< single, all
    std::string transmission = "single";  ///< single, multiple
    ScratchOptions scratch;
    bool wants_color = false;
    ColorOptions color;  ///< illuminant, observer, space, adaptation and tolerance
    Execution execution{0};
    std::function<void(const std::string&)> note = [](const std::string&) {};
};

/// Rows, and what their columns are in a picture.
struct SurfaceRows {
    tables::Records records;
    tables::RowPlot plot;
};

/// Answers of a layered surface. Throws UsageError and InputError.
SurfaceRows rows_of_surface(const LayeredSurface& surface, const schemas::SurfaceDocument& document,
                            const SurfaceQuery& query);

/// Answers of a scratched surface. Throws UsageError and InputError.
SurfaceRows rows_of_surface(const ScratchedSurface& surface,
                            const schemas::SurfaceDocument& document, const SurfaceQuery& query);

}  // namespace irido::cli
