#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/command.hpp"
#include "core/color/color_method.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/colorimetry/sensitivity.hpp"
#include "core/colorimetry/space.hpp"

namespace irido::cli {

/// Options of a colour, as given on the command line.
struct ColorOptions {
    std::string sides = "R";
    std::string polarization = "u";
    std::string illuminant = "D65";
    std::string observer = "2";
    std::string space = "srgb";
    std::string adaptation = "bradford";
    std::string method = "auto";
    std::string subdivide;   ///< "" if not given
    std::string harmonics;   ///< "" if not given
    std::string base_color;  ///< "" if not given
    std::string tolerance;   ///< "" for the default
    bool strict = false;     ///< refuse materials that colours clamp
};

/// Adds --strict, to every command that may call report_held_ranges().
void add_strict_option(CLI::App& command, bool& strict);

/// Adds --side and -p; `sides` is the help text for --side.
void add_side_options(CLI::App& command, ColorOptions& options, const std::string& sides);

/// Adds --illuminant and --observer.
void add_light_options(CLI::App& command, ColorOptions& options);

/// Adds --space, with the default from `options`, and --adaptation.
void add_space_options(CLI::App& command, ColorOptions& options);

/// Adds --illuminant, --observer, --strict, --space and --adaptation.
void add_colorimetry_options(CLI::App& command, ColorOptions& options);

/// Adds all options of a colour.
void add_color_options(CLI::App& command, ColorOptions& options);

// Parsers of option values; each throws UsageError.
std::vector<Side> parse_sides(const std::string& text);
Light parse_light(const std::string& text);
const RgbSpace& parse_space(const std::string& text);
Adaptation parse_adaptation(const std::string& text);
const Observer& parse_observer(const std::string& text);
double parse_tolerance(const std::string& text);

/// A method by name, with or without a number: auto, quadrature, equal/32.
ColorMethod parse_method(const std::string& text);

/// Names of the colour methods, without their numbers.
std::vector<std::string_view> color_method_names();

/// What --help says of every method.
std::string color_method_help();

/// The method, with --subdivide, --harmonics and --base-color applied.
ColorMethod parse_method(const ColorOptions& options);

/// A named illuminant, or one read from a file. Throws InputError for errors of the file.
Table parse_illuminant(const std::string& text);

/// The method as written after --method.
std::string name_of(const ColorMethod& method);

std::string_view letter(Side side);

/// Notes every material that colours clamp to its end values because its data do not cover 360 to
/// 830 nm. Throws InputError if they do not cover 400 to 700 nm.
/// document     the stack, and the file to name in messages
/// sensitivity  determines the fraction of X, Y, Z affected
/// strict       throw InputError instead of noting
/// say          receives the text of a note
void report_held_ranges(const schemas::StackDocument& document, const Sensitivity& sensitivity,
                        bool strict, const std::function<void(const std::string&)>& say);

}  // namespace irido::cli
