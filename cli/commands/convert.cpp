#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "cli/options/command.hpp"
#include "core/error.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/stack_expression.hpp"
#include "schemas/readers/stacks/stack_format.hpp"
#include "schemas/readers/text_file.hpp"
#include "tables/files/atomic_file.hpp"
#include "tables/files/plain_file.hpp"

namespace irido::cli {

namespace {

using nlohmann::json;

struct ConvertCommand {
    schemas::StackRequest stack;
    schemas::StackReadOptions reading;
    std::string primary, range;
    OutputOptions output;
    bool quiet = false;
};

/// The output: JSON, an expression, or a format of another program.
struct Target {
    bool is_expression = false;
    const schemas::StackFormat* other = nullptr;

    bool is_json() const { return !is_expression && other == nullptr; }
};

Target resolved_target(const OutputOptions& output) {
    const bool is_default = output.format.empty() && is_nameless(output);
    const std::string name = is_default ? "json" : resolved_format(output);
    if (name == "json") return {};
    if (name == "expression" || (output.format.empty() && name == "txt")) return {true};
    if (output.format.empty()) {
        if (const auto* const format = schemas::stack_format_of(output.file))
            return {false, format};
        throw UsageError(
            "--output: the extension must be json, txt for an expression, dat (Zemax), ofp "
            "(OpenFilters) or csv (a list of layers) (got '" +
            name + "')");
    }
    std::vector<std::string_view> names{"json", "expression"};
    for (const schemas::StackFormat& format : schemas::stack_formats()) {
        if (format.name == name) return {false, &format};
        names.push_back(format.name);
    }
    throw UsageError("--format: " + not_one_of(names, name));
}

std::string as_json(schemas::StackSource source, const std::string& file) {
    schemas::move_files(source.document, source.folder,
                        std::filesystem::path(file).parent_path().string());
    schemas::shorten_numbers(source.document);
    return source.document.dump(2) + "\n";
}

std::string as_expression(const schemas::StackDocument& document, bool quiet) {
    const schemas::StackExpression expression = schemas::stack_expression(document.stack);
    for (const std::string& loss : expression.losses)
        note("an expression cannot hold: " + loss, quiet);
    return expression.text + "\n";
}

/// Reverses the layers. Throws InputError for layers whose reverse cannot be expressed.
void reverse_layers(nlohmann::json& layers, const std::string& file) {
    if (!layers.is_array()) return;
    std::reverse(layers.begin(), layers.end());
    for (nlohmann::json& element : layers) {
        if (element.contains("roughness_nm"))
            throw schemas::InputError(file, "",
                                      "roughness_nm cannot be written with --reverse as JSON");
        if (element.contains("graded"))
            std::swap(element["graded"]["from"], element["graded"]["to"]);
        if (element.contains("layers")) reverse_layers(element["layers"], file);
    }
}

/// Reverses the document's stack.
void reverse(schemas::StackSource& source) {
    nlohmann::json& document = source.document;
    if (document.contains("substrate_roughness_nm"))
        throw schemas::InputError(
            source.file, "", "substrate_roughness_nm cannot be written with --reverse as JSON");
    std::swap(document["incident"], document["substrate"]);
    if (document.contains("layers")) reverse_layers(document["layers"], source.file);
}

/// Refuses options for files of other programs.
void require_no_reading(const ConvertCommand& command) {
    for (const auto& [name, is_typed] : {std::pair("--coating", !command.reading.coating.empty()),
                                         {"--primary", !command.primary.empty()},
                                         {"--mirror", command.reading.is_mirror}})
        if (is_typed)
            throw UsageError(std::string(name) +
                             ": applies to files of other programs (COATING.DAT, .ofp, .csv)");
}

/// The stack from a file of another program, or from any source that other commands accept.
schemas::StackSource load(const ConvertCommand& command) {
    const std::string& path = command.stack.stack;
    const auto* const format =
        path.find('|') == std::string::npos ? schemas::stack_format_of(path) : nullptr;
    if (!format) {
        require_no_reading(command);
        return schemas::load_stack(command.stack);
    }
    schemas::StackReadOptions reading = command.reading;
    if (!command.primary.empty())
        reading.primary_nm = parse_one_number("--primary", command.primary, 1, 1e7);
    for (const std::string& text : command.stack.media)
        reading.media.insert(text.substr(0, text.find('=')));
    schemas::StackFile read = format->read(schemas::read_text(path), path, reading);
    for (const std::string& text : read.notes) note(text, command.quiet);
    schemas::StackSource source{std::move(read.document), path,
                                std::filesystem::path(path).parent_path().string(),
                                command.stack.reverse};
    schemas::set_values(source, command.stack);
    return source;
}

/// Whether a file beside the output is there. Throws UsageError if it has something else in it.
bool is_there(const std::string& path, const std::string& text) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return false;
    if (schemas::read_own_file(path) != text)
        throw UsageError(path + ": exists and differs; choose another folder");
    return true;
}

int write_other(const ConvertCommand& command, const schemas::StackFormat& format,
                const schemas::StackDocument& document) {
    schemas::StackWriteOptions options{document.name};
    if (!command.range.empty()) {
        const auto [first_nm, last_nm] = parse_range("--range", command.range, 1, 1e7);
        options.range = {first_nm, last_nm};
    }
    const schemas::WrittenStack written = [&] {
        try {
            return format.write(document.stack, options);
        } catch (const schemas::InputError& error) {
            if (!error.file.empty()) throw;
            throw schemas::InputError(document.file, error.where, error.message);
        }
    }();
    const bool is_file = !command.output.file.empty();
    const std::filesystem::path folder = std::filesystem::path(command.output.file).parent_path();
    std::set<std::string> kept;
    for (const auto& [name, text] : written.beside)
        if (is_file && is_there(folder / name, text)) kept.insert(name);
    for (const std::string& loss : written.losses)
        note(std::string(format.program) + " cannot hold: " + loss, command.quiet);
    for (const auto& [name, text] : written.beside) {
        if (is_file) {
            if (!kept.contains(name)) tables::write_file(folder / name, text);
        } else {
            note(name + " is not written: it requires --output FILE", command.quiet);
        }
    }
    write_bytes(written.text, command.output, false);
    return 0;
}

int run_convert(const ConvertCommand& command) {
    const Target target = resolved_target(command.output);
    check_writable(command.output);
    schemas::StackSource source = load(command);
    const schemas::StackDocument document = schemas::read_source(source);
    for (const std::string& text : document.notes) note(text, command.quiet);
    if (target.other) return write_other(command, *target.other, document);
    if (source.reverse && target.is_json()) reverse(source);
    const std::string place = is_nameless(command.output) ? "" : command.output.file;
    const std::string text = target.is_json() ? as_json(std::move(source), place)
                                              : as_expression(document, command.quiet);
    write_bytes(text, command.output, false);
    return 0;
}

void add_format_options(CLI::App& command, ConvertCommand& typed) {
    command
        .add_option("--coating", typed.reading.coating,
                    "which coating of a COATING.DAT or filter of a project with several")
        ->type_name("COATING");
    command
        .add_option("--primary", typed.primary,
                    "wavelength of thicknesses in waves (COATING.DAT) or quarter waves\n"
                    "(qwot of a list), nm")
        ->type_name("NM");
    command.add_flag("--mirror", typed.reading.is_mirror,
                     "the last layer of a coating of COATING.DAT is the substrate");
    command
        .add_option("--material-folder", typed.reading.folder,
                    "folder of the materials of an OpenFilters project, NAME.mat [the\n"
                    "project's own]")
        ->type_name("DIR");
    command
        .add_option("--range", typed.range,
                    "wavelengths of the tables that dispersive materials become, nm\n"
                    "[300:2500]")
        ->type_name("LO:HI");
}

}  // namespace

