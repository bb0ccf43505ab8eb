#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <new>
#include <sstream>

#include "cli/exit_status.hpp"
#include "cli/interrupt.hpp"
#include "cli/options/command.hpp"
#include "cli/options/command_line.hpp"
#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "tables/files/atomic_file.hpp"
#include "tables/version.hpp"

namespace {

using namespace irido;
using namespace irido::cli;

std::string version_text() {
    return "irido " + tables::version_text(tables::this_build()) + ", " + IRIDO_COMPILER +
           ", SIMD " + std::string(name_of(execution_of().simd));
}

int fail(const std::string& text, int status = kBadInput) {
    print_error(text);
    return status;
}

/// Keeps the memory of a block of rows for the next one: allocating it anew costs a page fault for
/// every 4 KB, more than computing what goes into it.
void keep_freed_memory() {
    constexpr int kMostBlock = 1 << 25, kMostKept = 1 << 28;  // of one block, that of glibc
    mallopt(M_MMAP_THRESHOLD, kMostBlock);
    mallopt(M_TRIM_THRESHOLD, kMostKept);
}

/// Adds the command given on the command line, or all commands if there is none: building all of
/// them takes half of a short run.
void add_commands(CLI::App& program, Run& run, std::span<char* const> words) {
    struct Command {
        std::string_view name;
        std::function<void()> add;
    };
    const auto simple = [&](void (*add)(CLI::App&, Run&)) {
        return [&program, &run, add] { add(program, run); };
    };
    const std::array commands{
        Command{"spectrum", simple(add_spectrum_command)},
        Command{"color", simple(add_color_command)},
        Command{"cm", simple(add_cm_command)},
        Command{"bands", simple(add_bands_command)},
        Command{"profile", simple(add_profile_command)},
        Command{"brdf", simple(add_brdf_command)},
        Command{"scratches", simple(add_scratches_command)},
        Command{"compare", simple(add_compare_command)},
        Command{"sweep", [&] { add_sweep_command(program, run, words); }},
        Command{"lut", simple(add_lut_command)},
        Command{"render", simple(add_render_command)},
        Command{"view", simple(add_view_command)},
        Command{"plan", simple(add_plan_command)},
        Command{"bake", simple(add_bake_command)},
        Command{"materials", simple(add_materials_command)},
        Command{"validate", simple(add_validate_command)},
        Command{"convert", simple(add_convert_command)},
        Command{"design", simple(add_design_command)},
        Command{"fit", simple(add_fit_command)},
        Command{"bench", simple(add_bench_command)},
    };
    if (words.size() == 2 && std::string_view(words[1]) == "--version") return;
    const auto typed =
        words.size() < 2 ? commands.end() : std::ranges::find(commands, words[1], &Command::name);
    if (typed != commands.end()) return typed->add();
    for (const Command& command : commands) command.add();
    add_manual_command(program, run);  // describes all the others
    add_completion_command(program, run);
}

/// Descriptors 0 to 2 that the caller has closed stay unusable: else a file that is opened later
/// would take their place, and messages would go into it.
void occupy_standard_descriptors() {
    for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor)
        if (fcntl(descriptor, F_GETFD) < 0)  // open() takes the lowest one that is free
            (void)open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

int run_command_line(int argc, char** argv) {
    CLI::App program("Spectra, colours and look-up tables of thin-film stacks.", "irido");
    program.require_subcommand(1);
    program.set_version_flag("--version", version_text, "version, commit, compiler and SIMD level");
    set_help_pages(program);
    Run run;
    const std::span<char* const> words(argv, static_cast<std::size_t>(argc));
    add_commands(program, run, words);
    set_examples(
        program,
        {"irido spectrum \"air | SiO2@100 | Si\" -w 380:780:5 -a 0,45 -p s,p",
         "irido color \"air | TiO2@35 | Ti\" -a 0:80:10", "irido COMMAND --help"},
        "A STACK is a file (.json), - for standard input, or an expression: media from the\n"
        "incident side, with thicknesses in nm after @, such as\n"
        "    \"air | (TiO2@58.5 | 1.46@94.2)^10 | BK7\"\n"
        "(irido materials list names materials). Rows go to standard output, or with -o to a\n"
        "file, whose extension sets the format. Each command has a page of its own: irido\n"
        "COMMAND --help, or man irido-COMMAND.\n\n"
        "A LIST, of wavelengths with -w and of angles with -a, is\n" +
            std::string(kListHelp));
    add_missing_options(program);
    check_command_line(program, words);
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& done) {  // --help, --version
        std::ostringstream text;
        const int status = program.exit(done, text, text);
        tables::write_stdout(text.view());
        return status;
    } catch (const CLI::ParseError& error) {  // beside --help
        return fail(error.what());
    }
    note_fallbacks(program);
    return run();
}

}  // namespace

int main(int argc, char** argv) {
    occupy_standard_descriptors();
    handle_signals();
    keep_freed_memory();
    try {
        return run_command_line(argc, argv);
    } catch (const tables::BrokenPipe&) {
        return 0;
    } catch (const CheckFailed& error) {
        return fail(error.what(), kCheckFailed);
    } catch (const std::bad_alloc&) {
        return fail("not enough memory for this request");
    } catch (const std::exception& error) {  // UsageError, InputError, DomainError, OutputError
        return fail(error.what());
    }
}
