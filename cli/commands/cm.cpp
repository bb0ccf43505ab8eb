#include <memory>

#include "cli/options/command.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/queries/cm_query.hpp"

namespace irido::cli {

namespace {

struct CmCommand {
    schemas::StackRequest stack;
    std::unique_ptr<QueryOptions> typed;
    OutputOptions output;
    bool quiet = false;
};

int run_cm(const CmCommand& command) {
    const tables::PictureFormat* const picture = asked_picture(command.output);
    if (!picture) resolved_record_format(command.output, RecordTarget::stream_or_picture);
    const auto query = command.typed->parse({});
    const auto prepared = query->prepare(read_noted_stack(command.stack, command.quiet));
    const tables::Records rows = records_of(*query, *prepared);
    if (!picture) {
        write_records(rows, command.output);
        return 0;
    }
    const auto figure = [&] {
        return figure_of_rows(*query, rows, {}, title_of(prepared->document, command.stack), {},
                              [&](const std::string& text) { note(text, command.quiet); });
    };
    write_picture(figure, {}, *picture, command.output);
    return 0;
}

}  // namespace

void add_cm_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "cm", "Fourier series of a film's fringes: C_m, optical path difference and phase.");
    const auto options = std::make_shared<CmCommand>();
    add_stack_options(*command, options->stack);
    options->typed = CmOptions::add(*command);
    add_output_options(*command, options->output,
                       record_formats_text(RecordTarget::stream_or_picture));
    add_quiet_option(*command, options->quiet);
    set_examples(*command,
                 {"irido cm \"air | 1.42@400 | 1.87+1.182i\" -a 0,50 --orders 0:2:1",
                  "irido cm \"air | SiO2@300 | Si\" -a 0:80:20 -p s --side R,T --at 600",
                  "irido cm \"air | 1.42@400 | 1.87+1.182i\" -a 50 --orders 0:8:1 -o cm.svg"},
                 "STACK is one film of real index over any base. With opd_nm = D, phi_rad = phi\n"
                 "and the vacuum wavelength L in nm,\n"
                 "    R (or T) = C_0 + 2 sum over m of C_m cos(m (2 pi D / L + phi)).\n"
                 "thickness_sigma_nm is ignored.");
    set_run(*command, run, options, run_cm);
}

}  // namespace irido::cli
