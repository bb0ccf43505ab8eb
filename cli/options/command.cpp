#include "cli/options/command.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "cli/options/picture_options.hpp"
#include "core/error.hpp"
#include "schemas/readers/material_database.hpp"
#include "schemas/readers/number.hpp"
#include "schemas/readers/stack_expression.hpp"
#include "tables/files/atomic_file.hpp"

namespace irido::cli {

void add_stack_options(CLI::App& command, schemas::StackRequest& request) {
    command
        .add_option("STACK", request.stack,
                    "stack file (.json; see irido validate --schema), - for\n"
                    "standard input, or an expression: media from the incident\n"
                    "side (built-in materials, material files, indices), @ and\n"
                    "the thickness after each layer (in nm, or with um or mm),\n"
                    "! after an incoherent one:\n"
                    "\"air | (TiO2@58.5 | 1.46@94.2)^10 | BK7@1mm! | 1.9+1.5i\"")
        ->required();
    command
        .add_option("--set", request.set,
                    "override a value of the stack by dotted path; repeatable:\n"
                    "--set layers.0.thickness_nm=400 --set substrate=Si")
        ->type_name("PATH=VALUE")
        ->allow_extra_args(false);
    command
        .add_option("--material", request.media,
                    "name a medium of the stack: an index, a built-in material, a\n"
                    "material file or a JSON material; repeatable:\n"
                    "--material H=2.35 --material L=SiO2")
        ->type_name("NAME=MATERIAL")
        ->allow_extra_args(false);
    command
        .add_option("--reference", request.reference_nm,
                    "reference wavelength, nm, of layers in quarter waves, as in\n"
                    "\"air | (H@1Q | L@1Q)^8 | BK7\"")
        ->type_name("NM");
    command.add_flag("--reverse", request.reverse,
                     "light from the substrate's side, angles in the substrate, which must\n"
                     "be transparent; paths are those of the stack as it is written");
    add_database_option(command);
}

void add_database_option(CLI::App& command) {
    command
        .add_option_function<std::string>(
            "--database", [](const std::string& folder) { schemas::use_material_database(folder); },
            "folder of a copy of the refractiveindex.info database, whose pages are\n"
            "materials: rii:main/Ag/Johnson [IRIDO_MATERIALS]")
        ->type_name("DIR");
}

schemas::StackDocument read_noted_stack(const schemas::StackRequest& request, bool quiet) {
    schemas::StackDocument document = schemas::read_stack(request);
    for (const std::string& text : document.notes) note(text, quiet);
    return document;
}

std::string title_of(const schemas::StackRequest& request, const std::vector<std::string>& varied) {
    if (request.stack.find('|') == std::string::npos) return request.stack;
    std::vector<std::pair<std::string, std::string>> values;
    for (const std::string& text : request.set) {
        const std::size_t equals = text.find('=');
        values.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
    for (const std::string& path : varied) values.emplace_back(path, "\u2026");
    return schemas::expression_with(request.stack, values);
}

std::string title_of(const schemas::StackDocument& document, const schemas::StackRequest& request,
                     const std::vector<std::string>& varied) {
    return document.name.empty() ? title_of(request, varied) : document.name;
}

namespace {

/// Extracts the names from "csv, json or svg: a strip of the colours [csv]".
std::vector<std::string> names_before_notes(std::string formats) {
    formats.resize(std::min(formats.size(), formats.find_first_of(":([")));
    std::ranges::replace(formats, ',', ' ');
    std::istringstream stream(formats);
    std::vector<std::string> names(std::istream_iterator<std::string>(stream), {});
    std::erase(names, "or");
    return names;
}

}  // namespace

void add_output_options(CLI::App& command, OutputOptions& output, const std::string& formats,
                        const std::string& otherwise) {
    command
        .add_option_function<std::string>(
            "-o,--output",
            [&output](const std::string& file) { output.file = file == "-" ? "" : file; },
            "write to FILE (whole or not at all); the format follows the\n"
            "extension; - is standard output" +
                otherwise)
        ->type_name("FILE");
    add_format_option(command, output.format, formats);
}

void add_format_option(CLI::App& command, std::string& format, const std::string& formats) {
    command.add_option("-f,--format", format, formats)->type_name("FORMAT");
    offer(command, "format", [formats] { return names_before_notes(formats); });
}

namespace {

std::vector<std::string_view> names_of_formats(RecordTarget target) {
    const bool is_any = target == RecordTarget::any || target == RecordTarget::any_or_picture;
    std::vector<std::string_view> names;
    for (const tables::RecordFormat* const format : tables::record_formats())
        if (!format->finish || is_any) names.push_back(format->name);
    if (target == RecordTarget::any_or_picture || target == RecordTarget::stream_or_picture)
        for (const tables::PictureFormat* const format : tables::picture_formats())
            names.push_back(format->name);
    return names;
}

}  // namespace

std::string record_formats_text(RecordTarget target) {
    const std::vector<std::string_view> names = names_of_formats(target);
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text.append(i == 0 ? "" : i + 1 == names.size() ? " or " : ", ").append(names[i]);
    return text + " [csv]";
}

void add_angles_option(CLI::App& command, std::string& angles) {
    command
        .add_option("-a,--angles", angles,
                    "angles of incidence in the incident medium, degrees, [0, 90] [0]")
        ->type_name("LIST");
}

void add_polarizations_option(CLI::App& command, std::string& polarizations) {
    command
        .add_option("-p,--polarization", polarizations,
                    "s, p, u (unpolarized: the mean of both) or several: s,p [u]")
        ->type_name("LETTERS");
    offer(command, "polarization", "s p u", OfferedWords::Use::several);
}

void add_s_and_p_option(CLI::App& command, std::string& polarizations) {
    command.add_option("-p,--polarization", polarizations, "s, p or s,p [s,p]")
        ->type_name("LETTERS");
    offer(command, "polarization", "s p", OfferedWords::Use::several);
}

unsigned parse_threads(const std::string& text) {
    const double typed = schemas::parse_number(text).value_or(0);
    if (typed > kMostThreads) return kMostThreads;
    return static_cast<unsigned>(parse_whole_number("--threads", text, 1, kMostThreads));
}

void add_threads_option(CLI::App& command, unsigned& threads) {
    command
        .add_option_function<std::string>(
            "-j,--threads", [&threads](const std::string& text) { threads = parse_threads(text); },
            "number of threads [all cores]; does not affect the result")
        ->type_name("N");
}

void add_threads_option(CLI::App& command) {
    command
        .add_option_function<std::string>(
            "-j,--threads", [](const std::string& text) { parse_threads(text); },
            "accepted for uniformity: this command runs on one thread")
        ->type_name("N");
}

void add_quiet_option(CLI::App& command, bool& quiet, const std::string& what) {
    command.add_flag("--quiet", quiet, what + " on standard error");
}

void add_quiet_option(CLI::App& command) {
    command.add_flag_function(
        "--quiet", [](std::int64_t) {}, "no notes on standard error");
}

std::optional<SimdLevel> asked_simd_level() {
    const char* const name = std::getenv("IRIDO_SIMD");
    if (!name || !*name) return std::nullopt;
    std::vector<std::string_view> names;
    for (const SimdLevel level : kSimdLevels) {
        names.push_back(name_of(level));
        if (names.back() == name) return level;
    }
    throw UsageError("IRIDO_SIMD: " + not_one_of(names, name));
}

SimdLevel available_or_less(SimdLevel level) {
    while (!is_available(level)) level = static_cast<SimdLevel>(static_cast<int>(level) - 1);
    return level;
}

Execution execution_of(unsigned threads) {
    const std::optional<SimdLevel> asked = asked_simd_level();
    return asked ? Execution(threads, available_or_less(*asked)) : Execution(threads);
}

void set_examples(CLI::App& command, const std::vector<std::string>& examples,
                  const std::string& notes) {
    std::string text = notes.empty() ? "Examples:" : notes + "\n\nExamples:";
    for (const std::string& example : examples) text += "\n  " + example;
    command.footer(text);
}

bool is_nameless(const OutputOptions& output) {
    return output.file.empty() || output.file.starts_with("/dev/");
}

std::string resolved_format(const OutputOptions& output) {
    if (!output.format.empty()) return output.format == "hdf5" ? "h5" : output.format;
    const std::size_t slash = output.file.find_last_of('/');
    const std::size_t dot = output.file.find_last_of('.');
    if (is_nameless(output)) return "csv";
    std::error_code ignored;
    if (output.file.ends_with('/') || std::filesystem::is_directory(output.file, ignored))
        throw UsageError(output.option + ": must name a file, not a folder (got '" + output.file +
                         "')");
    if (dot == std::string::npos || (slash != std::string::npos && dot < slash))
        throw UsageError(output.option +
                         ": must have an extension that names the format, or use --format (got '" +
                         output.file + "')");
    const std::string extension = output.file.substr(dot + 1);
    return extension == "hdf5" ? "h5" : extension;
}

const tables::RecordFormat& resolved_record_format(const OutputOptions& output,
                                                   RecordTarget target) {
    const std::string name = resolved_format(output);
    const std::vector<std::string_view> names = names_of_formats(target);
    const tables::RecordFormat* const format = tables::find_record_format(name);
    if (format && std::ranges::count(names, name) > 0) return *format;
    throw UsageError((output.format.empty() ? output.option + ": the extension " : "--format: ") +
                     not_one_of(names, name));
}

void check_writable(const OutputOptions& output) {
    if (output.file.empty()) return;
    const std::filesystem::path folder = std::filesystem::path(output.file).parent_path();
    const std::string name = folder.empty() ? "." : folder.string();
    if (access(name.c_str(), W_OK | X_OK) != 0)
        throw UsageError(output.file + ": cannot be written: " + std::strerror(errno));
    tables::check_outputs({output.file});
}

void check_plot(const std::optional<std::string>& plot, const OutputOptions& output) {
    if (!plot) return;
    picture_format_of("--plot", *plot);
    check_writable({*plot, ""});
    if (!output.file.empty()) tables::check_outputs({output.file, *plot});
}

void write_records(const tables::Records& records, const OutputOptions& output) {
    const tables::RecordFormat& format = resolved_record_format(output);
    write_bytes(tables::written(format, records), output, format.is_binary);
}

void write_bytes(const std::string& bytes, const OutputOptions& output, bool is_binary) {
    if (!output.file.empty()) return tables::write_file(output.file, bytes);
    if (is_binary) tables::check_binary_stdout();
    tables::write_stdout(bytes);
}

}  // namespace irido::cli
