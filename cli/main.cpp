#include <algorithm>
#include <iostream>
#include <new>

#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/questions/question.hpp"
#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "schemas/nearest.hpp"
#include "tables/atomic_file.hpp"
#include "tables/version.hpp"

namespace {

using namespace irido;

constexpr int kCheckFailed = 1, kUsageOrInput = 2;

std::string version_text() {
    return "irido " + to_text(this_build()) + ", " + IRIDO_COMPILER + ", SIMD " +
           std::string(name_of(execution_of().simd));
}

int fail(const std::string& text, int status = kUsageOrInput) {
    std::string line = text;
    for (char& c : line)
        if (c == '\n') c = ' ';
    std::cerr << "irido: error: " << line << '\n';
    return status;
}

std::vector<std::string> names_of(const std::vector<CLI::App*>& commands) {
    std::vector<std::string> names(commands.size());
    std::ranges::transform(commands, names.begin(), [](CLI::App* c) { return c->get_name(); });
    return names;
}

/// The command typed at a place of the command line must be one of the parent's, and if that has
/// commands itself, so must the next. Throws UsageError.
void require_known(CLI::App& parent, int argc, char** argv, int place) {
    const std::vector<std::string> commands = names_of(parent.get_subcommands({}));
    const std::string typed = place < argc ? argv[place] : "";
    if (commands.empty() || typed.starts_with('-')) return;
    const std::string help = place == 1 ? "irido --help" : "irido " + parent.get_name() + " --help";
    if (typed.empty()) {
        if (place == 1) return;
        throw UsageError("a command must follow " + parent.get_name() + " (see " + help + ")");
    }
    if (std::ranges::find(commands, typed) == commands.end())
        throw UsageError("there is no command '" + typed + "'" + did_you_mean(typed, commands) +
                         " (see " + help + ")");
    require_known(*parent.get_subcommand(typed), argc, argv, place + 1);
}

int run_program(int argc, char** argv) {
    CLI::App program("What a stack of thin films does to light: spectra and colours.", "irido");
    program.require_subcommand(1);
    program.set_version_flag("--version", version_text, "version, commit, compiler and SIMD level");
    program.get_formatter()->column_width(26);
    Run run;
    add_spectrum_command(program, run);
    add_color_command(program, run);
    add_cm_command(program, run);
    add_bands_command(program, run);
    add_sweep_command(program, run, {argv, static_cast<std::size_t>(argc)});
    add_lut_command(program, run);
    add_plan_command(program, run);
    add_bake_command(program, run);
    add_materials_command(program, run);
    add_validate_command(program, run);
    add_bench_command(program, run);
    set_examples(program,
                 {"irido spectrum \"air | SiO2@100 | Si\" -w 380:780:5 -a 0,45 -p s,p",
                  "irido color \"air | TiO2@35 | Ti\" -a 0:80:10", "irido COMMAND --help"});
    require_known(program, argc, argv, 1);
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& done) {  // --help, --version
        return program.exit(done);
    } catch (const CLI::ParseError& error) {
        const std::string typed = argc > 1 && argv[1][0] != '-' ? argv[1] + std::string(" ") : "";
        return fail(std::string(error.what()) + " (see irido " + typed + "--help)");
    }
    return run();
}

}  // namespace

int main(int argc, char** argv) {
    handle_signals();
    try {
        return run_program(argc, argv);
    } catch (const BrokenPipe&) {
        return 0;
    } catch (const CheckFailed& error) {
        return fail(error.what(), kCheckFailed);
    } catch (const std::bad_alloc&) {
        return fail("not enough memory for this request");
    } catch (const std::exception& error) {  // UsageError, InputError, DomainError, OutputError
        return fail(error.what());
    }
}
