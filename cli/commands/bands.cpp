#include <algorithm>
#include <map>
#include <memory>
#include <numbers>

#include "cli/options/command.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/queries/bands_query.hpp"
#include "core/error.hpp"
#include "core/keep_once.hpp"
#include "core/math/constants.hpp"
#include "schemas/input_error.hpp"
#include "tables/files/atomic_file.hpp"
#include "tables/pictures/band_figure.hpp"

namespace irido::cli {

namespace {

struct BandsCommand {
    schemas::StackRequest stack;
    std::unique_ptr<QueryOptions> typed;
    std::optional<std::string> plot;
    OutputOptions output;
    bool quiet = false;
};

tables::BandDiagram::Edges wavelengths_of(const BandGap& gap) {
    return {kTwoPi / gap.high_per_nm, kTwoPi / gap.low_per_nm};
}

tables::Figure diagram_of(const BandsQuery& query, const BraggMirror& mirror,
                          const std::string& title) {
    const std::span<const double> angles = query.angles_deg();
    tables::BandDiagram diagram{
        title, query.first_nm(), query.last_nm(), {angles.begin(), angles.end()}, {}};
    keep_once(diagram.angles_deg);
    constexpr std::array kBoth{Polarization::s, Polarization::p};
    std::map<double, tables::BandDiagram::Gap> gaps;
    for (const double angle_deg : diagram.angles_deg)
        for (const Polarization p : kBoth)
            for (const BandGap& gap : band_gaps(mirror.period_at(angle_deg, p), query.omega()))
                gaps[gap.order].order = gap.order;
    for (auto& [order, gap] : gaps) {
        for (const double angle_deg : diagram.angles_deg) {
            gap.s.push_back(wavelengths_of(band_gap(mirror.period_at(angle_deg, kBoth[0]), order)));
            gap.p.push_back(wavelengths_of(band_gap(mirror.period_at(angle_deg, kBoth[1]), order)));
        }
        diagram.gaps.push_back(std::move(gap));
    }
    return tables::band_figure(diagram);
}

tables::Figure diagram_of(const BandsQuery& query, const schemas::StackDocument& document,
                          const std::string& title) {
    try {
        return diagram_of(query, query.mirror(document, document.stack), title);
    } catch (const DomainError& error) {
        throw schemas::InputError(document.file, "", error.what());
    }
}

int run_bands(const BandsCommand& command) {
    const tables::PictureFormat* const picture = asked_picture(command.output);
    if (!picture) resolved_record_format(command.output, RecordTarget::stream_or_picture);
    const auto say = [&](const std::string& text) { note(text, command.quiet); };
    const auto& typed = static_cast<const BandsOptions&>(*command.typed);
    const BandsQuery query(typed, {.note = say});
    const auto [least, most] = std::ranges::minmax(query.angles_deg());
    if (command.plot && least == most)
        throw UsageError("--plot: requires several angles, such as --angles 0:89:1");
    const auto prepared = query.prepare(read_noted_stack(command.stack, command.quiet));
    check_plot(command.plot, command.output);
    const tables::Records records = records_of(query, *prepared);
    const std::string title = title_of(prepared->document, command.stack);
    const auto diagram = [&] { return diagram_of(query, prepared->document, title); };
    std::string drawn;
    if (command.plot)
        drawn =
            picture_bytes(diagram, {}, picture_format_of("--plot", *command.plot), *command.plot);
    if (!picture) {
        write_records(records, command.output);
    } else if (typed.gaps && least < most) {
        write_picture(diagram, {}, *picture, command.output);
    } else {
        write_picture([&] { return figure_of_rows(query, records, {}, title, {}, say); }, {},
                      *picture, command.output);
    }
    if (command.plot) tables::write_file(*command.plot, drawn);
    return 0;
}

}  // namespace

void add_bands_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "bands", "Landmarks and gaps of a Bragg mirror: modes, band edges, Airy points, zeros.");
    const auto options = std::make_shared<BandsCommand>();
    add_stack_options(*command, options->stack);
    options->typed = BandsOptions::add(*command);
    command
        ->add_option("--plot", options->plot,
                     "draw the gaps over angle and wavelength into FILE (.svg, .png or\n"
                     ".pdf); requires several angles")
        ->type_name("FILE");
    add_output_options(*command, options->output,
                       record_formats_text(RecordTarget::stream_or_picture));
    add_quiet_option(*command, options->quiet);
    set_examples(
        *command,
        {"irido bands \"1 | (1@200 | 1.5@180)^10 | 1\" -a 20 -p p",
         "irido bands \"air | (TiO2@58.5 | SiO2@94.2)^10 | BK7\" -a 0:85:1 --gaps "
         "--plot bands.svg"},
        "STACK contains one repeated group of two transparent layers, alone or among other\n"
        "layers; landmarks are those of the infinitely repeated group. With a and b the phases\n"
        "across its layers and KL the Bloch phase across both,\n"
        "    mode m  a + b = m pi      edge m  both ends of the gap around mode m\n"
        "    zero z  b = z pi          airy m  cos(KL) = 0 between the modes m and m + 1.\n"
        "Closed gaps have two equal edges. Indices are taken at each landmark's own wavelength\n"
        "(beyond a material's range, edges of a gap use its end values). k up to 0.1 and\n"
        "thickness_sigma_nm are ignored for landmarks, but not for R. An angle past the\n"
        "critical angle of a layer is an error, and so is dispersion so anomalous that the\n"
        "phase of a layer grows with the wavelength.");
    set_run(*command, run, options, run_bands);
}

}  // namespace irido::cli
