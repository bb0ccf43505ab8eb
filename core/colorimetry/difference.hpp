#pragma once

#include "core/colorimetry/space.hpp"

namespace irido {

/// Largest difference of a component.
double largest_difference(const Triple& a, const Triple& b);

/// CIE 1976 L*, a*, b* of XYZ under the white `white` (XYZ on the same scale, each in [1e-6, 1e6],
/// else DomainError). The white is exactly {100, 0, 0}, black {0, 0, 0} up to rounding.
/// Source: CIE 15, Colorimetry, section 8.2; ISO/CIE 11664-4.
Triple lab(const Triple& xyz, const Triple& white);

/// Bound of how far L*, a* and b* move, each, if X, Y and Z of a colour move by up to `error` >= 0.
double lab_error(const Triple& xyz, const Triple& white, double error);

/// The error of X, Y and Z, for any colour under this white, below which L*, a*, b* are good to
/// `tolerance`, and the differences of this file for colours that are not far apart.
double xyz_tolerance(const Triple& white, double tolerance);

/// CIE 1976 colour difference: the distance in CIELAB.
double delta_e_76(const Triple& lab1, const Triple& lab2);

/// CMC(l:c) colour difference of a sample from a standard, both CIELAB; not symmetric. l = 2, c = 1
/// is acceptability, l = c = 1 perceptibility.
/// Source: F. J. J. Clarke, R. McDonald, B. Rigg, J. Soc. Dyers Colour. 100, 128 (1984);
/// BS 6923; ISO 105-J03.
double delta_e_cmc(const Triple& standard, const Triple& sample, double l, double c);

/// CIEDE2000 colour difference of two CIELAB colours, kL = kC = kH = 1; symmetric. About 1 is just
/// noticeable. Hues within 1e-10 degrees of opposite count as opposite.
/// Source: G. Sharma, W. Wu, E. N. Dalal, Color Res. Appl. 30, 21 (2005).
double ciede2000(const Triple& lab1, const Triple& lab2);

}  // namespace irido
