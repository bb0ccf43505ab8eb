#include "cli/options/color_options.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "core/color/held_stack.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/spectrum_csv.hpp"
#include "schemas/readers/text_file.hpp"

namespace irido::cli {

namespace {

bool contains(std::span<const std::string_view> names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

}  // namespace

std::vector<Side> parse_sides(const std::string& text) {
    if (text == "R") return {Side::reflected};
    if (text == "T") return {Side::transmitted};
    if (text == "R,T") return {Side::reflected, Side::transmitted};
    if (text == "T,R") return {Side::transmitted, Side::reflected};
    throw UsageError("--side: must be R, T or R,T (got '" + text + "')");
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

Adaptation parse_adaptation(const std::string& text) {
    constexpr std::array<std::string_view, 2> names{"bradford", "none"};
    if (!contains(names, text)) throw UsageError("--adaptation: " + not_one_of(names, text));
    return text == "none" ? Adaptation::none : Adaptation::bradford;
}

const Observer& parse_observer(const std::string& text) {
    if (text == "2") return observer(2);
    if (text == "10") return observer(10);
    throw UsageError("--observer: must be 2 or 10 (got '" + text + "')");
}

double parse_tolerance(const std::string& text) {
    return text.empty() ? kDefaultTolerance
                        : parse_one_number("--tolerance", text, kSmallestTolerance, 1);
}

std::vector<std::string_view> color_method_names() {
    std::vector<std::string_view> names;
    for (const ColorMethodKind* const method : color_methods()) names.push_back(method->name);
    return names;
}

namespace {

/// The count of a method by its number as typed.
std::size_t parse_count(const std::string& option, const std::string& typed,
                        const MethodNumber& number) {
    return number.offset +
           static_cast<std::size_t>(parse_whole_number(option, typed, number.fewest, number.most));
}

Triple parse_base_color(const std::string& text) {
    const std::vector<double> typed = parse_list("--base-color", text, 0, 1);
    Triple rgb{};
    if (typed.size() != rgb.size() || text.find(':') != std::string::npos)
        throw UsageError("--base-color: must be three numbers R,G,B (got '" + text + "')");
    std::ranges::copy(typed, rgb.begin());
    return rgb;
}

}  // namespace

ColorMethod parse_method(const std::string& text) {
    const std::size_t slash = text.find('/');
    const std::string name = text.substr(0, slash);
    const ColorMethodKind* const method = find_color_method(name);
    if (!method) {
        const std::vector<std::string_view> names = color_method_names();
        throw UsageError("--method: " + not_one_of(names, name));
    }
    if (slash == std::string::npos) return {method, method->number.fallback};
    if (!method->takes_number())
        throw UsageError("--method: " + name + " takes no number (got '" + text + "')");
    return {method,
            parse_count("--method: the number of " + name, text.substr(slash + 1), method->number)};
}

ColorMethod parse_method(const ColorOptions& options) {
    ColorMethod method = parse_method(options.method);
    const bool has_number = options.method.find('/') != std::string::npos;
    const auto require = [&](const std::string& flag, auto takes) {
        if (takes(*method.kind)) return;
        std::vector<std::string> names;
        for (const ColorMethodKind* const kind : color_methods())
            if (takes(*kind)) names.emplace_back(kind->name);
        throw UsageError(flag + ": requires --method " + one_of(names) + " (got '" +
                         options.method + "')");
    };
    const auto set_number = [&](const std::string& flag, const std::string& typed,
                                std::string_view name) {
        if (typed.empty()) return;
        require(flag, [name](const ColorMethodKind& kind) { return kind.name == name; });
        if (has_number)
            throw UsageError(flag + ": conflicts with the number in --method (got '" +
                             options.method + "')");
        method.count = parse_count(flag, typed, method.kind->number);
    };
    set_number("--subdivide", options.subdivide, "landmarks");
    set_number("--harmonics", options.harmonics, "bloch");
    if (!options.base_color.empty()) {
        require("--base-color", [](const ColorMethodKind& kind) { return kind.takes_base_color; });
        method.base_color = parse_base_color(options.base_color);
    }
    return method;
}

Table parse_illuminant(const std::string& text) {
    if (contains(illuminant_names(), text)) return illuminant(text);
    try {
        return schemas::read_spectrum_csv(schemas::read_text(text), text);
    } catch (const schemas::InputError& error) {
        if (text.find_first_of("./") != std::string::npos || text == "-") throw;
        std::vector<std::string_view> known(illuminant_names().begin(), illuminant_names().end());
        known.emplace_back("a CSV file");
        throw UsageError("--illuminant: " + not_one_of(known, text));
    }
}

std::string name_of(const ColorMethod& method) {
    const std::string name(method.kind->name);
    return method.count == 0
               ? name
               : name + "/" + std::to_string(method.count - method.kind->number.offset);
}

std::string_view letter(Side side) {
    return side == Side::reflected ? "R" : "T";
}

namespace {

std::string in_words(const HeldRange& held, const schemas::StackDocument& document) {
    const std::string& name = document.stack.materials[held.material].name;
    return (name.empty() ? "the material" : name) + " is known from " +
           to_text(held.range.first_nm) + " to " + to_text(held.range.last_nm) + " nm";
}

/// A fraction in percent, to two digits.
std::string percent(double fraction) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2g %%", 100 * fraction);
    return text.data();
}

}  // namespace

void report_held_ranges(const schemas::StackDocument& document, const Sensitivity& sensitivity,
                        bool strict, const std::function<void(const std::string&)>& say) {
    std::set<std::string> said;  // parts of a graded layer have the same range
    for (const HeldRange& held : held_ranges(document.stack, sensitivity)) {
        const std::string& pointer = document.material_pointers[held.material];
        if (!held.usable)
            throw schemas::InputError(
                document.file, pointer,
                in_words(held, document) + "; a colour needs data from 400 to 700 nm");
        const std::string text = in_words(held, document) +
                                 "; clamped to its end values beyond, where " +
                                 percent(held.weight[0]) + ", " + percent(held.weight[1]) + ", " +
                                 percent(held.weight[2]) + " of the X, Y, Z weight lies";
        if (strict) throw schemas::InputError(document.file, pointer, text);
        const std::string line = schemas::InputError(document.file, pointer, text).what();
        if (said.insert(line).second) say(line);
    }
}

void add_side_options(CLI::App& command, ColorOptions& options, const std::string& sides) {
    command.add_option("--side", options.sides, sides)->type_name("SIDES");
    command
        .add_option("-p,--polarization", options.polarization,
                    "s, p or u (unpolarized: the mean of both) [u]")
        ->type_name("LETTER");
    offer(command, "polarization", "s p u");
}

void add_light_options(CLI::App& command, ColorOptions& options) {
    command
        .add_option("--illuminant", options.illuminant,
                    "D65, D50, A, E, FL2, FL11 or a CSV file of rows nm,power\n"
                    "(relative, interpolated linearly, 0 outside) [D65]")
        ->type_name("NAME");
    command.add_option("--observer", options.observer, "2 (CIE 1931) or 10 (CIE 1964) degrees [2]")
        ->type_name("DEGREES");
    offer(command, "illuminant", illuminant_names, OfferedWords::Use::one_or_file);
    offer(command, "observer", "2 10");
}

void add_strict_option(CLI::App& command, bool& strict) {
    command.add_flag("--strict", strict,
                     "refuse materials whose data do not cover 360 to 830 nm in a colour");
}

void add_space_options(CLI::App& command, ColorOptions& options) {
    command
        .add_option("--space", options.space,
                    "colour space of the result: srgb, rec2020, display-p3, acescg,\n"
                    "xyz [" +
                        options.space + "]")
        ->type_name("NAME");
    command
        .add_option("--adaptation", options.adaptation,
                    "chromatic adaptation to the white of the space: bradford (a\n"
                    "perfect mirror is r = g = b = 1) or none [bradford]")
        ->type_name("NAME");
    offer(command, "space", rgb_space_names);
    offer(command, "adaptation", "bradford none");
}

void add_colorimetry_options(CLI::App& command, ColorOptions& options) {
    add_light_options(command, options);
    add_strict_option(command, options.strict);
    add_space_options(command, options);
}

std::string color_method_help() {
    std::string text;
    bool has_baseline = false, has_film = false;
    for (const ColorMethodKind* const method : color_methods()) {
        const bool is_baseline = method->use == MethodUse::baseline;
        if (is_baseline && !has_baseline) text += ";\napproximate baselines, for comparison:";
        const bool starts_line = method->use == MethodUse::exact || (is_baseline && !has_baseline);
        if (!text.empty()) text += starts_line ? "\n" : "; ";
        if (method->needs_reflected_film && !has_film) text += "for light reflected by one film: ";
        text += method->help;
        has_baseline = has_baseline || is_baseline;
        has_film = has_film || method->needs_reflected_film;
    }
    return wrapped(text, kHelpWidth);
}

void add_color_options(CLI::App& command, ColorOptions& options) {
    add_side_options(command, options, "R (reflected), T (transmitted) or R,T [R]");
    offer(command, "side", "R T", OfferedWords::Use::several);
    add_light_options(command, options);
    add_space_options(command, options);
    command.add_option("--method", options.method, color_method_help())->type_name("METHOD");
    offer(command, "method", color_method_names);
    command
        .add_option("--subdivide", options.subdivide,
                    "for landmarks: split boxes next to gap m into S - m, [1, 1000] [1]")
        ->type_name("S");
    command
        .add_option("--harmonics", options.harmonics,
                    "for bloch: harmonics of the fringes, [0, 1000]; 0: their mean only\n"
                    "[as many as the tolerance needs]")
        ->type_name("M");
    command
        .add_option("--base-color", options.base_color,
                    "for gltf: the base colour, linear sRGB, each in [0, 1] [that of the bare\n"
                    "substrate in air at normal incidence]")
        ->type_name("R,G,B");
    command
        .add_option("--tolerance", options.tolerance,
                    "maximum error of X, Y, Z (white Y = 1), [" + to_text(kSmallestTolerance) +
                        ", 1] [" + to_text(kDefaultTolerance) +
                        "];\n"
                        "exit status 1 if it cannot be met. Approximate methods are held to\n"
                        "a tolerance only if one is given")
        ->type_name("T");
}

}  // namespace irido::cli
