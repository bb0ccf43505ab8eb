#include "tables/lut/color_values.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/color/held_stack.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/error.hpp"
#include "schemas/documents/canonical_stack.hpp"
#include "tables/lut/kind_parts.hpp"
#include "tables/lut/light_facts.hpp"

namespace irido::tables {

namespace {

constexpr std::string_view kXyz = "xyz";

/// Largest CIEDE2000 per unit of X, Y and Z, that of X next to black: 3/2 (of a') 500 (903.3/116/3)
/// / 0.95 is 2050 along a*, and the errors of the others add up to twice as much.
constexpr double kSteepest = 6000;

/// Rougher colours are never asked for.
constexpr double kRoughestColor = 1e-4;

Triple product(const ColorMatrix& matrix, const Triple& v) {
    Triple result{};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = matrix[i][0] * v[0] + matrix[i][1] * v[1] + matrix[i][2] * v[2];
    return result;
}

bool is_adapted(const LutRequest& request) {
    return request.space->name != kXyz && request.adaptation == Adaptation::bradford;
}

Triple triple_at(std::span<const double> values, std::size_t i) {
    return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

}  // namespace

std::vector<std::string> color_channels(const LutRequest& request) {
    if (request.space->name == kXyz) return {"X", "Y", "Z"};
    return {"R", "G", "B"};
}

ColorValues::ColorValues(const LutRequest& request)
    : is_xyz_(request.space->name == kXyz),
      transform_(*request.space, request.sensitivity->white(), request.adaptation),
      xyz_from_value_(xyz_from_rgb(*request.space)),
      white_(is_adapted(request) ? request.space->white : request.sensitivity->white()) {}

Triple ColorValues::operator()(const Triple& xyz) const {
    return is_xyz_ ? xyz : transform_(xyz);
}

Triple ColorValues::to_lab(const Triple& value) const {
    return lab(is_xyz_ ? value : product(xyz_from_value_, value), white_);
}

LutMeasure color_measure(const LutRequest& request) {
    return {"delta_e_2000", [values = ColorValues(request)](const std::vector<LutAxis>&,
                                                            std::span<const double> exact,
                                                            std::span<const double> approximate) {
                std::vector<double> result(exact.size() / 3);
                for (std::size_t i = 0; i < result.size(); ++i)
                    result[i] = ciede2000(values.to_lab(triple_at(exact, i)),
                                          values.to_lab(triple_at(approximate, i)));
                return result;
            }};
}

LutRequest rougher(LutRequest request, double error) {
    request.color.tolerance =
        std::max(request.color.tolerance, std::min(kRoughestColor, error / kSteepest));
    return request;
}

nlohmann::json color_facts(const LutRequest& request) {
    nlohmann::json facts = light_facts(request);
    facts["color_space"] = request.space->name;
    facts["stack"] = schemas::canonical_stack(request.document.stack);
    facts["request"].update({{"side", request.color.sides.front() == Side::reflected ? "R" : "T"},
                             {"polarization", letter_of(request.color.light)},
                             {"adaptation", is_adapted(request) ? "bradford" : "none"},
                             {"color_tolerance", request.color.tolerance}});
    const WavelengthRange seen = request.sensitivity->support();
    if (amplifies(held_stack(request.document.stack, *request.sensitivity),
                  equally_spaced(seen.first_nm, seen.last_nm, 101)))
        facts["request"]["amplifies"] = true;
    return facts;
}

std::vector<std::string> color_problems(const Lut& lut) {
    constexpr double rounding = 1e-2, largest_rgb = 4;  // spectral colours in small spaces
    std::vector<std::string> problems;
    if (lut.facts.at("request").contains("amplifies")) return problems;  // no upper bound
    const bool is_xyz = lut.channels.front() == "X";
    const auto& white = lut.facts.at("request").at("white_xyz");
    for (std::size_t i = 0; i < lut.values.size() && problems.empty(); ++i) {
        const double value = lut.values[i];
        const double most = is_xyz ? white[i % 3].get<double>() : largest_rgb;
        const double least = is_xyz ? 0 : -largest_rgb;
        if (value < least - rounding || value > most + rounding)
            problems.push_back(lut.channels[i % 3] +
                               (lut.mips ? "" : " at " + place_in(lut, i / 3)) +
                               " must be the colour of reflected or transmitted light (got " +
                               to_text(value) + ")");
    }
    return problems;
}

std::string unit_of_path(const std::string& path) {
    return path.ends_with("_nm") ? "nm" : "";
}

}  // namespace irido::tables
