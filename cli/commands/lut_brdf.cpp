#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "cli/commands/surface_table.hpp"
#include "cli/progress.hpp"
#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"
#include "core/rough/walk/rest_table.hpp"
#include "core/rough/walk/tabulated_scattering.hpp"
#include "schemas/input_error.hpp"
#include "tables/lut/measured/half_angle_table.hpp"
#include "tables/lut/measured/measured_bsdf.hpp"
#include "tables/lut/measured/merl.hpp"
#include "tables/version.hpp"

namespace irido::cli {

namespace {

/// Wavelengths 1 nm apart, of colours.
constexpr std::size_t kPairWavelengths = 471;

/// Relative, of what is by adding.
constexpr double kRestTolerance = 1e-2;

constexpr const char* kBsdfWavelengths = "360:830:10";

struct LutBrdfCommand : SurfaceTableOptions {
    std::string wavelengths, phi_d, theta_h, theta_d, exposure;
};

std::vector<std::string_view> brdf_format_names() {
    std::vector<std::string_view> names{"binary", "merl", "bsdf"};
    for (const tables::LutFormat* format : tables::lut_formats()) names.push_back(format->name);
    for (const tables::PictureFormat* format : tables::picture_formats())
        names.push_back(format->name);
    return names;
}

/// The kind of output: a file for renderers, or a table or its picture.
enum class BrdfOutput { merl, bsdf, table };

BrdfOutput output_of(const LutBrdfCommand& command) {
    const std::string typed = resolved_format(command.output);
    const bool is_merl = typed == "binary" || typed == "merl";
    const std::size_t dot = command.output.file.find_last_of('.');
    const std::string extension =
        dot == std::string::npos ? "" : command.output.file.substr(dot + 1);
    const bool is_renderers = extension == "binary" || extension == "bsdf";
    if (!command.output.format.empty() && extension != typed &&
        !(is_merl && extension == "binary") && (is_renderers || tables::find_lut_format(extension)))
        throw UsageError("--format: " + typed + " contradicts the extension ." + extension);
    if (!is_merl && typed != "bsdf") {
        if (!command.wavelengths.empty())
            throw UsageError("--wavelengths: takes .bsdf files; tables are colours");
        return BrdfOutput::table;
    }
    if (command.output.file.empty())
        throw UsageError("--output: is required: FILE.binary (MERL) or FILE.bsdf");
    const TableOptions& table = command.table;
    for (const auto& [name, is_typed] : {std::pair("--phi-d", !command.phi_d.empty()),
                                         {"--theta-h", !command.theta_h.empty()},
                                         {"--theta-d", !command.theta_d.empty()},
                                         {"--dtype", !table.type.empty()},
                                         {"--size", !table.size.empty()},
                                         {"--tolerance", !table.tolerance.empty()},
                                         {"--any-size", table.any_size},
                                         {"--zstd", table.layout.zstd},
                                         {"--layers", table.layout.layers}})
        if (is_typed)
            throw UsageError(std::string(name) + ": ." + typed +
                             " files have a layout of their own");
    if (is_merl && !command.wavelengths.empty())
        throw UsageError("--wavelengths: takes .bsdf files; MERL's are colours");
    return is_merl ? BrdfOutput::merl : BrdfOutput::bsdf;
}

/// Of a table or, to say so, of a file for renderers.
void resolved_brdf_format(const OutputOptions& output) {
    try {
        resolved_lut_format(output);
    } catch (const UsageError&) {
        if (!output.format.empty() && tables::find_lut_format(output.format)) throw;
        throw UsageError((output.format.empty() ? "--output: the extension " : "--format: ") +
                         not_one_of(brdf_format_names(), resolved_format(output)));
    }
}

/// XYZ of the BRDF of very many pairs.
class PairColors {
public:
    PairColors(const LayeredScattering& scattering, const Sensitivity& sensitivity,
               const SurfaceQuery& query, Paths paths, bool quiet)
        : is_coated_(scattering.coating().is_there()),
          table_(scattering, equal_rule(sensitivity, kPairWavelengths), sensitivity.white(),
                 scattering.is_closed() ? paths : Paths::single,
                 parse_crossings(query.transmission), query.execution) {
        if (paths == Paths::single || scattering.is_closed()) return;
        Progress progress(quiet);
        rest_.emplace(scattering, sensitivity, kRestTolerance, query.execution,
                      [&](double done) { progress.set(done, "all paths"); });
    }

    Triple operator()(const tables::TablePair& pair) const {
        return with_rest(pair, table_(table_.direction(pair.theta_i_deg),
                                      table_.direction(pair.theta_o_deg), pair.near, pair.far));
    }

