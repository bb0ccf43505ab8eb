#include "cli/options/cone_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/options/list.hpp"
#include "core/error.hpp"

namespace irido::cli {

void add_cone_options(CLI::App& command, ConeOptions& options) {
    command
        .add_option("--cone", options.half_angle,
                    "mean over a cone of uniform radiance about each angle, its half-angle\n"
                    "in degrees in the incident medium; it must end at 90 degrees or\n"
                    "before. -p is the polarization before the lens that makes the cone")
        ->type_name("DEG");
    command
        .add_option("--f-number", options.f_number,
                    "the same for an aplanatic lens of f-number N, n sin(half-angle) =\n"
                    "1/(2N): f/1 is 30 degrees in air")
        ->type_name("N");
}

ConeSize parse_cone(const ConeOptions& options, std::span<const double> angles_deg) {
    ConeSize size;
    if (!options.half_angle.empty() && !options.f_number.empty())
        throw UsageError("--cone and --f-number are mutually exclusive");
    if (!options.half_angle.empty())
        size.half_angle_deg = parse_one_number("--cone", options.half_angle, 0, kLargestAngle_deg);
    constexpr double kNarrowest_deg = 1e-12;  // roundings of the axis: a ray
    if (size.half_angle_deg < kNarrowest_deg) size.half_angle_deg = 0;
    constexpr double kLeast = 1e-3, kMost = 1e6;
    if (!options.f_number.empty()) {
        size.f_number = parse_one_number("--f-number", options.f_number, 0, kMost);
        if (size.f_number < kLeast)
            throw UsageError("--f-number: must be at least 1/(2 n), which is 0.5 in air (got " +
                             to_text(size.f_number) + ")");
    }
    if (size.f_number != 0) return size;  // its half-angle depends on the incident medium
    const double last = std::ranges::max(angles_deg) + size.half_angle_deg;
    if (!size.is_none() && !(last <= kLargestAngle_deg))
        throw UsageError("--cone: angle and half-angle together must be at most 90 degrees (got " +
                         to_text(std::ranges::max(angles_deg)) + " + " +
                         to_text(size.half_angle_deg) + ")");
    return size;
}

}  // namespace irido::cli
