#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/commands/lut_brdf.hpp"
#include "cli/options/surface_options.hpp"
#include "cli/queries/surface_colors.hpp"
#include "cli/queries/surface_query.hpp"
#include "core/color/held_stack.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/math/constants.hpp"
#include "core/math/random.hpp"
#include "core/rough/walk/layered_bands.hpp"
#include "schemas/input_error.hpp"
#include "tables/lut/lut_file.hpp"

namespace irido::cli {

namespace {

/// Wavelengths 2 nm apart that bands are means over.
constexpr std::size_t kBandWavelengths = 236;
constexpr std::size_t kMostBands = 60, kMostAngles = 8192;

struct LutLayeredCommand {
    SurfaceOptions surface;
    SurfaceQuery query;
    std::string bands = "12", size = "256", type = "f32";
    OutputOptions output;
    unsigned threads = 0;
    bool quiet = false;
};

/// CIEDE2000 of pi times two BRDFs, brighter ones than white brought down together.
double difference_of(const Triple& a, const Triple& b, const Triple& white) {
    const double scale = kPi / std::max({1.0, kPi * a[1], kPi * b[1]});
    const auto lab_of = [&](const Triple& xyz) {
        Triple scaled{};
        for (std::size_t c = 0; c < 3; ++c) scaled[c] = std::max(0.0, scale * xyz[c]);
        return lab(scaled, white);
    };
    return ciede2000(lab_of(a), lab_of(b));
}

struct BandErrors {
    double bands = 0, colors = 0;  ///< largest CIEDE2000
};

/// Of the bands, and of three, as many as a colour has, at random pairs.
BandErrors band_errors(const LayeredScattering& scattering, const LayeredBands& bands,
                       const LayeredBands& three, const TabulatedScattering& exact,
                       const Triple& white) {
    constexpr int kPairs = 300;
    Random random(1);
    BandErrors errors;
    for (int k = 0; k < kPairs; ++k) {
        const double theta = random.uniform(0, 80);
        const bool is_near = k % 2 == 0;  // to the mirror direction
        const ScatterPair pair{theta,
                               is_near ? std::clamp(theta + random.uniform(-10, 10), 0.0, 85.0)
                                       : random.uniform(0, 80),
                               is_near ? random.uniform(170, 180) : random.uniform(0, 180)};
        const double half = 0.5 * pair.phi_deg * kDegree;
        const Triple truth =
            exact(exact.direction(pair.theta_i_deg), exact.direction(pair.theta_o_deg),
                  std::cos(half), std::sin(half));
        errors.bands = std::max(errors.bands, difference_of(bands(scattering, pair), truth, white));
        errors.colors =
            std::max(errors.colors, difference_of(three(scattering, pair), truth, white));
    }
    return errors;
}

/// Rows of the table: for every three bands R and f_t cos / G1 of each layer, the base, and what
/// the bands weigh in r, g and b.
tables::Lut table_of(const LayeredBands& bands, const Illumination& illumination) {
    tables::Lut lut;
    lut.kind = "layered";
    lut.channels = {"band_0", "band_1", "band_2"};
    const std::size_t groups = bands.bands / 3;
    const auto add_row = [&](const auto& value) {
        for (std::size_t k = 0; k < bands.angles; ++k)
            for (std::size_t b = 0; b < 3; ++b) lut.values.push_back(value(k, b));
    };
    std::vector<Triple> weights;
    for (const Triple& xyz : bands.weight) weights.push_back(illumination.transform(xyz));
    std::size_t rows = 0;
    for (std::size_t g = 0; g < groups; ++g) {
        for (std::size_t l = 0; l < bands.reflected.size(); ++l)
            for (const auto* table : {&bands.reflected[l], &bands.straight[l]}) {
                add_row([&](std::size_t k, std::size_t b) {
                    return (*table)[k * bands.bands + 3 * g + b];
                });
                ++rows;
            }
        add_row([&](std::size_t, std::size_t b) { return bands.base[3 * g + b]; });
        for (std::size_t c = 0; c < 3; ++c)
            add_row([&](std::size_t, std::size_t b) { return weights[3 * g + b][c]; });
        rows += 4;
    }
    lut.axes = {{"row", "", tables::equally_spaced(0, static_cast<double>(rows - 1), rows)},
                {"theta_deg", "deg", tables::equally_spaced(0, 90, bands.angles)}};
    return lut;
}

tables::LutType type_of(const std::string& text) {
    for (const tables::LutType type :
         {tables::LutType::f16, tables::LutType::f32, tables::LutType::f64})
        if (name_of(type) == text) return type;
    throw UsageError("--dtype: must be one of f16, f32, f64 (got '" + text + "')");
}

int run_lut_layered(const LutLayeredCommand& command) {
    const tables::LutFormat* const format =
        tables::find_lut_format(resolved_format(command.output));
    if (!format || (command.output.file.empty() && format->is_binary))
        throw UsageError(
            "--output: must name a table's file, such as FILE.ktx2, FILE.exr, FILE.npy, FILE.bin "
            "or "
            "FILE.csv");
    const auto band_count =
        static_cast<std::size_t>(parse_whole_number("--bands", command.bands, 3, kMostBands));
    if (band_count % 3 != 0)
        throw UsageError("--bands: must be a multiple of 3 (got " + command.bands + ")");
    const auto angles =
        static_cast<std::size_t>(parse_whole_number("--size", command.size, 2, kMostAngles));
    SurfaceQuery query = command.query;
    query.execution = execution_of(command.threads);
    query.note = [&](const std::string& text) { note(text, command.quiet); };
    if (query.paths != "single" && query.paths != "all")
        throw UsageError("--paths: must be single or all (got '" + query.paths + "')");
    const tables::LutType type = type_of(command.type);
    const ColorColumns colors(query.color);
    const schemas::SurfaceDocument document = read_noted_surface(command.surface, command.quiet);
    check_writable(command.output);
    const auto* read = std::get_if<LayeredSurface>(&document.surface);
    if (!read) throw schemas::InputError(document.file, "", "must be a layered surface");
    const Sensitivity& sensitivity = colors.illumination().tables.sensitivity();
    LayeredSurface surface = *read;
    report_held_layers(surface, document, sensitivity, query);
    try {
        for (RoughLayer& layer : surface.layers) layer.stack = held_stack(layer.stack, sensitivity);
        const Crossings crossings = parse_crossings(query.transmission);
        const Paths paths = parse_paths(query.paths);
        const LayeredScattering scattering(surface, crossings, query.execution);
        if (query.paths == "all" && !scattering.is_closed())
            throw UsageError(
                "--paths all: requires a closed form: one layer without a coating, or a base "
                "alone");
        const SampleRule rule = equal_rule(sensitivity, kBandWavelengths);
        const auto bands_of = [&](std::size_t count) {
            return layered_bands(scattering, sensitivity, rule, paths, crossings, count, angles,
                                 query.execution);
        };
        const LayeredBands bands = bands_of(band_count), three = bands_of(3);
        const TabulatedScattering exact(scattering, rule, sensitivity.white(), paths, crossings,
                                        query.execution);
        const BandErrors errors = band_errors(scattering, bands, three, exact, sensitivity.white());
        tables::Lut lut = table_of(bands, colors.illumination());
        lut.type = type;
        nlohmann::json alphas = nlohmann::json::array(), nodes = nlohmann::json::array();
        for (const RoughLayer& layer : surface.layers) alphas.push_back(layer.alpha);
        lut.facts["color_space"] = query.color.space;
        lut.facts["error"] = {{"measure", "delta_e_2000"}, {"value", errors.bands}};
        lut.facts["notes"] = {
            "rows, for every three bands: R over theta_d and f_t cos / G1 over the angle inside of "
            "each layer, the base's albedo, and what the bands weigh in r, g and b",
            "products of three bands alone would err by up to " +
                to_text(std::round(100 * errors.colors) / 100) + " in CIEDE2000"};
        lut.facts["request"] = {
            {"alpha", alphas},
            {"bands", band_count},
            {"groups", band_count / 3},
            {"layers", surface.layers.size()},
            {"n_outside_per_n_inside", std::sqrt(scattering.coating().dilution())},
            {"paths", query.paths},
            {"transmission", query.transmission},
            {"illuminant", query.color.illuminant},
            {"observer", query.color.observer}};
        query.note("CIEDE2000 of " + command.bands + " bands: up to " +
                   to_text(std::round(100 * errors.bands) / 100) +
                   "; of three bands: " + to_text(std::round(100 * errors.colors) / 100));
        if (command.output.file.empty()) {
            write_bytes(format->write(lut, {}).back().bytes, command.output, false);
            return 0;
        }
        tables::write_lut(lut, command.output.file, *format, {});
    } catch (const DomainError& error) {
        throw schemas::InputError(document.file, "", error.what());
    }
    return 0;
}

}  // namespace

void add_lut_layered(CLI::App& lut, Run& run) {
    CLI::App* command = lut.add_subcommand(
        "layered", "All that a shader needs of a rough layered surface, in bands of the spectrum.");
    const auto options = std::make_shared<LutLayeredCommand>();
    add_surface_options(*command, options->surface);
    command
        ->add_option("--bands", options->bands,
                     "bands of the spectrum, a multiple of 3, [3, 60] [12]")
        ->type_name("N");
    command->add_option("--size", options->size, "angles from 0 to 90 degrees, [2, 8192] [256]")
        ->type_name("N");
    add_table_paths_options(*command, options->query.paths, options->query.transmission);
    add_light_options(*command, options->query.color);
    add_space_options(*command, options->query.color);
    command->add_option("--dtype", options->type, "number format: f16, f32 or f64 [f32]")
        ->type_name("NAME");
    offer(*command, "dtype", "f16 f32 f64");
    add_output_options(*command, options->output, "csv, npy, bin, ktx2 or exr");
    add_threads_option(*command, options->threads);
    command->add_flag("--quiet", options->quiet, "no notes on standard error");
    set_examples(*command,
                 {"irido lut layered schemas/examples/surfaces/green-on-pale.json -o green.ktx2",
                  "irido lut layered schemas/examples/surfaces/blue-over-red.json --bands 24 "
                  "-o blue.exr"},
                 "irido lut shader layered prints the code that reads it. The metadata has the\n"
                 "roughnesses, the number of groups of three bands, and the error in CIEDE2000.");
    command->callback([options, &run] { run = [options] { return run_lut_layered(*options); }; });
}

}  // namespace irido::cli
