#include <new>

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

int run_command_line(int argc, char** argv) {
    CLI::App program("Spectra, colours and look-up tables of thin-film stacks.", "irido");
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
    add_convert_command(program, run);
    add_bench_command(program, run);
    set_examples(program,
                 {"irido spectrum \"air | SiO2@100 | Si\" -w 380:780:5 -a 0,45 -p s,p",
                  "irido color \"air | TiO2@35 | Ti\" -a 0:80:10", "irido COMMAND --help"});
    add_missing_options(program);
    check_command_line(program, {argv, static_cast<std::size_t>(argc)});
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& done) {  // --help, --version
        return program.exit(done);
    } catch (const CLI::ParseError& error) {  // beside --help
        return fail(error.what());
    }
    note_fallbacks(program);
    return run();
}

}  // namespace

int main(int argc, char** argv) {
    handle_signals();
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
