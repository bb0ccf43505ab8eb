#pragma once

#include <array>
#include <string_view>

#include "core/colorimetry/space.hpp"
#include "tables/pictures/drawing.hpp"

namespace irido::tables {

/// How colours outside sRGB are shown.
enum class GamutMapping {
    clip,      ///< each component clamped to [0, 1]
    compress,  ///< mixed with the grey of its luminance, just enough to fit; luminances above 1
               ///< become white
};

/// "clip" or "compress".
inline constexpr std::array kGamutMappings{GamutMapping::clip, GamutMapping::compress};
std::string_view name_of(GamutMapping mapping);

/// Converts linear sRGB to inks and counts colours that lie outside sRGB by more than rounding.
class InkMixer {
public:
    explicit InkMixer(GamutMapping mapping = GamutMapping::clip) : mapping_(mapping) {}

    Ink operator()(const Triple& linear_srgb);
    /// "12 % of the colours lie outside sRGB, 3 % are brighter than white: both are clipped"; ""
    /// if none do. Brighter than white are colours of sRGB's hues with a luminance above 1.
    std::string note() const;

private:
    GamutMapping mapping_;
    std::size_t colors_ = 0, outside_ = 0, bright_ = 0;
};

/// The ink of linear sRGB with each component clamped to [0, 1].
Ink clipped_ink(const Triple& linear_srgb);

/// Dark blue to pale yellow for `part` in [0, 1], with lightness L* increasing linearly from 15 to
/// 93: legible without colour vision and in print.
Ink value_ink(double part);

/// The spectral colour of a wavelength, paler where the eye is less sensitive: the CIE 1931
/// observer's colour, brought into sRGB by adding white. White outside 380 to 780 nm.
Ink wavelength_ink(double wavelength_nm);

inline constexpr double kFirstVisible_nm = 380, kLastVisible_nm = 780;

}  // namespace irido::tables
