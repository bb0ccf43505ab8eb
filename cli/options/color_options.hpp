#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/command.hpp"
#include "core/color/color_request.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/colorimetry/sensitivity.hpp"
#include "core/colorimetry/space.hpp"

namespace irido::cli {

/// How a colour is asked for, as typed.
struct ColorOptions {
    std::string sides = "R";
    std::string polarization = "u";
    std::string illuminant = "D65";
    std::string observer = "2";
    std::string space = "srgb";
    std::string adaptation = "bradford";
    std::string method = "auto";
    std::string subdivide;   ///< "" if not typed
    std::string harmonics;   ///< "" if not typed
    std::string base_color;  ///< "" if not typed
    std::string tolerance;   ///< "" for that of ColorRequest
};

/// --side and -p; `sides` as the help shows them.
void add_side_options(CLI::App& command, ColorOptions& options, const std::string& sides);

/// --illuminant and --observer
void add_light_options(CLI::App& command, ColorOptions& options);

/// --space and --adaptation
void add_space_options(CLI::App& command, ColorOptions& options);

/// All of these, --method and --tolerance.
void add_color_options(CLI::App& command, ColorOptions& options);

// What was typed, in values; each throws UsageError.
std::vector<Side> parse_sides(const std::string& text);
Light parse_light(const std::string& text);
const RgbSpace& parse_space(const std::string& text);
Adaptation parse_adaptation(const std::string& text);
const Observer& parse_observer(const std::string& text);
double parse_tolerance(const std::string& text);

/// auto, quadrature, fourier, naive, ..., or one with a number, such as equal/32.
ColorMethod parse_method(const std::string& text);

/// The method with what --subdivide and --harmonics say.
ColorMethod parse_method(const ColorOptions& options);

/// That of --method gltf, linear sRGB, if it was typed.
std::optional<Triple> parse_base_color(const ColorOptions& options);

/// A named illuminant, or that of a file. Throws InputError if the file is at fault.
Table parse_illuminant(const std::string& text);

/// The method as it is typed.
std::string name_of(const ColorMethod& method);

std::string_view letter(Side side);

/// Says where a material holds its end values in colours, or refuses what no colour can be made of.
/// strict  refuses both. Throws InputError.
void report_held_ranges(const schemas::StackDocument& document, const Sensitivity& sensitivity,
                        bool strict, const std::function<void(const std::string&)>& say);

}  // namespace irido::cli
