#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
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

/// Runs a parsed command; returns the exit status.
using Run = std::function<int()>;

/// Each command adds itself to the program and sets `run` if it is selected on the command line.
void add_spectrum_command(CLI::App& program, Run& run);
void add_color_command(CLI::App& program, Run& run);
void add_cm_command(CLI::App& program, Run& run);
void add_bands_command(CLI::App& program, Run& run);
void add_profile_command(CLI::App& program, Run& run);
void add_brdf_command(CLI::App& program, Run& run);
void add_scratches_command(CLI::App& program, Run& run);
void add_compare_command(CLI::App& program, Run& run);
/// `arguments` of the program: --compute determines the available options. Throws UsageError.
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

/// Makes `run` call `work` with the options if the command is selected.
template <class Options>
void set_run(CLI::App& command, Run& run, const std::shared_ptr<Options>& options,
             int (*work)(const Options&)) {
    command.callback([&run, options, work] { run = [options, work] { return work(*options); }; });
}

/// Destination of a command's output, as given on the command line.
struct OutputOptions {
    std::string file;                 ///< "" for standard output, given as - or by default
    std::string format;               ///< "" to use the file's extension
    std::string option = "--output";  ///< that names the file, for messages
};

/// --database
void add_database_option(CLI::App& command);

/// STACK, --set, --material, --reverse and --database.
void add_stack_options(CLI::App& command, schemas::StackRequest& request);

/// Reads the stack and prints its notes. Throws InputError.
schemas::StackDocument read_noted_stack(const schemas::StackRequest& request, bool quiet);

/// The title of a stack in a picture: its name, or the file or expression as typed, with the values
/// of --set and an ellipsis for the values at `varied` paths.
std::string title_of(const schemas::StackDocument& document, const schemas::StackRequest& request,
                     const std::vector<std::string>& varied = {});
std::string title_of(const schemas::StackRequest& request,
                     const std::vector<std::string>& varied = {});

/// Adds -o and -f.
/// formats    for the help; begins with their names, separated by commas or "or"
/// otherwise  for the help: what applies without -o
void add_output_options(CLI::App& command, OutputOptions& output, const std::string& formats,
                        const std::string& otherwise = " [-]");
/// Adds -f alone.
void add_format_option(CLI::App& command, std::string& format, const std::string& formats);

/// Where records may go: any format, or those possible on standard output; or a picture of them.
enum class RecordTarget { any, stream, any_or_picture, stream_or_picture };

/// "csv, json or npy [csv]": the values of --format, for --help.
std::string record_formats_text(RecordTarget target = RecordTarget::stream);

/// -a
void add_angles_option(CLI::App& command, std::string& angles);

/// -p: several of s, p and u; or s, p or both.
void add_polarizations_option(CLI::App& command, std::string& polarizations);
void add_s_and_p_option(CLI::App& command, std::string& polarizations);

inline constexpr unsigned kMostThreads = 4096;

/// Parses the number of threads of -j: a whole number of at least 1, limited to kMostThreads.
/// Throws UsageError.
unsigned parse_threads(const std::string& text);

/// Adds -j, or a -j that is ignored, for commands without threads.
void add_threads_option(CLI::App& command, unsigned& threads);
void add_threads_option(CLI::App& command);

/// Adds --quiet, which leaves `what` out, or a --quiet that is ignored, for commands without notes.
void add_quiet_option(CLI::App& command, bool& quiet, const std::string& what = "no notes");
void add_quiet_option(CLI::App& command);

/// The instruction set named by the environment variable IRIDO_SIMD: plain, baseline, avx2 or
/// avx512. Throws UsageError for any other name.
std::optional<SimdLevel> asked_simd_level();

/// The level itself, or the highest one below it that this machine supports.
SimdLevel available_or_less(SimdLevel level);

/// Threads and instruction set: the one requested or the next lower one that the machine supports;
/// its best one by default. Throws UsageError.
Execution execution_of(unsigned threads = 0);

/// Explanation of LIST on help pages.
inline constexpr std::string_view kListHelp =
    "v | start:stop:step | start:stop/count, or several of them with commas. The stop of\n"
    "start:stop:step is included where it lies on the grid, both ends of start:stop/count are.";

/// Whether an option of the command is a LIST.
bool takes_list(const CLI::App& command);

/// Characters of a line that explains an option, and of one of the notes below the options.
inline constexpr std::size_t kHelpWidth = 71, kHelpNotesWidth = 84;

/// Breaks lines at blanks, but not inside [brackets]; line breaks of the text stay.
std::string wrapped(const std::string& text, std::size_t width);

/// Sets the style of help pages for the program and for commands added later.
void set_help_pages(CLI::App& program);

/// Sets the last lines of a help page, after `notes` if there are any.
void set_examples(CLI::App& command, const std::vector<std::string>& examples,
                  const std::string& notes = "");

/// Whether the output is standard output or a device, whose name says no format.
bool is_nameless(const OutputOptions& output);

/// The format given or implied by the file's extension, else "csv". Throws UsageError.
std::string resolved_format(const OutputOptions& output);

/// The record format of that name. Throws UsageError, which lists the available ones.
const tables::RecordFormat& resolved_record_format(const OutputOptions& output,
                                                   RecordTarget target = RecordTarget::stream);

/// Throws UsageError or OutputError if the output could not be written. Call it before a long
/// computation, but after reading the inputs, since the output must not be one of them.
void check_writable(const OutputOptions& output);

/// Throws UsageError or OutputError if a picture cannot be drawn into `plot` in addition to that
/// output.
void check_plot(const std::optional<std::string>& plot, const OutputOptions& output);

/// Writes records to the file or to standard output.
void write_records(const tables::Records& records, const OutputOptions& output);

/// Writes the bytes of a text or binary format to the file or to standard output.
void write_bytes(const std::string& bytes, const OutputOptions& output, bool is_binary);

}  // namespace irido::cli