void add_convert_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "convert", "Convert a stack to and from the files of other programs.");
    const auto options = std::make_shared<ConvertCommand>();
    add_stack_options(*command, options->stack);
    command->get_option("STACK")->description(
        "stack file or expression as for every command; or COATING.DAT of\n"
        "Zemax (.dat), a project of OpenFilters (.ofp), or a list of layers\n"
        "(.csv: material, thickness_nm)");
    add_format_options(*command, *options);
    add_output_options(*command, options->output,
                       "json, expression, zemax, openfilters or csv (files: .json,\n"
                       ".txt, .dat, .ofp, .csv) [json]");
    add_quiet_option(*command, options->quiet);
    set_examples(*command,
                 {"irido convert \"air | (TiO2@58.5 | SiO2@94.2)^10 | BK7@1mm! | air\"",
                  "irido convert stack.json -f expression",
                  "irido convert stack.json --set substrate=Si -o on-silicon.json",
                  "irido convert filter.ofp -o COATING.DAT",
                  "irido convert COATING.DAT --coating AR --primary 550 --set substrate=BK7"},
                 "Paths of material files become relative to FILE. What a format cannot hold\n"
                 "(groups, incoherent layers, the media around, ranges of materials) is noted on\n"
                 "standard error. An OpenFilters project is written with its materials beside it.");
    set_run(*command, run, options, run_convert);
}

}  // namespace irido::cli
