#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/message.hpp"
#include "cli/options/list.hpp"
#include "cli/options/words.hpp"
#include "core/math/simd_level.hpp"
#include "schemas/documents/stack_document.hpp"
#include "tables/records/record_format.hpp"

namespace irido::cli {

/// What main runs once the command line is parsed; returns the exit status.
using Run = std::function<int()>;

/// Each command adds itself to the program and sets `run` when it is the one that was typed.
void add_spectrum_command(CLI::App& program, Run& run);
void add_color_command(CLI::App& program, Run& run);
void add_cm_command(CLI::App& program, Run& run);
void add_bands_command(CLI::App& program, Run& run);
void add_profile_command(CLI::App& program, Run& run);
void add_brdf_command(CLI::App& program, Run& run);
void add_scratches_command(CLI::App& program, Run& run);
void add_compare_command(CLI::App& program, Run& run);
/// `arguments` of the program: --compute decides which options there are. Throws UsageError.
void add_sweep_command(CLI::App& program, Run& run, std::span<char* const> arguments);
void add_lut_command(CLI::App& program, Run& run);
void add_render_command(CLI::App& program, Run& run);
void add_view_command(CLI::App& program, Run& run);
void add_plan_command(CLI::App& program, Run& run);
void add_bake_command(CLI::App& program, Run& run);
void add_materials_command(CLI::App& program, Run& run);
void add_validate_command(CLI::App& program, Run& run);
void add_convert_command(CLI::App& program, Run& run);
void add_design_command(CLI::App& program, Run& run);
void add_fit_command(CLI::App& program, Run& run);
void add_bench_command(CLI::App& program, Run& run);
void add_manual_command(CLI::App& program, Run& run);
void add_completion_command(CLI::App& program, Run& run);

/// Where a command's answer goes, as typed.
struct OutputOptions {
    std::string file;    ///< "" for standard output, typed as - or not at all
    std::string format;  ///< "" to follow the file's extension
};

/// --database
void add_database_option(CLI::App& command);

/// STACK, --set, --material, --reverse and --database.
void add_stack_options(CLI::App& command, schemas::StackRequest& request);

/// Reads the stack and says what is to be noted. Throws InputError.
schemas::StackDocument read_noted_stack(const schemas::StackRequest& request, bool quiet);

/// What a stack is called in a picture: its name, or what was typed.
std::string title_of(const schemas::StackDocument& document, const schemas::StackRequest& request);

/// -o and -f; `formats` as the help shows them, first their names with commas or "or" in between.
void add_output_options(CLI::App& command, OutputOptions& output, const std::string& formats);
/// -f alone.
void add_format_option(CLI::App& command, std::string& format, const std::string& formats);

/// Where records may go: any format, or those that standard output takes; or a picture of them.
enum class RecordTarget { any, stream, any_or_picture, stream_or_picture };

/// "csv, json or npy [csv]": what --format may be, for --help.
std::string record_formats_text(RecordTarget target = RecordTarget::stream);

/// -a
void add_angles_option(CLI::App& command, std::string& angles);

inline constexpr unsigned kMostThreads = 4096;

/// The number of threads of -j: a whole number from 1 on, of which kMostThreads are used. Throws
/// UsageError.
unsigned parse_threads(const std::string& text);

/// -j, and -j of a command that has no use for it.
void add_threads_option(CLI::App& command, unsigned& threads);
void add_threads_option(CLI::App& command);

/// The instruction set that the environment variable IRIDO_SIMD names: plain, baseline, avx2 or
/// avx512. Throws UsageError for any other name.
std::optional<SimdLevel> asked_simd_level();

/// The level itself, or the widest below it that this machine runs.
SimdLevel available_or_less(SimdLevel level);

/// How to run: with that instruction set, or the next lesser one that the machine has, or its best
/// one if none is named. Throws UsageError.
Execution execution_of(unsigned threads = 0);

/// What a LIST of the command line is.
inline constexpr std::string_view kListHelp =
    "v | start:stop:step | start:stop/count, or several of them with commas. The stop of\n"
    "start:stop:step is included where it lies on the grid, both ends of start:stop/count are.";

/// Whether an option of the command is a LIST.
bool takes_list(const CLI::App& command);

/// How the program's help pages look, and those of the commands that are added afterwards.
void set_help_pages(CLI::App& program);

/// The last lines of a help page, after `notes` if there are any.
void set_examples(CLI::App& command, const std::vector<std::string>& examples,
                  const std::string& notes = "");

/// The format's name as typed or as the file's extension says, "csv" if by neither. UsageError.
std::string resolved_format(const OutputOptions& output);

/// The record format of that name. Throws UsageError that names those which there are.
const tables::RecordFormat& resolved_record_format(const OutputOptions& output,
                                                   RecordTarget target = RecordTarget::stream);

/// Throws UsageError or OutputError if a file could not be written there: before a long
/// computation, and after the inputs are read, of which it must not be one.
void check_writable(const OutputOptions& output);

/// Throws UsageError or OutputError if a picture cannot be drawn into `plot` beside that output.
void check_plot(const std::optional<std::string>& plot, const OutputOptions& output);

/// Writes records to the file or to standard output.
void write_records(const tables::Records& records, const OutputOptions& output);

/// Writes bytes of a text or binary format to the file or to standard output.
void write_bytes(const std::string& bytes, const OutputOptions& output, bool is_binary);

}  // namespace irido::cli
