#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "cli/command.hpp"
#include "core/error.hpp"
#include "core/interference/bragg_mirror.hpp"
#include "schemas/input_error.hpp"
#include "tables/atomic_file.hpp"
#include "tables/formats/band_diagram.hpp"

namespace irido {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

struct BandsOptions {
    StackRequest stack;
    std::string angles = "0";
    std::string polarization = "s,p";
    std::string range = "360:830";
    bool gaps = false;
    std::optional<std::string> plot;
    OutputOptions output;
    bool quiet = false;
};

/// What was asked, in values.
struct BandsRequest {
    std::vector<double> angles_deg;
    std::vector<Polarization> polarizations;
    double first_nm, last_nm;

    /// A little wider than asked, against the roundings of 2 pi / wavelength.
    OmegaRange omega() const {
        return {kTurn / last_nm * (1 - 1e-15), kTurn / first_nm * (1 + 1e-15)};
    }
    bool contains(double wavelength_nm) const {
        return wavelength_nm >= first_nm && wavelength_nm <= last_nm;
    }
};

BandsRequest parse(const BandsOptions& options) {
    BandsRequest request{parse_list("--angles", options.angles, 0, kLargestAngle_deg), {}, 0, 0};
    for (const std::string_view item : comma_separated(options.polarization)) {
        if (item != "s" && item != "p")
            throw UsageError("--polarization: must be s, p or both with a comma (got '" +
                             options.polarization + "')");
        request.polarizations.push_back(item == "s" ? Polarization::s : Polarization::p);
    }
    const std::size_t colon = options.range.find(':');
    const std::string rule =
        "--range: must be FIRST:LAST in nm, FIRST below LAST (got '" + options.range + "')";
    if (colon == std::string::npos || options.range.find(':', colon + 1) != std::string::npos)
        throw UsageError(rule);
    const auto end = [](const std::string& text) {
        return parse_one_number("--range", text, kAllWavelengths.first_nm, kAllWavelengths.last_nm);
    };
    request.first_nm = end(options.range.substr(0, colon));
    request.last_nm = end(options.range.substr(colon + 1));
    if (!(request.first_nm < request.last_nm)) throw UsageError(rule);
    return request;
}

std::string letter(Polarization polarization) {
    return polarization == Polarization::s ? "s" : "p";
}

std::string name_of(LandmarkKind kind) {
    switch (kind) {
        case LandmarkKind::mode:
            return "mode";
        case LandmarkKind::edge:
            return "edge";
        case LandmarkKind::airy:
            return "airy";
        case LandmarkKind::zero:
            return "zero";
    }
    return "";
}

Records landmark_records(const BandsRequest& request, const BraggMirror& mirror) {
    Column::Numbers angle, order, omega, wavelength;
    Column::Texts polarization, kind;
    for (const double angle_deg : request.angles_deg) {
        for (const Polarization p : request.polarizations) {
            for (const Landmark& mark :
                 landmarks(mirror.period_at(angle_deg, p), request.omega())) {
                const double wavelength_nm = kTurn / mark.omega_per_nm;
                if (!request.contains(wavelength_nm)) continue;
                angle.push_back(angle_deg);
                polarization.push_back(letter(p));
                kind.push_back(name_of(mark.kind));
                order.push_back(mark.order);
                omega.push_back(mark.omega_per_nm);
                wavelength.push_back(wavelength_nm);
            }
        }
    }
    return {{{"angle_deg", std::move(angle)},
             {"polarization", std::move(polarization)},
             {"kind", std::move(kind)},
             {"order", std::move(order)},
             {"omega_per_nm", std::move(omega)},
             {"wavelength_nm", std::move(wavelength)}}};
}

BandDiagram::Edges wavelengths_of(const BandGap& gap) {
    return {kTurn / gap.high_per_nm, kTurn / gap.low_per_nm};
}

Records gap_records(const BandsRequest& request, const BraggMirror& mirror) {
    Column::Numbers angle, order, shorter, longer, width, R, centre;
    std::array<Column::Numbers, BraggMirror::kReflectances.size()> periods;
    Column::Texts polarization;
    Column::Flags omnidirectional;
    std::map<double, bool> known;
    for (const double angle_deg : request.angles_deg) {
        for (const Polarization p : request.polarizations) {
            for (const BandGap& gap : band_gaps(mirror.period_at(angle_deg, p), request.omega())) {
                const auto [short_nm, long_nm] = wavelengths_of(gap);
                if (long_nm < request.first_nm || short_nm > request.last_nm) continue;
                const double middle = gap.centre_per_nm();
                angle.push_back(angle_deg);
                polarization.push_back(letter(p));
                order.push_back(gap.order);
                shorter.push_back(short_nm);
                longer.push_back(long_nm);
                width.push_back(long_nm - short_nm);
                R.push_back(mirror.reflectance(angle_deg, p, middle));
                centre.push_back(kTurn / middle);
                BraggMirror::Periods needed{};
                if (gap.is_open()) needed = mirror.periods_needed(angle_deg, p, middle);
                for (std::size_t i = 0; i < needed.size(); ++i) periods[i].push_back(needed[i]);
                if (!known.contains(gap.order))
                    known[gap.order] = mirror.is_omnidirectional(gap.order);
                omnidirectional.push_back(known[gap.order]);
            }
        }
    }
    return {{{"angle_deg", std::move(angle)},
             {"polarization", std::move(polarization)},
             {"order", std::move(order)},
             {"short_nm", std::move(shorter)},
             {"long_nm", std::move(longer)},
             {"width_nm", std::move(width)},
             {"R_mid", std::move(R)},
             {"centre_nm", std::move(centre)},
             {"N_95", std::move(periods[0])},
             {"N_99", std::move(periods[1])},
             {"N_999", std::move(periods[2])},
             {"omnidirectional", std::move(omnidirectional)}}};
}

std::string picture(const BandsRequest& request, const BraggMirror& mirror,
                    const std::string& title) {
    BandDiagram diagram{title, request.first_nm, request.last_nm, request.angles_deg, {}};
    std::ranges::sort(diagram.angles_deg);
    const auto repeated = std::ranges::unique(diagram.angles_deg);
    diagram.angles_deg.erase(repeated.begin(), repeated.end());
    constexpr std::array kBoth{Polarization::s, Polarization::p};
    std::map<double, BandDiagram::Gap> gaps;
    for (const double angle_deg : diagram.angles_deg)
        for (const Polarization p : kBoth)
            for (const BandGap& gap : band_gaps(mirror.period_at(angle_deg, p), request.omega()))
                gaps[gap.order].order = gap.order;
    for (auto& [order, gap] : gaps) {
        for (const double angle_deg : diagram.angles_deg) {
            gap.s.push_back(wavelengths_of(band_gap(mirror.period_at(angle_deg, kBoth[0]), order)));
            gap.p.push_back(wavelengths_of(band_gap(mirror.period_at(angle_deg, kBoth[1]), order)));
        }
        diagram.gaps.push_back(std::move(gap));
    }
    return write_band_diagram(diagram);
}

int run_bands(const BandsOptions& options) {
    resolved_record_format(options.output);
    const BandsRequest request = parse(options);
    check_plot(options.plot, options.output);
    if (options.plot &&
        std::ranges::min(request.angles_deg) == std::ranges::max(request.angles_deg))
        throw UsageError("--plot: needs several angles, such as --angles 0:89:1");
    const StackDocument document = read_stack(options.stack);
    for (const std::string& text : document.notes) note(text, options.quiet);
    try {
        const BraggMirror mirror(document.stack, request.first_nm, request.last_nm);
        const Records records =
            options.gaps ? gap_records(request, mirror) : landmark_records(request, mirror);
        const std::string title = document.name.empty() ? options.stack.stack : document.name;
        const std::string drawn = options.plot ? picture(request, mirror, title) : "";
        if (mirror.left_out_k() > 0)
            note("the absorption of the two layers (k up to " + to_text(mirror.left_out_k()) +
                     ") is left out of landmarks and gaps",
                 options.quiet);
        write_records(records, options.output);
        if (options.plot) write_file(*options.plot, drawn);
    } catch (const DomainError& error) {
        throw InputError(document.file, "", error.what());
    }
    return 0;
}

}  // namespace

