#include <algorithm>
#include <filesystem>
#include <memory>

#include "cli/options/command.hpp"
#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/stack_expression.hpp"
#include "tables/files/atomic_file.hpp"

namespace irido::cli {

namespace {

using nlohmann::json;

struct ConvertCommand {
    schemas::StackRequest stack;
    OutputOptions output;
    bool quiet = false;
};

enum class StackFormat { document, expression };

StackFormat resolved_stack_format(const OutputOptions& output) {
    const bool is_default = output.format.empty() && output.file.empty();
    const std::string name = is_default ? "json" : resolved_format(output);
    if (name == "json") return StackFormat::document;
    if (name == "expression" || (output.format.empty() && name == "txt"))
        return StackFormat::expression;
    if (output.format.empty())
        throw UsageError("--output: the extension must be json, or txt for an expression (got " +
                         name + ")");
    throw UsageError("--format: must be one of json, expression (got " + name + ")");
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

/// The layers from the other side. Throws InputError for layers that are not the same from there.
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

/// The document with its stack from the other side.
void reverse(schemas::StackSource& source) {
    nlohmann::json& document = source.document;
    if (document.contains("substrate_roughness_nm"))
        throw schemas::InputError(
            source.file, "", "substrate_roughness_nm cannot be written with --reverse as JSON");
    std::swap(document["incident"], document["substrate"]);
    if (document.contains("layers")) reverse_layers(document["layers"], source.file);
}

int run_convert(const ConvertCommand& command) {
    const StackFormat format = resolved_stack_format(command.output);
    schemas::StackSource source = schemas::load_stack(command.stack);
    const schemas::StackDocument document = schemas::read_source(source);
    for (const std::string& text : document.notes) note(text, command.quiet);
    if (source.reverse && format == StackFormat::document) reverse(source);
    const std::string text = format == StackFormat::document
                                 ? as_json(std::move(source), command.output.file)
                                 : as_expression(document, command.quiet);
    write_bytes(text, command.output, false);
    return 0;
}

}  // namespace

void add_convert_command(CLI::App& program, Run& run) {
    CLI::App* command =
        program.add_subcommand("convert", "Convert a stack to JSON or to an expression.");
    const auto options = std::make_shared<ConvertCommand>();
    add_stack_options(*command, options->stack);
    add_output_options(*command, options->output,
                       "json, or expression (files: .json, .txt) [json]");
    command->add_flag("--quiet", options->quiet, "no notes on standard error");
    set_examples(*command,
                 {"irido convert \"air | (TiO2@58.5 | SiO2@94.2)^10 | BK7@1mm! | air\"",
                  "irido convert stack.json -f expression",
                  "irido convert stack.json --set substrate=Si -o on-silicon.json"},
                 "Paths of material files become relative to FILE. What an expression cannot hold\n"
                 "(thickness_sigma_nm; materials that are neither built in, nor files, nor\n"
                 "constant) is noted on standard error.");
    command->callback([options, &run] { run = [options] { return run_convert(*options); }; });
}

}  // namespace irido::cli
