#include <algorithm>
#include <memory>

#include "cli/color_options.hpp"
#include "core/color/difference.hpp"
#include "core/color/illuminant.hpp"
#include "core/color/space.hpp"
#include "core/color/stack_color.hpp"
#include "core/error.hpp"
#include "core/interference/coherent.hpp"
#include "schemas/input_error.hpp"
#include "tables/formats/swatches.hpp"

namespace irido {

namespace {

constexpr int kToleranceNotMet = 1;

struct ColorCommand {
    StackRequest stack;
    std::string angles = "0";
    ColorOptions color;
    bool compare = false;
    bool stats = false;
    bool strict = false;
    OutputOptions output;
    unsigned threads = 0;
    bool quiet = false;
};

/// What was asked, in values.
struct ColorQuestion {
    std::vector<double> angles_deg;
    ColorRequest request;
    ColorMethod method;
    bool held_to_tolerance = false;  ///< a tolerance was given
    const RgbSpace* space = nullptr;
    Adaptation adaptation = Adaptation::bradford;

    std::span<const Side> sides() const { return request.sides; }
};

ColorQuestion parse(const ColorCommand& command) {
    const ColorOptions& typed = command.color;
    ColorQuestion question;
    question.angles_deg = parse_list("--angles", command.angles, 0, kLargestAngle_deg);
    question.method = parse_method(typed);
    question.held_to_tolerance = !typed.tolerance.empty();
    question.space = &parse_space(typed.space);
    question.adaptation = parse_adaptation(typed.adaptation);
    ColorRequest& request = question.request;
    request.sides = parse_sides(typed.sides);
    request.light = parse_light(typed.polarization);
    request.tolerance = parse_tolerance(typed.tolerance);
    request.colors = question.angles_deg.size();
    request.simd = execution_of(command.threads).simd;
    return question;
}

/// x, y of the colour, of the white where there is no light.
std::array<double, 2> chromaticity(const Triple& xyz, const Triple& white) {
    const Triple& shown = xyz[0] + xyz[1] + xyz[2] > 0 ? xyz : white;
    const double sum = shown[0] + shown[1] + shown[2];
    return {shown[0] / sum, shown[1] / sum};
}

RgbTransform rgb_transform(const RgbSpace& space, const Triple& white, Adaptation adaptation) {
    try {
        return {space, white, adaptation};
    } catch (const DomainError& error) {
        throw UsageError("--illuminant: " + std::string(error.what()) +
                         ", --adaptation none does without");
    }
}

/// The colours of a stack under one illuminant.
struct LitColors {
    std::string illuminant;
    Triple white{};
    std::vector<StackColor> colors;  ///< [angle][side]
    bool approximate = false;        ///< the method was not meant to be exact
};

Records to_records(const ColorQuestion& question, const LitColors& lit, bool stats) {
    const Triple& white = lit.white;
    const std::vector<StackColor>& colors = lit.colors;
    const RgbTransform transform = rgb_transform(*question.space, white, question.adaptation);
    std::array<Column::Numbers, 9> values;  // angle, X Y Z, x y, r g b
    Column::Texts side, hexes, method;
    Column::Flags gamut;
    Column::Numbers evaluations, error;
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const Triple& xyz = colors[i].xyz;
        const auto [x, y] = chromaticity(xyz, white);
        const Triple rgb = transform(xyz);
        const std::array row{question.angles_deg[i / question.sides().size()],
                             xyz[0],
                             xyz[1],
                             xyz[2],
                             x,
                             y,
                             rgb[0],
                             rgb[1],
                             rgb[2]};
        for (std::size_t c = 0; c < row.size(); ++c) values[c].push_back(row[c]);
        side.emplace_back(letter(question.sides()[i % question.sides().size()]));
        hexes.push_back(hex(*question.space, rgb));
        gamut.push_back(in_gamut(rgb));
        method.push_back(name_of(ColorMethod{colors[i].method, question.method.count}));
        evaluations.push_back(static_cast<double>(colors[i].evaluations));
        error.push_back(colors[i].error);
    }
    Records records{{{"angle_deg", std::move(values[0])}, {"side", std::move(side)}}};
    constexpr std::array names{"X", "Y", "Z", "x", "y", "r", "g", "b"};
    for (std::size_t c = 0; c < names.size(); ++c)
        records.columns.push_back({names[c], std::move(values[c + 1])});
    records.columns.push_back({"hex", std::move(hexes)});
    records.columns.push_back({"in_gamut", std::move(gamut)});
    if (!stats) return records;
    records.columns.push_back({"method", std::move(method)});
    records.columns.push_back({"evaluations", std::move(evaluations)});
    records.columns.push_back({"error_estimate", std::move(error)});
    return records;
}

/// CIEDE2000 of every colour to the same one under the first illuminant, each under its own white.
Column::Numbers differences(const LitColors& lit, const LitColors& first) {
    Column::Numbers result;
    for (std::size_t i = 0; i < lit.colors.size(); ++i)
        result.push_back(
            ciede2000(lab(lit.colors[i].xyz, lit.white), lab(first.colors[i].xyz, first.white)));
    return result;
}

/// The records of all illuminants one after another, with their names and differences.
Records compared(const ColorQuestion& question, const std::vector<LitColors>& lits, bool stats) {
    Records all;
    for (const LitColors& lit : lits) {
        Records records = to_records(question, lit, stats);
        records.columns.push_back({"illuminant", Column::Texts(lit.colors.size(), lit.illuminant)});
        records.columns.push_back({"delta_e_2000", differences(lit, lits.front())});
        all.append(std::move(records));
    }
    return all;
}

std::string picture(const ColorQuestion& question, const std::vector<LitColors>& lits,
                    const std::string& title) {
    Swatches swatches{title, "angle of incidence, degrees", question.angles_deg, {}};
    for (const LitColors& lit : lits) {
        const RgbTransform transform =
            rgb_transform(rgb_space("srgb"), lit.white, Adaptation::bradford);
        for (std::size_t s = 0; s < question.sides().size(); ++s) {
            const std::string side(letter(question.sides()[s]));
            Swatches::Strip strip{lits.size() == 1 ? side : lit.illuminant + " " + side, {}};
            for (std::size_t i = s; i < lit.colors.size(); i += question.sides().size())
                strip.colors.push_back(hex(rgb_space("srgb"), transform(lit.colors[i].xyz)));
            swatches.strips.push_back(std::move(strip));
        }
    }
    return write_swatches(swatches);
}

/// 0, or the exit status after one line on standard error if a colour is not as exact as asked.
int check_tolerance(const ColorQuestion& question, const std::vector<StackColor>& colors,
                    const std::string& file) {
    const auto worst = std::ranges::max_element(colors, {}, &StackColor::error);
    if (worst->error <= question.request.tolerance) return 0;
    const auto i = static_cast<std::size_t>(worst - colors.begin());
    const Triple& xyz = worst->xyz;
    std::fprintf(
        stderr,
        "irido: error: %s: the tolerance %s cannot be met; at %s degrees, side %s, the best "
        "value is X, Y, Z = %s, %s, %s with an error of %s\n",
        file.c_str(), to_text(question.request.tolerance).c_str(),
        to_text(question.angles_deg[i / question.sides().size()]).c_str(),
        std::string(letter(question.sides()[i % question.sides().size()])).c_str(),
        to_text(xyz[0]).c_str(), to_text(xyz[1]).c_str(), to_text(xyz[2]).c_str(),
        to_text(worst->error).c_str());
    return kToleranceNotMet;
}

/// The illuminant asked for and, to compare, all others by name.
std::vector<std::string> illuminants(const ColorCommand& command) {
    std::vector<std::string> names{command.color.illuminant};
    if (!command.compare) return names;
    for (const std::string_view name : illuminant_names())
        if (name != command.color.illuminant) names.emplace_back(name);
    return names;
}

LitColors colors_under(const Sensitivity& sensitivity, const StackDocument& document,
                       const ColorQuestion& question, unsigned threads) {
    try {
        const ColorTables tables(sensitivity);
        LitColors lit{"", sensitivity.white(),
                      stack_color(tables, document.stack, question.method, question.request,
                                  question.angles_deg, threads)};
        lit.approximate = measure_errors(tables, document.stack, question.request,
                                         question.angles_deg, threads, lit.colors) ||
                          question.method.count > 0;
        return lit;
    } catch (const DomainError& error) {
        throw InputError(document.file, "", error.what());
    }
}

/// 0, or the exit status after one line on standard error if a colour is not as exact as asked.
/// Methods that are not exact are held to nothing by themselves: a note says how far they are off
/// if it is more than the default tolerance.
int check_errors(const ColorQuestion& question, const LitColors& lit, const std::string& file,
                 bool quiet) {
    if (question.held_to_tolerance || !lit.approximate)
        return check_tolerance(question, lit.colors, file);
    const double worst = std::ranges::max_element(lit.colors, {}, &StackColor::error)->error;
    if (worst <= question.request.tolerance) return 0;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2g", worst);
    note(file + ": " + name_of(question.method) + " is off by up to " + text.data() +
             " in X, Y, Z here",
         quiet);
    return 0;
}

int run_color(const ColorCommand& command) {
    const bool is_picture = resolved_format(command.output) == "svg";
    if (!is_picture) resolved_record_format(command.output, "svg");
    const ColorQuestion question = parse(command);
    const Observer& eye = parse_observer(command.color.observer);
    const Sensitivity first(eye, parse_illuminant(command.color.illuminant));
    const StackDocument document = read_stack(command.stack);
    for (const std::string& text : document.notes) note(text, command.quiet);
    report_held_ranges(document, first, command.strict, command.quiet);
    std::vector<LitColors> lits;
    for (const std::string& name : illuminants(command)) {
        lits.push_back(colors_under(lits.empty() ? first : Sensitivity(eye, illuminant(name)),
                                    document, question, command.threads));
        lits.back().illuminant = name;
        if (const int status = check_errors(question, lits.back(), document.file, command.quiet))
            return status;
    }
    if (is_picture) {
        const std::string title = document.name.empty() ? command.stack.stack : document.name;
        write_bytes(picture(question, lits, title), command.output, false);
    } else {
        write_records(command.compare ? compared(question, lits, command.stats)
                                      : to_records(question, lits.front(), command.stats),
                      command.output);
    }
    return 0;
}

}  // namespace

void add_color_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "color", "X, Y, Z and linear RGB of the light that a stack reflects or transmits.");
    const auto options = std::make_shared<ColorCommand>();
    add_stack_options(*command, options->stack);
    add_angles_option(*command, options->angles);
    add_color_options(*command, options->color);
    command->add_flag("--compare-illuminants", options->compare,
                      "the same under every other named illuminant too; adds\n"
                      "illuminant,delta_e_2000 (CIEDE2000 to the first one)");
    command->add_flag("--stats", options->stats,
                      "adds method,evaluations,error_estimate; the error of methods\n"
                      "that are not exact is measured against quadrature");
    command->add_flag("--strict", options->strict,
                      "a material not known from 360 to 830 nm is an error");
    add_output_options(*command, options->output,
                       "csv, json, npy, or svg: a strip of the colours in sRGB [csv]");
    add_threads_option(*command, options->threads);
    command->add_flag("--quiet", options->quiet, "no notes on standard error");
    set_examples(*command, {"irido color \"air | TiO2@35 | Ti\" -a 0:80:10 --stats",
                            "irido color stack.json -a 0:85:1 --side R,T -o strip.svg"});
    command->callback([options, &run] { run = [options] { return run_color(*options); }; });
}

}  // namespace irido