void add_bands_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "bands", "Landmarks and gaps of a Bragg mirror: modes, band edges, Airy points, zeros.");
    const auto options = std::make_shared<BandsOptions>();
    add_stack_options(*command, options->stack);
    add_angles_option(*command, options->angles);
    command
        ->add_option("-p,--polarization", options->polarization, "s, p or both with a comma [s,p]")
        ->type_name("LETTERS");
    command
        ->add_option("--range", options->range,
                     "vacuum wavelengths that are looked at, nm, in [1, 1e7] [360:830]")
        ->type_name("FIRST:LAST");
    command->add_flag("--gaps", options->gaps,
                      "the gaps instead: ends, width, R of the whole stack in the middle\n"
                      "(of 1/wavelength), N_95, N_99 and N_999 periods needed there for\n"
                      "R of 0.95, 0.99 and 0.999 (0: none up to 1e9), and whether some\n"
                      "wavelength lies in the gap at all angles in s and p");
    command
        ->add_option("--plot", options->plot,
                     "draw the gaps over angle and wavelength as SVG, for several angles")
        ->type_name("FILE");
    add_output_options(*command, options->output, "csv, json or npy [csv]");
    command->add_flag("--quiet", options->quiet, "no notes on standard error");
    set_examples(
        *command,
        {"irido bands \"1 | (1@200 | 1.5@180)^10 | 1\" -a 20 -p p",
         "irido bands \"air | (TiO2@58.5 | SiO2@94.2)^10 | BK7\" -a 0:85:1 --gaps "
         "--plot bands.svg"},
        "The STACK has one group of two transparent layers that is repeated, and any others "
        "around\n"
        "it; landmarks are those of the group without end. With a and b the phases across its\n"
        "layers and KL that across both,\n"
        "    mode m  a + b = m pi      edge m  both ends of the gap around mode m\n"
        "    zero z  b = z pi          airy m  cos(KL) = 0 between the modes m and m + 1.\n"
        "Closed gaps have two equal edges. Every landmark has the indices at its own wavelength\n"
        "(edges of a gap past what is known of a material: those at its end). A k up to 0.1 and\n"
        "thickness_sigma_nm are left out of landmarks, but not of R. An angle past the\n"
        "critical angle of a layer is an error, as is dispersion so anomalous that the phase\n"
        "of a layer grows with the wavelength.");
    command->callback([options, &run] { run = [options] { return run_bands(*options); }; });
}

}  // namespace irido
