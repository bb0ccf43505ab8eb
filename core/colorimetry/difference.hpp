#pragma once

#include "core/colorimetry/space.hpp"

namespace irido {

/// Largest absolute difference of a component.
double largest_difference(const Triple& a, const Triple& b);

/// CIE 1976 L*, a*, b* of XYZ relative to the white `white` (same scale, each component in [1e-6,
/// 1e6], else DomainError). The white is exactly {100, 0, 0}, black {0, 0, 0} up to rounding.
/// Source: CIE 15, Colorimetry, section 8.2; ISO/CIE 11664-4.
Triple lab(const Triple& xyz, const Triple& white);

/// Terms of CIEDE2000: dE^2 = l^2 + c^2 + h^2 + R c h with the weighted differences of lightness,
/// chroma and hue (second - first) and the rotation term R in (-2, 0].
struct DifferenceParts {
    double lightness, chroma, hue, rotation;
};
DifferenceParts ciede2000_parts(const Triple& lab1, const Triple& lab2);

/// Slope of the CIELAB lightness function, t^(1/3) above (6/29)^3, at t = X/Xn, Y/Yn or Z/Zn;
/// non-increasing in t.
double lab_slope(double t);

/// Upper bound on the error of each of L*, a* and b* if X, Y and Z of a colour have errors up to
/// `error` >= 0.
double lab_error(const Triple& xyz, const Triple& white, double error);

/// Error of X, Y and Z below which, for any colour under this white, L*, a*, b* are accurate to
/// `tolerance`, as are the colour differences of this file between similar colours.
double xyz_tolerance(const Triple& white, double tolerance);

/// CIE 1976 colour difference: the distance in CIELAB.
double delta_e_76(const Triple& lab1, const Triple& lab2);

/// CMC(l:c) colour difference of a sample from a standard; not symmetric.
///   standard, sample  CIELAB
///   l, c              weights of lightness and chroma: 2 and 1 for acceptability, 1 and 1 for
///                     perceptibility
/// Source: F. J. J. Clarke, R. McDonald, B. Rigg, J. Soc. Dyers Colour. 100, 128 (1984);
/// BS 6923; ISO 105-J03.
double delta_e_cmc(const Triple& standard, const Triple& sample, double l, double c);

/// CIEDE2000 colour difference of two CIELAB colours with kL = kC = kH = 1; symmetric. About 1 is
/// just noticeable. Hues within 1e-10 degrees of opposite are treated as opposite.
/// Source: G. Sharma, W. Wu, E. N. Dalal, Color Res. Appl. 30, 21 (2005).
double ciede2000(const Triple& lab1, const Triple& lab2);

}  // namespace irido
