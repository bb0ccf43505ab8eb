#include <algorithm>
#include <memory>

#include "cli/command.hpp"
#include "core/color/difference.hpp"
#include "core/color/illuminant.hpp"
#include "core/color/observer.hpp"
#include "core/color/space.hpp"
#include "core/color/stack_color.hpp"
#include "core/error.hpp"
#include "core/interference/coherent.hpp"
#include "schemas/input_error.hpp"
#include "schemas/spectrum_csv.hpp"
#include "schemas/text_file.hpp"
#include "tables/formats/swatches.hpp"

namespace irido {

namespace {

constexpr int kToleranceNotMet = 1;

struct ColorOptions {
    StackRequest stack;
    std::string angles = "0";
    std::string sides = "R";
    std::string polarization = "u";
    std::string illuminant = "D65";
    std::string observer = "2";
    std::string space = "srgb";
    std::string adaptation = "bradford";
    std::string method = "auto";
    std::string tolerance = "1e-6";
    bool compare = false;
    bool stats = false;
    bool strict = false;
    OutputOptions output;
    unsigned threads = 0;
    bool quiet = false;
};

/// What was asked, in values.
struct ColorRequest {
    std::vector<double> angles_deg;
    std::vector<Side> sides;
    Light light;
    IntegrationLimits limits;
    const RgbSpace& space;
    Adaptation adaptation;
};

std::string_view letter(Side side) {
    return side == Side::reflected ? "R" : "T";
}

std::vector<Side> parse_sides(const std::string& text) {
    if (text == "R") return {Side::reflected};
    if (text == "T") return {Side::transmitted};
    if (text == "R,T") return {Side::reflected, Side::transmitted};
    if (text == "T,R") return {Side::transmitted, Side::reflected};
    throw UsageError("--side: must be R, T or both with a comma (got '" + text + "')");
}

bool contains(std::span<const std::string_view> names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

Light parse_light(const std::string& text) {
    if (text == "s") return Light::s;
    if (text == "p") return Light::p;
    if (text == "u") return Light::unpolarized;
    throw UsageError("--polarization: must be one of s, p, u for a colour (got '" + text + "')");
}

const RgbSpace& parse_space(const std::string& text) {
    if (contains(rgb_space_names(), text)) return rgb_space(text);
    throw UsageError("--space: " + not_one_of(rgb_space_names(), text));
}

const Observer& parse_observer(const std::string& text) {
    if (text == "2") return observer(2);
    if (text == "10") return observer(10);
    throw UsageError("--observer: must be 2 or 10 (got '" + text + "')");
}

Table parse_illuminant(const std::string& text) {
    if (contains(illuminant_names(), text)) return illuminant(text);
    try {
        return read_spectrum_csv(read_text(text), text);
    } catch (const InputError& error) {
        if (text.find_first_of("./") != std::string::npos || text == "-") throw;
        throw UsageError("--illuminant: " + not_one_of(illuminant_names(), text) + ", or a file");
    }
}

void check_choice(const std::string& option, const std::string& text,
                  std::initializer_list<std::string_view> choices) {
    if (std::ranges::find(choices, text) == choices.end())
        throw UsageError(option + ": " +
                         not_one_of(std::span(choices.begin(), choices.size()), text));
}

ColorRequest parse(const ColorOptions& options) {
    check_choice("--method", options.method, {"auto", "quadrature"});
    check_choice("--adaptation", options.adaptation, {"bradford", "none"});
    const double tolerance = parse_one_number("--tolerance", options.tolerance, 1e-12, 1);
    return {parse_list("--angles", options.angles, 0, kLargestAngle_deg),
            parse_sides(options.sides),
            parse_light(options.polarization),
            {.tolerance = tolerance},
            parse_space(options.space),
            options.adaptation == "none" ? Adaptation::none : Adaptation::bradford};
}

std::string in_words(const HeldRange& held, const StackDocument& document) {
    const std::string& name = document.stack.materials[held.material].name;
    return (name.empty() ? "the material" : name) + " is known from " +
           to_text(held.range.first_nm) + " to " + to_text(held.range.last_nm) + " nm";
}

/// Two digits of a fraction in percent.
std::string percent(double fraction) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2g %%", 100 * fraction);
    return text.data();
}

/// Says where a material holds its end values, or refuses what colour cannot be made of.
void report_held_ranges(const StackDocument& document, const Sensitivity& sensitivity,
                        const ColorOptions& options) {
    for (const HeldRange& held : held_ranges(document.stack, sensitivity)) {
        const std::string& pointer = document.material_pointers[held.material];
        if (!held.usable)
            throw InputError(document.file, pointer,
                             in_words(held, document) + ", a colour needs 400 to 700 nm");
        const std::string text = in_words(held, document) + ", its end values are held for " +
                                 percent(held.weight[0]) + ", " + percent(held.weight[1]) + ", " +
                                 percent(held.weight[2]) + " of the X, Y, Z weight";
        if (options.strict) throw InputError(document.file, pointer, text);
        note(InputError(document.file, pointer, text).what(), options.quiet);
    }
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
    std::vector<ColorIntegral> colors;  ///< [angle][side]
};

Records to_records(const ColorRequest& request, const LitColors& lit, bool stats) {
    const auto& [illuminant, white, colors] = lit;
    const RgbTransform transform = rgb_transform(request.space, white, request.adaptation);
    std::array<Column::Numbers, 9> values;  // angle, X Y Z, x y, r g b
    Column::Texts side, hexes, method;
    Column::Flags gamut;
    Column::Numbers evaluations, error;
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const Triple& xyz = colors[i].xyz;
        const auto [x, y] = chromaticity(xyz, white);
        const Triple rgb = transform(xyz);
        const std::array row{request.angles_deg[i / request.sides.size()],
                             xyz[0],
                             xyz[1],
                             xyz[2],
                             x,
                             y,
                             rgb[0],
                             rgb[1],
                             rgb[2]};
        for (std::size_t c = 0; c < row.size(); ++c) values[c].push_back(row[c]);
        side.emplace_back(letter(request.sides[i % request.sides.size()]));
        hexes.push_back(hex(request.space, rgb));
        gamut.push_back(in_gamut(rgb));
        method.emplace_back("quadrature");
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
Records compared(const ColorRequest& request, const std::vector<LitColors>& lits, bool stats) {
    Records all;
    for (const LitColors& lit : lits) {
        Records records = to_records(request, lit, stats);
        records.columns.push_back({"illuminant", Column::Texts(lit.colors.size(), lit.illuminant)});
        records.columns.push_back({"delta_e_2000", differences(lit, lits.front())});
        all.append(std::move(records));
    }
    return all;
}

std::string picture(const ColorRequest& request, const std::vector<LitColors>& lits,
                    const std::string& title) {
    Swatches swatches{title, "angle of incidence, degrees", request.angles_deg, {}};
    for (const LitColors& lit : lits) {
        const RgbTransform transform =
            rgb_transform(rgb_space("srgb"), lit.white, Adaptation::bradford);
        for (std::size_t s = 0; s < request.sides.size(); ++s) {
            const std::string side(letter(request.sides[s]));
            Swatches::Strip strip{lits.size() == 1 ? side : lit.illuminant + " " + side, {}};
            for (std::size_t i = s; i < lit.colors.size(); i += request.sides.size())
                strip.colors.push_back(hex(rgb_space("srgb"), transform(lit.colors[i].xyz)));
            swatches.strips.push_back(std::move(strip));
        }
    }
    return write_swatches(swatches);
}

/// 0, or the exit status after one line on standard error if a colour is not as exact as asked.
int check_tolerance(const ColorRequest& request, const std::vector<ColorIntegral>& colors,
                    const std::string& file) {
    const auto worst = std::ranges::max_element(colors, {}, &ColorIntegral::error);
    if (worst->error <= request.limits.tolerance) return 0;
    const auto i = static_cast<std::size_t>(worst - colors.begin());
    const Triple& xyz = worst->xyz;
    std::fprintf(
        stderr,
        "irido: error: %s: the tolerance %s cannot be met; at %s degrees, side %s, the best "
        "value is X, Y, Z = %s, %s, %s with an error of %s\n",
        file.c_str(), to_text(request.limits.tolerance).c_str(),
        to_text(request.angles_deg[i / request.sides.size()]).c_str(),
        std::string(letter(request.sides[i % request.sides.size()])).c_str(),
        to_text(xyz[0]).c_str(), to_text(xyz[1]).c_str(), to_text(xyz[2]).c_str(),
        to_text(worst->error).c_str());
    return kToleranceNotMet;
}

/// The illuminant asked for and, to compare, all others by name.
std::vector<std::string> illuminants(const ColorOptions& options) {
    std::vector<std::string> names{options.illuminant};
    if (!options.compare) return names;
    for (const std::string_view name : illuminant_names())
        if (name != options.illuminant) names.emplace_back(name);
    return names;
}

LitColors colors_under(const Sensitivity& sensitivity, const StackDocument& document,
                       const ColorRequest& request, const Execution& execution) {
    try {
        return {"", sensitivity.white(),
                stack_color(document.stack, sensitivity, request.angles_deg, request.sides,
                            request.limits, execution, request.light)};
    } catch (const DomainError& error) {
        throw InputError(document.file, "", error.what());
    }
}

int run_color(const ColorOptions& options) {
    const bool is_picture = resolved_format(options.output) == "svg";
    if (!is_picture) resolved_record_format(options.output, "svg");
    const ColorRequest request = parse(options);
    const Observer& eye = parse_observer(options.observer);
    const Sensitivity first(eye, parse_illuminant(options.illuminant));
    const StackDocument document = read_stack(options.stack);
    for (const std::string& text : document.notes) note(text, options.quiet);
    report_held_ranges(document, first, options);
    std::vector<LitColors> lits;
    for (const std::string& name : illuminants(options)) {
        lits.push_back(colors_under(lits.empty() ? first : Sensitivity(eye, illuminant(name)),
                                    document, request, execution_of(options.threads)));
        lits.back().illuminant = name;
        if (const int status = check_tolerance(request, lits.back().colors, document.file))
            return status;
    }
    if (is_picture) {
        const std::string title = document.name.empty() ? options.stack.stack : document.name;
        write_bytes(picture(request, lits, title), options.output, false);
    } else {
        write_records(options.compare ? compared(request, lits, options.stats)
                                      : to_records(request, lits.front(), options.stats),
                      options.output);
    }
    return 0;
}

void add_color_options(CLI::App& command, ColorOptions& options) {
    add_angles_option(command, options.angles);
    command.add_option("--side", options.sides, "R (reflected), T (transmitted) or R,T [R]")
        ->type_name("SIDES");
    command
        .add_option("-p,--polarization", options.polarization,
                    "s, p or u (unpolarized: the mean of both) [u]")
        ->type_name("LETTER");
    command
        .add_option("--illuminant", options.illuminant,
                    "D65, D50, A, E, FL2, FL11 or a CSV file of rows nm,power\n"
                    "(relative, linear in between, zero outside) [D65]")
        ->type_name("NAME");
    command.add_flag("--compare-illuminants", options.compare,
                     "the same under every other named illuminant too; adds\n"
                     "illuminant,delta_e_2000 (CIEDE2000 to the first one)");
    command.add_option("--observer", options.observer, "2 (CIE 1931) or 10 (CIE 1964) degrees [2]")
        ->type_name("DEGREES");
    command
        .add_option("--space", options.space,
                    "of r, g, b, hex: srgb, rec2020, display-p3, acescg, xyz [srgb]")
        ->type_name("NAME");
    command
        .add_option("--adaptation", options.adaptation,
                    "bradford (a perfect mirror is r = g = b = 1) or none [bradford]")
        ->type_name("NAME");
    command
        .add_option("--method", options.method,
                    "auto, or quadrature: product quadrature, which auto takes [auto]")
        ->type_name("NAME");
    command
        .add_option("--tolerance", options.tolerance,
                    "largest error of X, Y, Z (white Y = 1), [1e-12, 1] [1e-6];\n"
                    "exit status 1 if it cannot be met")
        ->type_name("T");
    command.add_flag("--stats", options.stats, "adds method,evaluations,error_estimate");
    command.add_flag("--strict", options.strict,
                     "a material not known from 360 to 830 nm is an error");
}

}  // namespace

void add_color_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "color", "X, Y, Z and linear RGB of the light that a stack reflects or transmits.");
    const auto options = std::make_shared<ColorOptions>();
    add_stack_options(*command, options->stack);
    add_color_options(*command, *options);
    add_output_options(*command, options->output,
                       "csv, json, npy, or svg: a strip of the colours in sRGB [csv]");
    add_threads_option(*command, options->threads);
    command->add_flag("--quiet", options->quiet, "no notes on standard error");
    set_examples(*command, {"irido color \"air | TiO2@35 | Ti\" -a 0:80:10 --stats",
                            "irido color stack.json -a 0:85:1 --side R,T -o strip.svg"});
    command->callback([options, &run] { run = [options] { return run_color(*options); }; });
}

}  // namespace irido
