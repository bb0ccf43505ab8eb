#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/colorimetry/observer.hpp"
#include "core/colorimetry/space.hpp"

namespace irido::cli {

/// Optional columns of a colour, in addition to X, Y, Z, x, y and RGB.
enum class ColorColumn {
    L,
    a,
    b,
    C_ab,
    h_ab_deg,
    u,
    v,
    C_uv,
    h_uv_deg,
    dominant_nm,
    excitation_purity,
    whiteness_cie,
    tint_cie,
    delta_e_76,
    delta_e_2000,
    delta_e_cmc_2_1,
    delta_e_cmc_1_1,
};

/// Largest error of L*, a*, b* and of colour differences in these columns.
inline constexpr double kColorColumnError = 1e-4;

/// The names of all columns.
std::span<const std::string_view> color_column_names();

/// Parses "L,a,b" into columns, in that order; none for "". With a target, all differences are
/// added unless some are named. Throws UsageError for unknown or repeated names, and for
/// differences without a target.
std::vector<ColorColumn> parse_color_columns(std::string_view text, bool has_target);

std::string name_of(ColorColumn column);

/// A reference colour, as given: "#rrggbb" or "L,a,b". Throws UsageError.
class ColorTarget {
public:
    /// space  the space in whose encoding "#rrggbb" is given
    ColorTarget(const std::string& text, const RgbSpace& space);

    /// CIELAB relative to the white of `transform`; "#rrggbb" means the colour with that rgb.
    Triple lab(const RgbTransform& transform, const Triple& white) const;

private:
    bool is_rgb_;
    Triple value_{};
};

/// The conditions under which the columns of a colour are computed.
struct ColorView {
    const Observer& observer;
    int observer_degrees;          ///< 2 or 10
    Triple white;                  ///< XYZ
    bool has_whiteness;            ///< the illuminant is D65
    std::optional<Triple> target;  ///< CIELAB
};

/// The value of a column for a colour; NaN where it is undefined: the hue of greys, the dominant
/// wavelength of white, whiteness under illuminants other than D65.
double color_column_value(ColorColumn column, const Triple& xyz, const ColorView& view);

}  // namespace irido::cli
