#include <memory>

#include "cli/options/command.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/options/surface_options.hpp"
#include "cli/queries/layered_simulation.hpp"
#include "cli/queries/surface_query.hpp"
#include "tables/pictures/png_file.hpp"

namespace irido::cli {

namespace {

struct BrdfCommand {
    SurfaceOptions surface;
    SurfaceQuery query;
    std::vector<std::string> beside;  ///< further surfaces of a scatterogram
    std::string wavelengths = "380:780:1";
    OutputOptions output;
    PictureOptions picture;
    unsigned threads = 0;
    bool quiet = false;
};

/// The surface and those beside it.
std::vector<schemas::SurfaceDocument> documents_of(const schemas::SurfaceDocument& first,
                                                   const BrdfCommand& command) {
    std::vector<schemas::SurfaceDocument> documents{first};
    for (const std::string& typed : command.beside) {
        SurfaceOptions one = command.surface;
        one.source.stack = typed;
        documents.push_back(read_noted_surface(one, command.quiet));
    }
    return documents;
}

int run_brdf(const BrdfCommand& command) {
    constexpr std::size_t kMostBeside = 15;
    if (!command.beside.empty() && !command.query.scatterogram)
        throw UsageError("--beside: requires --scatterogram");
    if (command.beside.size() > kMostBeside)
        throw UsageError("--beside: must be given at most 15 times");
    const tables::PictureFormat* const picture = asked_picture(command.output, command.picture);
    if (!picture) resolved_record_format(command.output, RecordTarget::stream_or_picture);
    if (!command.query.shard.empty() && (picture || resolved_format(command.output) != "csv"))
        throw UsageError("--shard: must be written as csv, which --merge reads (got " +
                         resolved_format(command.output) + ")");
    if (command.query.scatterogram && (!picture || picture->name != "png") &&
        resolved_format(command.output) != "csv")
        throw UsageError("--scatterogram: requires --output FILE.png or FILE.csv");
    if (command.query.scatterogram && command.output.file.empty())
        throw UsageError("--scatterogram: requires --output FILE.png or FILE.csv");
    SurfaceQuery query = command.query;
    query.wavelengths_nm = parse_list("--wavelengths", command.wavelengths,
                                      kAllWavelengths.first_nm, kAllWavelengths.last_nm);
    query.execution = execution_of(command.threads);
    query.note = [&](const std::string& text) { note(text, command.quiet); };
    constexpr double kManySamples = 1e8;
    if (!query.samples.empty() && command.output.file.empty() &&
        parse_one_number("--samples", query.samples, 2, 1e12) > kManySamples)
        throw UsageError("--samples: more than 1e8 require --output FILE");
    SurfaceRows rows;
    if (!command.surface.source.stack.empty()) {
        const schemas::SurfaceDocument document =
            read_noted_surface(command.surface, command.quiet);
        check_writable(command.output);
        rows = query.scatterogram ? layered_scatterogram(documents_of(document, command), query)
                                  : std::visit(
                                        [&](const auto& surface) {
                                            return rows_of_surface(surface, document, query);
                                        },
                                        document.surface);
        rows.plot.title = title_of(document, command.surface);
    } else if (!query.merge.empty()) {
        rows = rows_of_shards(query);
        check_writable(command.output);
    } else {
        throw UsageError("SURFACE is required (see irido brdf --help)");
    }
    if (!picture) {
        write_records(rows.records, command.output);
        return 0;
    }
    if (rows.pixels) {
        for (const std::string& text : rows.plot.notes) query.note(text);
        const unsigned bits = command.picture.bits == "16" ? 16 : 8;
        write_bytes(tables::png_file(*rows.pixels, bits), command.output, true);
        return 0;
    }
    for (const std::string& text : rows.plot.notes) query.note(text);
    write_picture([&] { return tables::figure_of(rows.records, rows.plot); }, command.picture,
                  *picture, command.output);
    return 0;
}

}  // namespace

void add_brdf_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "brdf", "BRDF and albedo of surfaces with rough layers of thin films, or with scratches.");
    const auto options = std::make_shared<BrdfCommand>();
    add_surface_options(*command, options->surface);
    command->get_option("SURFACE")->required(false);  // unless with --merge
    add_direction_options(*command, options->query.directions);
    command
        ->add_option("-w,--wavelengths", options->wavelengths,
                     "vacuum wavelengths, nm, [1, 1e7] [380:780:1]")
        ->type_name("LIST");
    command
        ->add_option("--quantity", options->query.quantity,
                     "brdf: per steradian, without the coating's mirror\n"
                     "albedo: of light from each --light-theta, reflected into all directions,\n"
                     "the coating's mirror among them\n"
                     "transmissivity: of each layer, --light-theta being the angle inside\n"
                     "sampling: probabilities of the coating (0), each layer and the base\n"
                     "density: of scratches, the share of the area that they cover [brdf]")
        ->type_name("QUANTITY");
    offer(*command, "quantity", "brdf albedo transmissivity sampling density");
    command
        ->add_option("--paths", options->query.paths,
                     "single: light reflected once, by a layer or the base\n"
                     "all: between layers, base and coating as often as it may be\n"
                     "simulation, simulation-single: the same by Monte Carlo; adds the column\n"
                     "stderr [single]")
        ->type_name("PATHS");
    offer(*command, "paths", "single all simulation simulation-single");
    command
        ->add_option("--samples", options->query.samples,
                     "paths of each direction of the light, of a simulation, [2, 1e12] [1e6]")
        ->type_name("N");
    command->add_option("--seed", options->query.seed, "of a simulation, a whole number [1]")
        ->type_name("SEED");
    command
        ->add_option("--facets", options->query.facets,
                     "of a simulation: sampled (a facet at every crossing) or filter (their\n"
                     "mean, F_alpha) [sampled]")
        ->type_name("CHOICE");
    offer(*command, "facets", "sampled filter");
    command
        ->add_option("--shard", options->query.shard,
                     "of a simulation: part K of N of the samples only, as CSV; adds columns with\n"
                     "the sums that --merge joins")
        ->type_name("K/N");
    command
        ->add_option("--merge", options->query.merge,
                     "join the CSV files of all shards of one command, in any order, into what\n"
                     "it writes without --shard. SURFACE may be left out. Refuses files that were\n"
                     "changed, or computed by another build or at another SIMD level")
        ->type_name("FILE");
    command
        ->add_option("--transmission", options->query.transmission,
                     "single: straight light meets one facet of a layer; multiple: as many as\n"
                     "Smith's model has on its way, which loses less at grazing [single]")
        ->type_name("CROSSINGS");
    offer(*command, "transmission", "single multiple");
    command->add_flag("--color", options->query.wants_color,
                      "instead of wavelengths columns X,Y,Z,r,g,b,hex: colour of pi times the\n"
                      "BRDF, a white diffuser being 1, or of the albedo");
    command
        ->add_option(
            "--side", options->query.color.sides,
            "R: reflected light; T: light that one rough layer refracts into its\n"
            "substrate, --view-theta counting from the normal there and azimuth 180 being\n"
            "straight on: column btdf_per_sr [R]")
        ->type_name("SIDE");
    offer(*command, "side", "R T");
    command
        ->add_option("--method", options->query.color.method,
                     "colours of one rough layer's facets by a method of irido color, such as\n"
                     "gaussian, fourier or landmarks/3 [auto]")
        ->type_name("METHOD");
    offer(*command, "method", color_method_names);
    add_scratch_options(*command, options->query.scratch);
    command->add_flag("--scatterogram", options->query.scatterogram,
                      "two discs of directions seen from above: in a white environment, and pi\n"
                      "times the BRDF in a beam from --light-theta; requires -o FILE.png or .csv");
    command
        ->add_option("--beside", options->beside,
                     "another surface of the scatterogram, beside the first; repeatable")
        ->type_name("SURFACE")
        ->allow_extra_args(false);
    add_colorimetry_options(*command, options->query.color);
    command
        ->add_option("--tolerance", options->query.color.tolerance,
                     "maximum error of X, Y, Z, relative to the larger of 1 and what a mirror's\n"
                     "facets would give, [" +
                         to_text(kSmallestTolerance) + ", 1] [" + to_text(kDefaultTolerance) +
                         "]; of --paths all\n"
                         "where there is no closed form, relative [0.001]; of simulations the\n"
                         "largest standard error, relative (of colours as above), instead of\n"
                         "--samples; exit status 1 if a tolerance that is given cannot be met")
        ->type_name("T");
    add_output_options(*command, options->output,
                       record_formats_text(RecordTarget::stream_or_picture));
    add_picture_options(*command, options->picture);
    add_threads_option(*command, options->threads);
    add_quiet_option(*command, options->quiet);
    set_examples(
        *command,
        {"irido brdf \"1 | (1@250 | 1.5@250)^10 | 1\" --alpha 0.1 --light-theta 30 "
         "--view-theta 0:80:5 -w 420:700:10",
         "irido brdf schemas/examples/surfaces/green-on-pale.json --light-theta 0:85:5 "
         "--quantity albedo --paths all -w 550",
         "irido brdf schemas/examples/surfaces/blue-over-red.json --light-theta 45 "
         "--view-theta 0:80:1 --color -o strip.svg",
         "irido brdf schemas/examples/surfaces/worn-spoon.json --light-theta 19.7 --light-phi "
         "206.5 --view-theta 20 --view-phi 40 --footprint 150,80,20 --color"},
        "Directions point away from the surface. Rows are every combination, in the order\n"
        "light-theta, light-phi, view-theta, view-phi, wavelength, the last one fastest.");
    set_run(*command, run, options, run_brdf);
}

}  // namespace irido::cli
