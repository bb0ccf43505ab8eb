#include <iostream>
#include <memory>

#include "cli/options/command.hpp"
#include "cli/options/long_work.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/queries/spectrum_query.hpp"
#include "tables/resume/record_stream.hpp"

namespace irido::cli {

namespace {

struct SpectrumCommand {
    schemas::StackRequest stack;
    std::unique_ptr<QueryOptions> typed;
    OutputOptions output;
    unsigned threads = 0;
    bool stats = false;
    bool quiet = false;
};

/// Writes rows block by block, or draws all of them.
void write_rows(const SpectrumCommand& command, const SpectrumQuery& query,
                const schemas::StackDocument& document,
                const std::function<void(const std::string&)>& say) {
    const tables::RecordLayout layout = query.layout(document);
    if (const auto* picture = asked_picture(command.output)) {
        check_writable(command.output);
        note_long_work(seconds_of_rows(query, document, command.threads), false, say);
        tables::Records all;
        query.each_block(document, [&](const tables::Records& rows) { all.append(rows); });
        const std::string title = title_of(document, command.stack);
        write_picture([&] { return figure_of_rows(query, all, {}, title, {}, say); }, {}, *picture,
                      command.output);
        return;
    }
    const tables::RecordFormat& format = resolved_record_format(command.output);
    const auto stream = tables::counted_output(command.output.file, format, layout, query.rows());
    note_long_work(seconds_of_rows(query, document, command.threads), false, say);
    query.each_block(document, [&](const tables::Records& rows) {
        stream->append(format.rows(layout, rows), 0, rows.rows());
    });
    stream->finish();
}

int run_spectrum(const SpectrumCommand& command) {
    if (!asked_picture(command.output))
        resolved_record_format(command.output, RecordTarget::stream_or_picture);
    const auto say = [&](const std::string& text) { note(text, command.quiet); };
    const SpectrumQuery query(static_cast<const SpectrumOptions&>(*command.typed),
                              {.execution = execution_of(command.threads), .note = say});
    const schemas::StackDocument document = read_noted_stack(command.stack, command.quiet);
    write_rows(command, query, document, say);
    if (command.stats)
        for (const std::string& line : query.stats(*query.prepare(document)))
            std::cerr << "irido: stats: " << line << '\n';
    return 0;
}

}  // namespace

void add_spectrum_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "spectrum", "Reflectance, transmittance and absorptance of a stack (R, T, A).");
    const auto options = std::make_shared<SpectrumCommand>();
    add_stack_options(*command, options->stack);
    options->typed = SpectrumOptions::add(*command);
    add_output_options(*command, options->output,
                       record_formats_text(RecordTarget::stream_or_picture));
    add_threads_option(*command, options->threads);
    command->add_flag("--stats", options->stats,
                      "report on standard error how it was computed and what was skipped");
    add_quiet_option(*command, options->quiet);
    set_examples(*command,
                 {"irido spectrum \"air | SiO2@100 | Si\" -w 380:780:5 -a 0,45 -p s,p",
                  "irido spectrum \"air | SiO2@25 | Si\" -a 70 -p s --columns psi_deg,delta_deg",
                  "irido spectrum stack.json --set layers.0.thickness_nm=420 -o out.npy",
                  "irido spectrum \"air | MgF2@100 | BK7\" -a 0,45 -p s,p -o r.svg"});
    set_run(*command, run, options, run_spectrum);
}

}  // namespace irido::cli
