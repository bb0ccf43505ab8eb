#include "cli/queries/color_columns.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "cli/options/list.hpp"
#include "core/colorimetry/color_terms.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/error.hpp"

namespace irido::cli {

namespace {

/// Names on the command line, in the order of ColorColumn.
constexpr std::array<std::string_view, 17> kColorNames{"L",
                                                       "a",
                                                       "b",
                                                       "C_ab",
                                                       "h_ab_deg",
                                                       "u",
                                                       "v",
                                                       "C_uv",
                                                       "h_uv_deg",
                                                       "dominant_nm",
                                                       "excitation_purity",
                                                       "whiteness_cie",
                                                       "tint_cie",
                                                       "delta_e_76",
                                                       "delta_e_2000",
                                                       "delta_e_cmc_2_1",
                                                       "delta_e_cmc_1_1"};

constexpr double kNoColorValue = std::numeric_limits<double>::quiet_NaN();

bool is_difference(ColorColumn column) {
    return column >= ColorColumn::delta_e_76;
}

ColorColumn color_column_of(std::string_view name) {
    const auto found = std::ranges::find(kColorNames, name);
    if (found != kColorNames.end()) return static_cast<ColorColumn>(found - kColorNames.begin());
    throw UsageError("--columns: " + not_one_of(kColorNames, name));
}

}  // namespace

std::span<const std::string_view> color_column_names() {
    return kColorNames;
}

std::string name_of(ColorColumn column) {
    return std::string(kColorNames[static_cast<std::size_t>(column)]);
}

std::vector<ColorColumn> parse_color_columns(std::string_view text, bool has_target) {
    std::vector<ColorColumn> columns;
    if (!text.empty())
        for (const std::string_view name : comma_separated(text)) {
            const ColorColumn column = color_column_of(name);
            if (std::ranges::find(columns, column) != columns.end())
                throw UsageError("--columns: each column must be named once (got " +
                                 std::string(name) + " twice)");
            if (is_difference(column) && !has_target)
                throw UsageError("--columns: " + std::string(name) + " requires --target");
            columns.push_back(column);
        }
    if (!has_target || std::ranges::any_of(columns, is_difference)) return columns;
    using enum ColorColumn;
    columns.insert(columns.end(), {delta_e_76, delta_e_2000, delta_e_cmc_2_1, delta_e_cmc_1_1});
    return columns;
}

ColorTarget::ColorTarget(const std::string& text, const RgbSpace& space)
    : is_rgb_(text.starts_with('#')) {
    if (is_rgb_) {
        try {
            value_ = rgb_of_hex(space, text);
        } catch (const DomainError& error) {
            throw UsageError("--target: " + std::string(error.what()));
        }
        return;
    }
    constexpr double kMostLightness = 1000, kMostChroma = 1000;
    const std::vector<std::string_view> parts = comma_separated(text);
    if (parts.size() != 3)
        throw UsageError("--target: must be #rrggbb or L,a,b (got '" + text + "')");
    for (std::size_t i = 0; i < 3; ++i)
        value_[i] = i == 0 ? parse_one_number("--target: L", parts[0], 0, kMostLightness)
                           : parse_one_number(i == 1 ? "--target: a" : "--target: b", parts[i],
                                              -kMostChroma, kMostChroma);
}

Triple ColorTarget::lab(const RgbTransform& transform, const Triple& white) const {
    return is_rgb_ ? irido::lab(transform.xyz_of(value_), white) : value_;
}

double color_column_value(ColorColumn column, const Triple& xyz, const ColorView& view) {
    using enum ColorColumn;
    const auto of_lab = [&] { return lab(xyz, view.white); };
    const auto polar_lab = [&] {
        const Triple color = of_lab();
        return chroma_hue(color[1], color[2]);
    };
    const auto of_luv = [&] { return luv(xyz, view.white); };
    const auto polar_luv = [&] {
        const Triple color = of_luv();
        return chroma_hue(color[1], color[2]);
    };
    switch (column) {
        case L:
            return of_lab()[0];
        case a:
            return of_lab()[1];
        case b:
            return of_lab()[2];
        case C_ab:
            return polar_lab().chroma;
        case h_ab_deg:
            return polar_lab().hue_deg.value_or(kNoColorValue);
        case u:
            return of_luv()[1];
        case v:
            return of_luv()[2];
        case C_uv:
            return polar_luv().chroma;
        case h_uv_deg:
            return polar_luv().hue_deg.value_or(kNoColorValue);
        case dominant_nm:
            return dominant_wavelength(xyz, view.white, view.observer)
                .wavelength_nm.value_or(kNoColorValue);
        case excitation_purity:
            return dominant_wavelength(xyz, view.white, view.observer).purity;
        case whiteness_cie:
            if (!view.has_whiteness) return kNoColorValue;
            return cie_whiteness(xyz, view.white, view.observer_degrees).whiteness;
        case tint_cie:
            if (!view.has_whiteness) return kNoColorValue;
            return cie_whiteness(xyz, view.white, view.observer_degrees).tint;
        case ColorColumn::delta_e_76:
            return irido::delta_e_76(view.target.value(), of_lab());
        case delta_e_2000:
            return ciede2000(view.target.value(), of_lab());
        case delta_e_cmc_2_1:
            return delta_e_cmc(view.target.value(), of_lab(), 2, 1);
        case delta_e_cmc_1_1:
            return delta_e_cmc(view.target.value(), of_lab(), 1, 1);
    }
    return kNoColorValue;
}

}  // namespace irido::cli
