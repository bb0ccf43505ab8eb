#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/commands/surface_table.hpp"
#include "cli/exit_status.hpp"
#include "core/rough/walk/layered_nodes.hpp"
#include "schemas/input_error.hpp"

namespace irido::cli {

namespace {

/// Wavelengths 1 nm apart that tables are computed with.
constexpr std::size_t kTableWavelengths = 471;
constexpr std::size_t kMostAngles = 8192, kMostTableLayers = 16;

/// CIEDE2000, of a table whose nodes and tolerance were not typed.
constexpr double kUsualDifference = 1;

struct LutLayeredCommand : SurfaceTableOptions {
    std::string nodes;
};

/// Rows of colours of theta_d and of straight light by the angle inside: the top layer; then for
/// every three nodes and each layer that is crossed f_t cos / G1 at the nodes, and what is below at
/// each of them.
tables::Lut table_of(const LayeredNodes& nodes, const RgbTransform& transform) {
    tables::Lut lut;
    lut.kind = "layered";
    lut.channels = {"0", "1", "2"};
    std::size_t rows = 0;
    const auto add_row = [&](const auto& texel) {
        for (std::size_t k = 0; k < nodes.angles; ++k) {
            const Triple three = texel(k);
            lut.values.insert(lut.values.end(), three.begin(), three.end());
        }
        ++rows;
    };
    const std::size_t count = nodes.wavelength_nm.size();
    add_row([&](std::size_t k) { return transform(nodes.top[k]); });
    for (std::size_t first = 0; first < count; first += 3)
        for (std::size_t l = 0; l < nodes.straight.size(); ++l) {
            add_row([&](std::size_t k) {
                const double* const three = nodes.straight[l].data() + k * count + first;
                return Triple{three[0], three[1], three[2]};
            });
            for (std::size_t j = first; j < first + 3; ++j)
                add_row([&](std::size_t k) { return transform(nodes.below[l][k * count + j]); });
        }
    lut.axes = {{"row", "", tables::equally_spaced(0, static_cast<double>(rows - 1), rows)},
                {"theta_deg", "deg", tables::equally_spaced(0, 90, nodes.angles)}};
    return lut;
}

NodeRequest request_of(const LutLayeredCommand& command, tables::LutType type) {
    NodeRequest request;
    if (!command.nodes.empty()) {
        const auto count = parse_whole_number("--nodes", command.nodes, 3, kMostNodes);
        request.nodes = static_cast<std::size_t>(count);
        if (*request.nodes % 3 != 0)
            throw UsageError("--nodes: must be a multiple of 3 (got " + command.nodes + ")");
        if (!command.table.tolerance.empty())
            throw UsageError("--tolerance: cannot be combined with --nodes");
    }
    if (!command.table.size.empty())
        request.angles = static_cast<std::size_t>(
            parse_whole_number("--size", command.table.size, 2, static_cast<double>(kMostAngles)));
    request.tolerance = command.table.tolerance.empty()
                            ? kUsualDifference
                            : parse_one_number("--tolerance", command.table.tolerance, 1e-3, 100);
    request.stored = [type](double value) { return rounded(value, type); };
    return request;
}

const LayeredSurface& crossed_surface(const SurfaceTable& table) {
    const LayeredSurface& read = table.layered("must be a layered surface");
    if (read.layers.empty())
        throw schemas::InputError(table.document().file, "/layers", "must have at least one layer");
    if (read.layers.size() > kMostTableLayers)
        throw schemas::InputError(
            table.document().file, "/layers",
            "must be at most " + std::to_string(kMostTableLayers) +
                " layers: every layer costs a shader five look-ups for three nodes (got " +
                std::to_string(read.layers.size()) + ")");
    return read;
}

double hundredths(double value) {
    return std::round(100 * value) / 100;
}

nlohmann::json facts_of(const FoundNodes& found, const LayeredScattering& scattering,
                        const SurfaceQuery& query) {
    nlohmann::json facts = surface_facts(scattering.surface(), query);
    nlohmann::json alphas = nlohmann::json::array();
    for (const RoughLayer& layer : scattering.surface().layers) alphas.push_back(layer.alpha);
    facts["color_space"] = query.color.space;
    facts["error"] = {{"measure", "delta_e_2000"}, {"value", found.error}};
    facts["notes"] = {
        "rows: the top layer's colour over theta_d; for every three nodes and each layer that is "
        "crossed f_t cos / G1 over the angle inside, then for each of the three what is directly "
        "below over theta_d, a colour"};
    facts["request"].update({{"alpha", alphas},
                             {"delta_e_of_products", found.products},
                             {"groups", found.table.wavelength_nm.size() / 3},
                             {"n_outside_per_n_inside", std::sqrt(scattering.coating().dilution())},
                             {"nodes_nm", found.table.wavelength_nm}});
    return facts;
}

/// Against errors of a table for which no tolerance was typed.
std::string remedy_of(const LutLayeredCommand& command) {
    std::string limits = command.table.size.empty() ? "" : "--size " + command.table.size;
    if (!command.nodes.empty())
        limits += (limits.empty() ? "" : " and ") + ("--nodes " + command.nodes);
    if (limits.empty()) return "no number of nodes and angles reaches it for this surface";
    return "leave out " + limits + ", or give more";
}

int run_lut_layered(const LutLayeredCommand& command) {
    const tables::LutFormat& format = resolved_lut_format(command.output, false);
    const tables::LutType type = parse_type(command.table.type);
    const NodeRequest request = request_of(command, type);
    const SurfaceTable table(command);
    const Paths paths = table.paths();
    const SurfaceQuery& query = table.query();
    const std::string& file = table.document().file;
    const ColorTables& tables = table.colors().illumination().tables;
    const LayeredSurface& surface = crossed_surface(table);
    try {
        const LayeredScattering scattering = table.scattering(table.held(surface));
        if (paths == Paths::all && !scattering.is_closed())
            throw UsageError(
                "--paths all: a table of this kind takes it where it has a closed form, of one "
                "layer without a coating; lut brdf takes a coating as well");
        const TabulatedScattering exact(
            scattering, equal_rule(tables.sensitivity(), kTableWavelengths),
            tables.sensitivity().white(), paths, scattering.crossings(), query.execution);
        const FoundNodes found = find_nodes(scattering, exact, tables, request, query.execution);
        const std::string error = to_text(hundredths(found.error));
        if (!command.table.tolerance.empty() && !(found.error <= request.tolerance)) {
            print_error(file + ": no table of up to " + std::to_string(kMostNodes) +
                        " nodes reaches " + command.table.tolerance + " in CIEDE2000: " + error +
                        " remains");
            return kCheckFailed;
        }
        tables::Lut lut = table_of(found.table, table.colors().illumination().transform);
        lut.type = type;
        lut.facts = facts_of(found, scattering, query);
        query.note("CIEDE2000 with " + std::to_string(found.table.wavelength_nm.size()) +
                   " nodes: up to " + error +
                   "; of colours multiplied: " + to_text(hundredths(found.products)));
        if (!(found.error <= request.tolerance))
            query.note("this is more than the usual " + to_text(request.tolerance) + ": " +
                       remedy_of(command));
        write_table(lut, format, {}, command.output, command.quiet);
    } catch (const DomainError& error) {
        throw schemas::InputError(file, "", error.what());
    }
    return 0;
}

void add_lut_layered(CLI::App& command, Run& run) {
    const auto options = std::make_shared<LutLayeredCommand>();
    options->table.type = "f32";
    add_surface_options(command, options->surface);
    command
        .add_option("--nodes", options->nodes,
                    "wavelengths at which straight light is known, a multiple of 3, [3, 60]\n"
                    "[the fewest that meet the tolerance]")
        ->type_name("N");
    command
        .add_option("--tolerance", options->table.tolerance,
                    "largest error, CIEDE2000 at random pairs of directions, [0.001, 100] [1];\n"
                    "exit status 1 if one that is given cannot be met")
        ->type_name("E");
    command
        .add_option("--size", options->table.size,
                    "angles from 0 to 90 degrees, [2, 8192] [256, 512 or 1024, by the tolerance]")
        ->type_name("N");
    add_table_paths_options(command, options->query.paths, options->query.transmission);
    add_colorimetry_options(command, options->query.color);
    add_dtype_option(command, options->table.type, "[f32]");
    add_output_options(command, options->output, "csv, npy, bin, ktx2 or exr");
    add_threads_option(command, options->threads);
    add_quiet_option(command, options->quiet);
    set_examples(command,
                 {"irido lut layered schemas/examples/surfaces/green-on-pale.json -o green.ktx2",
                  "irido lut layered schemas/examples/surfaces/blue-over-red.json --tolerance 0.5 "
                  "-o blue.exr"},
                 "irido lut shader layered prints the code that reads it. The metadata has the\n"
                 "roughnesses, the number of groups of three nodes, the error in CIEDE2000, and\n"
                 "that of a shader that multiplies colours.");
    set_run(command, run, options, run_lut_layered);
}

}  // namespace

constinit const SurfaceTableKind surface_table_layered{
    .name = "layered",
    .axes = "row, theta_deg",
    .summary =
        "Everything a shader needs for a rough layered surface: colours, and unscattered "
        "transmission at a few wavelengths.",
    .add = add_lut_layered};

}  // namespace irido::cli
