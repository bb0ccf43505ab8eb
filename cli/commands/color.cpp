#include <memory>

#include "cli/options/command.hpp"
#include "cli/options/long_work.hpp"
#include "cli/queries/color_query.hpp"
#include "tables/pictures/swatches.hpp"

namespace irido::cli {

namespace {

struct ColorCommand {
    schemas::StackRequest stack;
    std::unique_ptr<QueryOptions> typed;
    OutputOptions output;
    unsigned threads = 0;
    bool quiet = false;
};

std::string picture(const ColorQuery& query, const StackColors& stack, const std::string& title) {
    tables::Swatches swatches{title, "angle of incidence, degrees", stack.angles_deg, {}};
    const RgbSpace& space = rgb_space("srgb");
    const std::size_t sides = query.sides().size();
    for (std::size_t l = 0; l < stack.colors.size(); ++l) {
        const Illumination& illumination = *query.illuminations()[l];
        const RgbTransform transform =
            rgb_transform(space, illumination.white(), Adaptation::bradford);
        for (std::size_t s = 0; s < sides; ++s) {
            const std::string side(letter(query.sides()[s]));
            tables::Swatches::Strip strip{
                stack.colors.size() == 1 ? side : illumination.name + " " + side, {}};
            for (std::size_t i = s; i < stack.colors[l].size(); i += sides)
                strip.colors.push_back(hex(space, transform(stack.colors[l][i].xyz)));
            swatches.strips.push_back(std::move(strip));
        }
    }
    return tables::write_swatches(swatches);
}

int run_color(const ColorCommand& command) {
    const bool is_picture = resolved_format(command.output) == "svg";
    if (!is_picture) resolved_record_format(command.output, RecordTarget::stream_or_svg);
    const auto say = [&](const std::string& text) { note(text, command.quiet); };
    const ColorQuery query(static_cast<const ColorQueryOptions&>(*command.typed),
                           {.execution = execution_of(command.threads), .note = say});
    const auto prepared = query.prepare(read_noted_stack(command.stack, command.quiet));
    check_writable(command.output);
    const schemas::StackDocument& document = prepared->document;
    note_long_work(seconds_of_rows(query, document, command.threads), false, say);
    const StackColors colors = query.colors(*prepared, document.stack, query.angles_deg());
    if (is_picture) {
        const std::string title = document.name.empty() ? command.stack.stack : document.name;
        write_bytes(picture(query, colors, title), command.output, false);
    } else {
        write_records(query.records({colors}), command.output);
    }
    return 0;
}

}  // namespace

void add_color_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "color", "Colour of the light that a stack reflects or transmits: X, Y, Z and linear RGB.");
    const auto options = std::make_shared<ColorCommand>();
    add_stack_options(*command, options->stack);
    options->typed = ColorQueryOptions::add(*command);
    add_output_options(*command, options->output, record_formats_text(RecordTarget::stream_or_svg));
    add_threads_option(*command, options->threads);
    command->add_flag("--quiet", options->quiet, "no notes on standard error");
    set_examples(*command, {"irido color \"air | TiO2@35 | Ti\" -a 0:80:10 --stats",
                            "irido color stack.json -a 0:85:1 --side R,T -o strip.svg"});
    command->callback([options, &run] { run = [options] { return run_color(*options); }; });
}

}  // namespace irido::cli
