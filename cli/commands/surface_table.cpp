#include "cli/commands/surface_table.hpp"

#include <array>

#include "schemas/input_error.hpp"

namespace irido::cli {

namespace {

SurfaceQuery running(const SurfaceTableOptions& typed) {
    SurfaceQuery query = typed.query;
    query.execution = execution_of(typed.threads);
    query.note = [quiet = typed.quiet](const std::string& text) { note(text, quiet); };
    return query;
}

}  // namespace

std::span<const SurfaceTableKind* const> surface_table_kinds() {
    static constexpr std::array kinds{&surface_table_brdf, &surface_table_layered};
    return kinds;
}

SurfaceTable::SurfaceTable(const SurfaceTableOptions& typed)
    : query_(running(typed)),
      paths_(parse_closed_paths(query_.paths)),
      crossings_(parse_crossings(query_.transmission)),
      colors_(query_.color),
      document_(read_noted_surface(typed.surface, typed.quiet)) {
    check_writable(typed.output);
}

const LayeredSurface& SurfaceTable::layered(const std::string& what) const {
    if (const auto* surface = std::get_if<LayeredSurface>(&document_.surface)) return *surface;
    throw schemas::InputError(document_.file, "", what);
}

LayeredSurface SurfaceTable::held(const LayeredSurface& surface) const {
    report_held_layers(surface, document_, sensitivity(), query_);
    return held_surface(surface, sensitivity());
}

LayeredScattering SurfaceTable::scattering(const LayeredSurface& surface) const {
    return {surface, crossings_, query_.execution};
}

}  // namespace irido::cli
