#pragma once

#include <optional>

#include "core/colorimetry/observer.hpp"
#include "core/colorimetry/space.hpp"

namespace irido {

/// Chroma and hue of a colour whose two chromatic coordinates are given (a*, b* or u*, v*).
struct ChromaHue {
    double chroma;
    std::optional<double> hue_deg;  ///< [0, 360); none below kAchromatic
};

/// Chromas, in units of CIELAB or CIELUV, that rounding alone may give to a grey.
inline constexpr double kAchromatic = 1e-9;

ChromaHue chroma_hue(double first, double second);

/// CIE 1976 L*, u*, v* of XYZ under the white `white` (XYZ on the same scale, each in [1e-6, 1e6],
/// else DomainError). u* = v* = 0 for black.
/// Source: CIE 15, Colorimetry, section 8.2.2; ISO/CIE 11664-5.
Triple luv(const Triple& xyz, const Triple& white);

/// Where the straight line in the x, y diagram from the white through a colour meets the boundary.
struct DominantWavelength {
    /// nm; negative: the complementary wavelength, where the line meets the purple line in front of
    /// the colour. None for the white itself.
    std::optional<double> wavelength_nm;
    double purity = 0;  ///< excitation purity: 0 for the white, 1 on the boundary
};

/// The spectral locus is the observer's from 380 to 699 nm, X, Y and Z being linear between its
/// rows: beyond, the direction of the rows' last digits decides. The purple line joins its ends.
/// Colours less than 1e-10 away from the white in x and y, black included, are the white.
/// white  XYZ, its chromaticity inside of the locus
/// Source: CIE 15, Colorimetry, section 8.1.
DominantWavelength dominant_wavelength(const Triple& xyz, const Triple& white,
                                       const Observer& observer);

/// Whiteness W and tint T of a colour under D65; a perfect diffuser has W = 100, T = 0, Y = 1 here.
/// The formula is made for near whites; nothing is cut off here.
struct Whiteness {
    double whiteness, tint;
};

/// observer_degrees  2 or 10, else DomainError
/// Source: CIE 15, Colorimetry, section 9.4.
Whiteness cie_whiteness(const Triple& xyz, const Triple& white, int observer_degrees);

}  // namespace irido
