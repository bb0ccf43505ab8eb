#include <algorithm>
#include <array>
#include <memory>

#include "cli/commands/lut_brdf.hpp"
#include "cli/options/surface_options.hpp"
#include "cli/queries/surface_colors.hpp"
#include "cli/queries/surface_query.hpp"
#include "core/color/held_stack.hpp"
#include "core/rough/walk/tabulated_scattering.hpp"
#include "schemas/input_error.hpp"
#include "tables/lut/measured/measured_bsdf.hpp"
#include "tables/lut/measured/merl.hpp"
#include "tables/version.hpp"

namespace irido::cli {

namespace {

/// Wavelengths 2 nm apart, for colours of MERL tables.
constexpr std::size_t kMerlWavelengths = 236;

struct LutBrdfCommand {
    SurfaceOptions surface;
    SurfaceQuery query;
    std::string wavelengths = "360:830:10";
    OutputOptions output;
    unsigned threads = 0;
    bool quiet = false;
};

/// "binary" or "bsdf".
std::string measured_format(const OutputOptions& output) {
    if (output.file.empty() && output.format.empty())
        throw UsageError("--output: is required: FILE.binary (MERL) or FILE.bsdf");
    const std::string typed = resolved_format(output), name = typed == "merl" ? "binary" : typed;
    constexpr std::array<std::string_view, 3> names{"binary", "merl", "bsdf"};
    if (name != "binary" && name != "bsdf")
        throw UsageError((output.format.empty() ? "--output: the extension " : "--format: ") +
                         not_one_of(names, typed));
    return name;
}

const LayeredSurface& layered(const schemas::SurfaceDocument& document) {
    if (const auto* surface = std::get_if<LayeredSurface>(&document.surface)) return *surface;
    throw schemas::InputError(
        document.file, "",
        "must be a layered surface: the BRDF of a scratched one depends on place and azimuth");
}

std::string merl_bytes(const LayeredScattering& scattering, const ColorColumns& colors,
                       const SurfaceQuery& query) {
    const Sensitivity& sensitivity = colors.illumination().tables.sensitivity();
    const TabulatedScattering table(scattering, equal_rule(sensitivity, kMerlWavelengths),
                                    sensitivity.white(), parse_paths(query.paths),
                                    parse_crossings(query.transmission), query.execution);
    tables::MerlReport report;
    std::string bytes = tables::merl_file(
        [&](const tables::TablePair& pair) {
            return colors.drawn(table(table.direction(pair.theta_i_deg),
                                      table.direction(pair.theta_o_deg), pair.near, pair.far));
        },
        query.execution.threads, report);
    if (report.clamped > 0)
        query.note(to_text(static_cast<double>(report.clamped)) + " of " +
                   to_text(static_cast<double>(report.cells - report.below)) +
                   " cells above the horizon lie outside of sRGB: components below 0 are 0");
    return bytes;
}

std::string bsdf_bytes(const LayeredScattering& scattering,
                       const schemas::SurfaceDocument& document, const LutBrdfCommand& command,
                       const SurfaceQuery& query) {
    tables::MeasuredBsdf bsdf;
    bsdf.description = (document.name.empty() ? document.file : document.name) + ", irido " +
                       tables::this_build().version;
    bsdf.alpha = 1;
    for (const RoughLayer& layer : scattering.surface().layers)
        bsdf.alpha = std::min(bsdf.alpha, layer.alpha);
    bsdf.wavelength_nm = parse_list("--wavelengths", command.wavelengths, kAllWavelengths.first_nm,
                                    kAllWavelengths.last_nm);
    if (!std::ranges::is_sorted(bsdf.wavelength_nm, std::less_equal<>()))
        throw UsageError("--wavelengths: must ascend for a .bsdf file");
    constexpr int kLast = 32;
    for (int t = 0; t <= kLast; ++t) bsdf.theta_i_deg.push_back(89.9 * t / kLast);
    const Paths paths = parse_paths(query.paths);
    return tables::measured_bsdf(bsdf, [&](std::span<const ScatterPair> pairs) {
        return scattering.brdf(pairs, bsdf.wavelength_nm, paths);
    });
}

int run_lut_brdf(const LutBrdfCommand& command) {
    const std::string format = measured_format(command.output);
    SurfaceQuery query = command.query;
    query.execution = execution_of(command.threads);
    query.note = [&](const std::string& text) { note(text, command.quiet); };
    if (query.paths != "single" && query.paths != "all")
        throw UsageError("--paths: must be single or all (got '" + query.paths + "')");
    const ColorColumns colors(query.color);
    const schemas::SurfaceDocument document = read_noted_surface(command.surface, command.quiet);
    check_writable(command.output);
    const Sensitivity& sensitivity = colors.illumination().tables.sensitivity();
    LayeredSurface surface = layered(document);
    try {
        if (format == "binary") {
            report_held_layers(surface, document, sensitivity, query);
            for (RoughLayer& layer : surface.layers)
                layer.stack = held_stack(layer.stack, sensitivity);
        }
        const LayeredScattering scattering(surface, parse_crossings(query.transmission),
                                           query.execution);
        if (query.paths == "all" && !scattering.is_closed())
            throw UsageError(
                "--paths all: requires a closed form: one layer without a coating, or a base "
                "alone");
        write_bytes(format == "binary" ? merl_bytes(scattering, colors, query)
                                       : bsdf_bytes(scattering, document, command, query),
                    command.output, true);
    } catch (const DomainError& error) {
        throw schemas::InputError(document.file, "", error.what());
    }
    return 0;
}

}  // namespace

void add_lut_brdf(CLI::App& lut, Run& run) {
    CLI::App* command = lut.add_subcommand(
        "brdf", "BRDF of a rough layered surface as a file that renderers read.");
    const auto options = std::make_shared<LutBrdfCommand>();
    add_surface_options(*command, options->surface);
    add_table_paths_options(*command, options->query.paths, options->query.transmission);
    command
        ->add_option("-w,--wavelengths", options->wavelengths,
                     "of .bsdf files, nm, [1, 1e7] [360:830:10]")
        ->type_name("LIST");
    add_light_options(*command, options->query.color);
    add_output_options(*command, options->output, "binary (merl) or bsdf");
    add_threads_option(*command, options->threads);
    command->add_flag("--quiet", options->quiet, "no notes on standard error");
    set_examples(
        *command,
        {"irido lut brdf schemas/examples/surfaces/green-on-pale.json -o green.binary",
         "irido lut brdf \"1 | (1@250 | 1.5@250)^10 | 1\" --alpha 0.1 -o mirror.bsdf"},
        ".binary: the MERL format, 90 x 90 x 180 cells in theta_h, theta_d, phi_d, linear sRGB,\n"
        "33 MB. .bsdf: the tensor file that Mitsuba's and pbrt's measured materials read,\n"
        "spectral. A coating's mirror is in neither.");
    command->callback([options, &run] { run = [options] { return run_lut_brdf(*options); }; });
}

}  // namespace irido::cli
