#include <memory>
#include <nlohmann/json.hpp>

#include "cli/options/command.hpp"
#include "cli/queries/color_query.hpp"
#include "cli/queries/other_documents.hpp"
#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "tables/view/view_page.hpp"

namespace irido::cli {

namespace {

struct ViewCommand {
    schemas::StackRequest stack;
    OutputOptions output;
    ColorOptions light;
    unsigned threads = 0;
    bool quiet = false;
};

int run_view(const ViewCommand& command) {
    if (command.output.file.empty() && command.output.format.empty())
        throw UsageError("--output: must name a page, .html, or be given with --format");
    const bool is_default = command.output.format.empty() && is_nameless(command.output);
    if (const std::string format = resolved_format(command.output); format != "html" && !is_default)
        throw UsageError(
            (command.output.format.empty() ? "--output: the extension " : "--format: ") +
            std::string("must be html (got '") + format + "')");
    if (command.stack.reverse) throw UsageError("--reverse: not supported by pages");
    const auto say = [&](const std::string& text) { note(text, command.quiet); };
    const schemas::StackSource source = schemas::load_stack(command.stack);
    refuse_other_documents(source, "shown on a page");
    const schemas::StackDocument document = schemas::read_source(source);
    for (const std::string& text : document.notes) say(text);
    const ColorOptions& typed = command.light;
    const Illumination illumination(
        typed.illuminant,
        Sensitivity(parse_observer(typed.observer), parse_illuminant(typed.illuminant)),
        rgb_space("srgb"), Adaptation::bradford);
    report_held_ranges(document, illumination.tables.sensitivity(), typed.strict, say);
    check_writable(command.output);
    tables::ViewRequest request;
    request.title = title_of(document, command.stack);
    request.light = "Illuminant " + typed.illuminant + ", observer of " + typed.observer +
                    " degrees, Bradford adaptation to sRGB";
    request.source = &source.document;
    request.stack = &document.stack;
    request.threads = command.threads;
    try {
        write_bytes(tables::view_page(illumination.tables, illumination.transform, request),
                    command.output, false);
    } catch (const DomainError& error) {
        throw schemas::InputError(document.file, "", error.what());
    }
    return 0;
}

}  // namespace

void add_view_command(CLI::App& program, Run& run) {
    CLI::App* command =
        program.add_subcommand("view", "A page to explore a stack in a browser: one HTML file.");
    const auto options = std::make_shared<ViewCommand>();
    add_stack_options(*command, options->stack);
    add_light_options(*command, options->light);
    add_strict_option(*command, options->light.strict);
    add_output_options(*command, options->output, "html", " (with -f)");
    add_threads_option(*command, options->threads);
    add_quiet_option(*command, options->quiet);
    set_examples(
        *command,
        {"irido view \"1 | (1@125 | 1.5@375)^20 | 1\" -o explore.html",
         "irido view \"air | 1.33@400 | air\" -o film.html"},
        "The page needs no network and no other file. It shows a sphere, a bubble or a plane (by\n"
        "WebGL 2), the colours over the angle, and at the pointer the spectrum, sRGB and CIELAB;\n"
        "sliders change thicknesses, repetitions and constant indices. Its colours are those of\n"
        "irido color within the error that stands on the page.");
    set_run(*command, run, options, run_view);
}

}  // namespace irido::cli
