#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "cli/options/command.hpp"
#include "cli/options/surface_options.hpp"
#include "cli/options/table_options.hpp"
#include "cli/queries/surface_colors.hpp"
#include "cli/queries/surface_query.hpp"

namespace irido::cli {

/// A table that irido lut makes of a rough layered surface, beside those of tables::lut_kinds().
struct SurfaceTableKind {
    std::string_view name, axes, summary;
    /// Adds options, examples and what is run.
    void (*add)(CLI::App& command, Run& run);
};

/// brdf, layered.
std::span<const SurfaceTableKind* const> surface_table_kinds();
extern const SurfaceTableKind surface_table_brdf, surface_table_layered;

/// Such a table, as typed.
struct SurfaceTableOptions : TableOutput {
    SurfaceOptions surface;
    SurfaceQuery query;
};

/// What such a table is computed from, read and checked.
class SurfaceTable {
public:
    /// Throws UsageError, and InputError of the surface's file.
    explicit SurfaceTable(const SurfaceTableOptions& typed);

    const SurfaceQuery& query() const { return query_; }
    Paths paths() const { return paths_; }
    const ColorColumns& colors() const { return colors_; }
    const schemas::SurfaceDocument& document() const { return document_; }
    const Sensitivity& sensitivity() const { return colors_.illumination().tables.sensitivity(); }

    /// The surface, which a message says must be `what`. Throws InputError if it is not layered.
    const LayeredSurface& layered(const std::string& what) const;
    /// The same for colours: materials hold their end values, which is noted. Throws InputError.
    LayeredSurface held(const LayeredSurface& surface) const;
    LayeredScattering scattering(const LayeredSurface& surface) const;

private:
    SurfaceQuery query_;
    Paths paths_;
    Crossings crossings_;
    ColorColumns colors_;
    schemas::SurfaceDocument document_;
};

}  // namespace irido::cli
