#pragma once

#include <optional>

#include "core/colorimetry/observer.hpp"
#include "core/colorimetry/space.hpp"

namespace irido {

/// Chroma and hue from a colour's two chromatic coordinates (a*, b* or u*, v*).
struct ChromaHue {
    double chroma;
    std::optional<double> hue_deg;  ///< [0, 360); undefined below kAchromatic
};

/// Chroma, in CIELAB or CIELUV units, that rounding alone may give to a grey.
inline constexpr double kAchromatic = 1e-9;

ChromaHue chroma_hue(double first, double second);

/// CIE 1976 L*, u*, v* of XYZ relative to the white `white` (same scale, each component in [1e-6,
/// 1e6], else DomainError). u* = v* = 0 for black.
/// Source: CIE 15, Colorimetry, section 8.2.2; ISO/CIE 11664-5.
Triple luv(const Triple& xyz, const Triple& white);

/// Where the line from the white through a colour in the x, y diagram meets the boundary.
struct DominantWavelength {
    /// nm; negative: the complementary wavelength, if the line meets the purple line beyond the
    /// colour. Undefined for the white itself.
    std::optional<double> wavelength_nm;
    double purity = 0;  ///< excitation purity: 0 for the white, 1 on the boundary
};

/// Dominant wavelength and excitation purity. The spectral locus is taken from 380 to 699 nm with
/// X, Y and Z linear between rows (beyond, its direction depends on the last digits of the rows);
/// the purple line joins its ends. Colours within 1e-10 of the white in x and y, and black, count
/// as white.
///   xyz       the colour
///   white     XYZ; its chromaticity must lie inside the locus
///   observer  colour-matching functions of the locus
/// Source: CIE 15, Colorimetry, section 8.1.
DominantWavelength dominant_wavelength(const Triple& xyz, const Triple& white,
                                       const Observer& observer);

/// Whiteness W and tint T of a colour under D65; a perfect diffuser has W = 100, T = 0, with Y = 1
/// here. The formula is meant for near-whites; its limits of validity are not enforced.
struct Whiteness {
    double whiteness, tint;
};

/// observer_degrees  2 or 10, else DomainError
/// Source: CIE 15, Colorimetry, section 9.4.
Whiteness cie_whiteness(const Triple& xyz, const Triple& white, int observer_degrees);

}  // namespace irido
