#pragma once

#include <string>
#include <vector>

#include "cli/command.hpp"
#include "core/color/color_request.hpp"
#include "core/color/observer.hpp"
#include "core/color/space.hpp"

namespace irido {

/// How a colour is asked for, as typed.
struct ColorOptions {
    std::string sides = "R";
    std::string polarization = "u";
    std::string illuminant = "D65";
    std::string observer = "2";
    std::string space = "srgb";
    std::string adaptation = "bradford";
    std::string method = "auto";
    std::string tolerance;  ///< "" for that of ColorRequest
};

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

/// A named illuminant, or that of a file. Throws InputError if the file is at fault.
Table parse_illuminant(const std::string& text);

/// The method as it is typed.
std::string name_of(const ColorMethod& method);

std::string_view letter(Side side);

}  // namespace irido