    /// Below the horizon too: with the half vector and theta_d as they are where nothing is
    /// refracted, and masking as it is at the horizon.
    Triple operator()(const tables::HalfAnglePair& one) const {
        if (is_coated_) return (*this)(one.pair);
        const tables::TablePair& pair = one.pair;
        const double sine = sin_deg(one.angles.theta_h_deg);
        const double cosine = cos_deg(one.angles.theta_h_deg);
        const MirrorFacet facet{one.angles.theta_d_deg,    sine * sine,
                                cosine * cosine,           sin_deg(pair.theta_i_deg),
                                cos_deg(pair.theta_i_deg), sin_deg(pair.theta_o_deg),
                                cos_deg(pair.theta_o_deg)};
        return with_rest(pair, table_(table_.direction(pair.theta_i_deg),
                                      table_.direction(pair.theta_o_deg), facet));
    }

private:
    Triple with_rest(const tables::TablePair& pair, Triple xyz) const {
        if (!rest_) return xyz;
        const Triple more = (*rest_)(pair.theta_i_deg, pair.theta_o_deg, pair.near, pair.far);
        for (std::size_t c = 0; c < 3; ++c) xyz[c] += more[c];
        return xyz;
    }

    bool is_coated_;
    TabulatedScattering table_;
    std::optional<RestTable> rest_;
};

std::string merl_bytes(const PairColors& pairs, const ColorColumns& colors,
                       const SurfaceQuery& query) {
    tables::MerlReport report;
    std::string bytes =
        tables::merl_file([&](const tables::TablePair& pair) { return colors.drawn(pairs(pair)); },
                          query.execution.threads, report);
    if (report.clamped > 0)
        query.note(to_text(static_cast<double>(report.clamped)) + " of " +
                   to_text(static_cast<double>(report.cells - report.below)) +
                   " cells above the horizon lie outside of sRGB: components below 0 are 0");
    return bytes;
}

double smoothest(const LayeredSurface& surface) {
    double alpha = 1;
    for (const RoughLayer& layer : surface.layers) alpha = std::min(alpha, layer.alpha);
    return alpha;
}

std::string bsdf_bytes(const LayeredScattering& scattering, const SurfaceTable& table,
                       const LutBrdfCommand& command) {
    const schemas::SurfaceDocument& document = table.document();
    tables::MeasuredBsdf bsdf;
    bsdf.description = (document.name.empty() ? document.file : document.name) + ", irido " +
                       tables::this_build().version;
    bsdf.alpha = smoothest(scattering.surface());
    bsdf.wavelength_nm = parse_list(
        "--wavelengths", command.wavelengths.empty() ? kBsdfWavelengths : command.wavelengths,
        kAllWavelengths.first_nm, kAllWavelengths.last_nm);
    if (!std::ranges::is_sorted(bsdf.wavelength_nm, std::less_equal<>()))
        throw UsageError("--wavelengths: must ascend for a .bsdf file");
    constexpr int kLast = 32;
    for (int t = 0; t <= kLast; ++t) bsdf.theta_i_deg.push_back(89.9 * t / kLast);
    return tables::measured_bsdf(bsdf, [&](std::span<const ScatterPair> pairs) {
        return scattering.brdf(pairs, bsdf.wavelength_nm, table.paths());
    });
}

std::vector<double> parse_half_angles(const std::string& option, const std::string& typed) {
    return typed.empty() ? std::vector<double>() : parse_list(option, typed, 0, 90);
}

tables::LutPlan plan_of(const PairColors& pairs, const LayeredSurface& surface,
                        const SurfaceTable& table, const LutBrdfCommand& command) {
    const Illumination& light = table.colors().illumination();
    const SurfaceQuery& query = table.query();
    const bool is_xyz = query.color.space == "xyz";
    tables::LutPlan plan =
        tables::half_angle_plan({parse_half_angles("--theta-h", command.theta_h),
                                 parse_half_angles("--theta-d", command.theta_d),
                                 parse_half_angles("--phi-d", command.phi_d), smoothest(surface),
                                 [&pairs](const tables::HalfAnglePair& one) { return pairs(one); },
                                 light.transform, light.white(), is_xyz});
    plan.facts = surface_facts(surface, query);
    plan.facts["color_space"] = query.color.space;
    const Triple& white = light.white();
    plan.facts["request"]["white_xyz"] = {white[0], white[1], white[2]};
    plan.facts["request"]["theta_h_scale_deg"] = plan.axes[1].axis.half_at;
    return plan;
}

double exposure_of(const LutBrdfCommand& command) {
    if (command.exposure.empty()) return 0;
    if (!asked_picture(command.output, command.picture))
        throw UsageError("--exposure: requires a picture, such as --output FILE.png");
    return parse_one_number("--exposure", command.exposure, -kMostExposure, kMostExposure);
}

int write_half_angles(tables::LutPlan plan, const LutBrdfCommand& command,
                      const std::string& title) {
    if (asked_picture(command.output, command.picture) && plan.axes[0].axis.count() > 1)
        throw UsageError("--phi-d: a picture shows one value (got " +
                         std::to_string(plan.axes[0].axis.count()) + ")");
    static const tables::LutKind kind{.name = surface_table_brdf.name,
                                      .summary = surface_table_brdf.summary,
                                      .axes = surface_table_brdf.axes};
    // pi times the BRDF, as of brdf --color: a white diffuser is white
    return make_table(kind, std::move(plan), command, title, true,
                      kPi * std::exp2(exposure_of(command)));
}

int run_lut_brdf(const LutBrdfCommand& command) {
    const BrdfOutput kind = output_of(command);
    exposure_of(command);  // before the work
    if (kind == BrdfOutput::table && !asked_picture(command.output, command.picture))
        resolved_brdf_format(command.output);
    const SurfaceTable table(command);
    const Paths paths = table.paths();
    const LayeredSurface& asked = table.layered(
        "must be a layered surface: the BRDF of a scratched one depends on place and "
        "azimuth");
    try {
        const LayeredSurface surface = kind == BrdfOutput::bsdf ? asked : table.held(asked);
        const LayeredScattering scattering = table.scattering(surface);
        if (paths == Paths::all && scattering.layers() > 1)
            throw UsageError(
                "--paths all: files and tables take it for up to one layer: between several, light "
                "goes in peaks that take seconds for every wavelength (irido brdf has single "
                "pairs)");
        if (kind == BrdfOutput::bsdf && paths == Paths::all && !scattering.is_closed())
            throw UsageError(
                "--paths all: .bsdf files, which are spectral, take it where it has a closed form, "
                "of one layer without a coating or of a base alone; .binary and tables take a "
                "coating as well");
        if (kind == BrdfOutput::bsdf) {
            write_bytes(bsdf_bytes(scattering, table, command), command.output, true);
            return 0;
        }
        const PairColors pairs(scattering, table.sensitivity(), table.query(), paths,
                               command.quiet);
        if (kind == BrdfOutput::merl) {
            write_bytes(merl_bytes(pairs, table.colors(), table.query()), command.output, true);
            return 0;
        }
        return write_half_angles(plan_of(pairs, surface, table, command), command,
                                 title_of(table.document(), command.surface));
    } catch (const DomainError& error) {
        throw schemas::InputError(table.document().file, "", error.what());
    }
}

void add_lut_brdf(CLI::App& command, Run& run) {
    const auto options = std::make_shared<LutBrdfCommand>();
    add_surface_options(command, options->surface);
    add_table_paths_options(command, options->query.paths, options->query.transmission);
    command
        .add_option("--phi-d", options->phi_d,
                    "azimuths of the light about the half vector, degrees, [0, 90] [0:90/32]")
        ->type_name("LIST");
    command
        .add_option("--theta-h", options->theta_h,
                    "angles of the half vector, degrees, [0, 90] [128, closest in the lobe]")
        ->type_name("LIST");
    command
        .add_option("--theta-d", options->theta_d,
                    "half the angle between the directions, degrees, [0, 90] [0:90/64]")
        ->type_name("LIST");
    command
        .add_option("-w,--wavelengths", options->wavelengths,
                    "of .bsdf files, nm, [1, 1e7] [360:830:10]")
        ->type_name("LIST");
    add_colorimetry_options(command, options->query.color);
    add_table_size_options(command, options->table, "[f32]");
    add_output_options(command, options->output, "binary (merl), bsdf, " + table_formats_text());
    add_picture_options(command, options->picture);
    command
        .add_option("--exposure", options->exposure,
                    "brighten a picture, which shows pi times the BRDF, by 2^EV, [-40, 40] [0]")
        ->type_name("EV");
    add_table_layout_options(command, options->table);
    add_threads_option(command, options->threads);
    add_quiet_option(command, options->quiet);
    set_examples(
        command,
        {"irido lut brdf schemas/examples/surfaces/green-on-pale.json -o green.binary",
         "irido lut brdf \"1 | (1@250 | 1.5@250)^10 | 1\" --alpha 0.1 -o mirror.bsdf",
         "irido lut brdf schemas/examples/surfaces/beetle-green.json --tolerance 1 -o beetle.ktx2",
         "irido lut brdf schemas/examples/surfaces/beetle-green.json --phi-d 90 -o beetle.png"},
        "Axes: " + std::string(surface_table_brdf.axes) + ".\n" +
            "Tables hold the BRDF per steradian, without a coating's mirror; phi_d from 0 to 90\n"
            "is all, by symmetry. Samples with a direction below the horizon continue those\n"
            "above. The error, in CIEDE2000 of pi times the BRDF (values above white are\n"
            "first scaled down to white), is that above the horizon.\n"
            ".binary: the MERL format, 90 x 90 x 180 cells in theta_h, theta_d, phi_d, linear "
            "sRGB,\n"
            "33 MB. .bsdf: the tensor file that Mitsuba's and pbrt's measured materials read,\n"
            "spectral.");
    set_run(command, run, options, run_lut_brdf);
}

}  // namespace

constinit const SurfaceTableKind surface_table_brdf{
    .name = "brdf",
    .axes = "phi_d_deg, theta_h_deg, theta_d_deg",
    .summary = "BRDF of a rough layered surface, as a table or as a file that renderers read.",
    .add = add_lut_brdf};

}  // namespace irido::cli
