#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/command.hpp"
#include "core/color/film_color.hpp"
#include "core/error.hpp"
#include "core/interference/film.hpp"
#include "core/interference/index_table.hpp"
#include "schemas/input_error.hpp"

namespace irido {

namespace {

constexpr double kMostOrders = 1e6;

struct CmOptions {
    StackRequest stack;
    std::string angles = "0";
    std::string polarization = "s,p";
    std::string orders = "0:5:1";
    std::string sides = "R";
    std::string at = "550";
    OutputOptions output;
    bool quiet = false;
};

constexpr double kMostRows = 1e7;

/// What was asked, in values.
struct CmRequest {
    std::vector<double> angles_deg;
    std::vector<char> polarizations;  ///< s or p
    std::vector<char> sides;          ///< R or T
    std::vector<double> orders;
    double at_nm = 0;
};

/// The letters of a list, each one of `allowed`; `rule` says so.
std::vector<char> parse_letters(const std::string& text, std::string_view allowed,
                                std::string rule) {
    std::vector<char> letters;
    for (const std::string_view item : comma_separated(text)) {
        if (item.size() != 1 || allowed.find(item) == std::string_view::npos)
            throw UsageError(rule.append(" (got '").append(text).append("')"));
        letters.push_back(item.front());
    }
    return letters;
}

std::vector<double> parse_orders(const std::string& text) {
    std::vector<double> orders = parse_list("--orders", text, 0, kMostOrders);
    for (const double order : orders)
        if (order != std::floor(order))
            throw UsageError("--orders: must be whole numbers (got " + to_text(order) + ")");
    return orders;
}

CmRequest parse(const CmOptions& options) {
    CmRequest request;
    request.angles_deg = parse_list("--angles", options.angles, 0, kLargestAngle_deg);
    request.polarizations = parse_letters(options.polarization, "sp",
                                          "--polarization: must be s, p or both with a comma");
    request.sides = parse_letters(options.sides, "RT", "--side: must be R, T or both with a comma");
    request.orders = parse_orders(options.orders);
    request.at_nm =
        parse_one_number("--at", options.at, kAllWavelengths.first_nm, kAllWavelengths.last_nm);
    const double rows = static_cast<double>(request.angles_deg.size()) *
                        static_cast<double>(request.polarizations.size() * request.sides.size()) *
                        static_cast<double>(request.orders.size());
    if (rows > kMostRows)
        throw UsageError("--orders: asks for " + to_text(rows) + " rows, more than " +
                         to_text(kMostRows));
    return request;
}

/// The film's media at the wavelength asked for.
Film film_of(const StackDocument& document, double at_nm) {
    const Stack& stack = document.stack;
    const std::string fault = stack.elements.empty() ? "no layer" : film_fault(stack);
    if (!fault.empty())
        throw InputError(document.file, "",
                         "cm needs one coherent film of a real index (got " + fault + ")");
    const Layer layer = only_film(stack);
    try {
        const IndexTable table(stack, {at_nm});
        return {table.n(stack.incident)[0], table.n(layer.material)[0],
                table.index(stack.substrate, 0), layer.thickness_nm};
    } catch (const DomainError& error) {
        throw InputError(document.file, "", error.what());
    }
}

FilmSeries series_at(const StackDocument& document, const Film& film, double angle_deg,
                     char polarization) {
    const auto series = film_series(film, cos_of_incidence(angle_deg),
                                    polarization == 's' ? Polarization::s : Polarization::p);
    if (series) return *series;
    throw InputError(document.file, "",
                     "there is no series at " + to_text(angle_deg) + " degrees, where " +
                         (film.base.imag() < 0 ? "the film is past its critical angle or the base "
                                                 "amplifies without bound"
                                               : "the film is past its critical angle"));
}

Records cm_records(const CmRequest& request, const StackDocument& document, const Film& film) {
    Column::Numbers angle, order, C, opd, phi;
    Column::Texts polarization, side;
    for (const double angle_deg : request.angles_deg) {
        for (const char p : request.polarizations) {
            const FilmSeries series = series_at(document, film, angle_deg, p);
            for (const char s : request.sides) {
                for (const double m : request.orders) {
                    angle.push_back(angle_deg);
                    polarization.emplace_back(1, p);
                    side.emplace_back(1, s);
                    order.push_back(m);
                    C.push_back(series.coefficient(s == 'T', m));
                    opd.push_back(series.opd_nm);
                    phi.push_back(series.phase_rad());
                }
            }
        }
    }
    return {{{"angle_deg", std::move(angle)},
             {"polarization", std::move(polarization)},
             {"side", std::move(side)},
             {"order", std::move(order)},
             {"C", std::move(C)},
             {"opd_nm", std::move(opd)},
             {"phi_rad", std::move(phi)}}};
}

int run_cm(const CmOptions& options) {
    resolved_record_format(options.output);
    const CmRequest request = parse(options);
    const StackDocument document = read_stack(options.stack);
    for (const std::string& text : document.notes) note(text, options.quiet);
    const Film film = film_of(document, request.at_nm);
    write_records(cm_records(request, document, film), options.output);
    return 0;
}

}  // namespace

void add_cm_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "cm", "Fourier series of a film's fringes: C_m, optical path and phase.");
    const auto options = std::make_shared<CmOptions>();
    add_stack_options(*command, options->stack);
    add_angles_option(*command, options->angles);
    command
        ->add_option("-p,--polarization", options->polarization, "s, p or both with a comma [s,p]")
        ->type_name("LETTERS");
    command->add_option("--side", options->sides, "R (reflected), T (transmitted) or R,T [R]")
        ->type_name("SIDES");
    command
        ->add_option("--orders", options->orders,
                     "orders m, whole numbers in [0, 1e6], as --angles has its values [0:5:1]")
        ->type_name("LIST");
    command
        ->add_option("--at", options->at,
                     "vacuum wavelength at which the indices are taken, nm, [1, 1e7] [550]")
        ->type_name("NM");
    add_output_options(*command, options->output, "csv, json or npy [csv]");
    command->add_flag("--quiet", options->quiet, "no notes on standard error");
    set_examples(
        *command,
        {"irido cm \"air | 1.42@400 | 1.87+1.182i\" -a 0,50 --orders 0:2:1",
         "irido cm \"air | SiO2@300 | Si\" -a 0:80:20 -p s --side R,T --at 600"},
        "The STACK is one film of a real index over any base. With opd_nm = D, phi_rad = phi\n"
        "and the vacuum wavelength L in nm,\n"
        "    R (or T) = C_0 + 2 sum over m of C_m cos(m (2 pi D / L + phi)).\n"
        "A thickness_sigma_nm is left out.");
    command->callback([options, &run] { run = [options] { return run_cm(*options); }; });
}

}  // namespace irido
