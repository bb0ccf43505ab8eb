#include <array>
#include <memory>

#include "cli/options/command.hpp"
#include "cli/options/long_work.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/options/words.hpp"
#include "cli/queries/color_query.hpp"
#include "tables/pictures/chromaticity_figure.hpp"

namespace irido::cli {

namespace {

struct ColorCommand {
    schemas::StackRequest stack;
    std::unique_ptr<QueryOptions> typed;
    OutputOptions output;
    PictureOptions picture;
    std::string plot = "strip";
    unsigned threads = 0;
    bool quiet = false;
};

/// Draws the path of the colours through the chromaticity diagrams.
tables::Figure chromaticity(const ColorCommand& command, const ColorQuery& query,
                            const StackColors& stack, const std::string& title) {
    const auto& typed = static_cast<const ColorQueryOptions&>(*command.typed);
    const std::size_t sides = query.sides().size();
    std::vector<tables::ChromaticityPath> paths;
    tables::InkMixer mixer(parse_gamut(command.picture));
    for (std::size_t l = 0; l < stack.colors.size(); ++l) {
        const Illumination& illumination = *query.illuminations()[l];
        const RgbTransform transform =
            rgb_transform(rgb_space("srgb"), illumination.white(), Adaptation::bradford);
        for (std::size_t s = 0; s < sides; ++s) {
            std::string name(letter(query.sides()[s]));
            if (stack.colors.size() > 1) name = illumination.name + " " + name;
            tables::ChromaticityPath path{name == "R" && sides == 1 ? "" : name, {}};
            for (std::size_t i = 0; i < stack.angles_deg.size(); ++i) {
                const Triple& xyz = stack.colors[l][i * sides + s].xyz;
                path.stops.push_back(
                    {xyz, mixer(transform(xyz)), to_text(stack.angles_deg[i]) + "\u00b0"});
            }
            paths.push_back(std::move(path));
        }
    }
    return tables::chromaticity_figure(title, paths, parse_observer(typed.color.observer),
                                       query.illuminations().front()->white());
}

constexpr std::array<std::string_view, 2> kPlots{"strip", "chromaticity"};

int run_color(const ColorCommand& command) {
    const tables::PictureFormat* const picture = asked_picture(command.output, command.picture);
    if (!picture) resolved_record_format(command.output, RecordTarget::stream_or_picture);
    if (command.plot != "strip" && command.plot != "chromaticity")
        throw UsageError("--plot: " + not_one_of(kPlots, command.plot));
    if (command.plot == "chromaticity" && !picture)
        throw UsageError("--plot: requires a picture, such as --output FILE.svg");
    const auto say = [&](const std::string& text) { note(text, command.quiet); };
    const ColorQuery query(
        static_cast<const ColorQueryOptions&>(*command.typed),
        {.execution = execution_of(command.threads), .note = say, .is_silent = command.quiet});
    const auto prepared = query.prepare(read_noted_stack(command.stack, command.quiet));
    check_writable(command.output);
    const schemas::StackDocument& document = prepared->document;
    note_long_work(seconds_of_rows(query, document, command.threads), false, say);
    const StackColors colors = query.colors(*prepared, document.stack, query.angles_deg());
    if (!picture) {
        write_records(query.records({colors}), command.output);
        return 0;
    }
    const std::string title = title_of(document, command.stack);
    const auto figure = [&] {
        if (command.plot == "chromaticity") return chromaticity(command, query, colors, title);
        return figure_of_rows(query, query.records({colors}), {}, title,
                              parse_gamut(command.picture), say);
    };
    write_picture(figure, command.picture, *picture, command.output);
    return 0;
}

}  // namespace

void add_color_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "color", "Colour of the light that a stack reflects or transmits: X, Y, Z and linear RGB.");
    const auto options = std::make_shared<ColorCommand>();
    add_stack_options(*command, options->stack);
    options->typed = ColorQueryOptions::add(*command);
    add_output_options(*command, options->output,
                       record_formats_text(RecordTarget::stream_or_picture));
    command
        ->add_option("--plot", options->plot,
                     "what a picture shows: a strip of the colours, or their path in the\n"
                     "chromaticity diagrams x, y and u', v': chromaticity [strip]")
        ->type_name("KIND");
    offer(*command, "plot", "chromaticity");
    add_picture_options(*command, options->picture);
    add_threads_option(*command, options->threads);
    add_quiet_option(*command, options->quiet);
    set_examples(*command, {"irido color \"air | TiO2@35 | Ti\" -a 0:80:10 --stats",
                            "irido color stack.json -a 0:85:1 --side R,T -o strip.svg",
                            "irido color stack.json -a 0:85:1 --plot chromaticity -o path.svg"});
    set_run(*command, run, options, run_color);
}

}  // namespace irido::cli
