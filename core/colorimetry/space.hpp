#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace irido {

using Triple = std::array<double, 3>;       ///< X Y Z or r g b
using ColorMatrix = std::array<Triple, 3>;  ///< rows

/// CIE 1931 x, y.
struct Chromaticity {
    double x = 0;
    double y = 0;
};

enum class Encoding { linear, srgb, bt2020 };

/// What defines an RGB space; its matrices follow from this.
struct RgbSpace {
    std::string_view name;
    std::array<Chromaticity, 3> primaries;  ///< red, green, blue
    Triple white;                           ///< XYZ of r = g = b = 1, Y = 1
    Encoding encoding = Encoding::linear;
};

/// srgb (IEC 61966-2-1), rec2020 (ITU-R BT.2020), display-p3 (SMPTE EG 432-1 primaries, D65, sRGB
/// encoding), acescg (Academy S-2014-004, AP1) or xyz (primaries X, Y, Z and white E: r, g, b are
/// X, Y, Z). Throws DomainError that lists the names if `name` is none of them.
const RgbSpace& rgb_space(std::string_view name);

/// Every name that rgb_space() knows, the default first.
std::span<const std::string_view> rgb_space_names();

/// Columns are the XYZ of the three primaries, scaled so that {1, 1, 1} is the space's white.
ColorMatrix xyz_from_rgb(const RgbSpace& space);

/// Inverse of xyz_from_rgb; exactly the identity for xyz.
ColorMatrix rgb_from_xyz(const RgbSpace& space);

/// Adaptation of XYZ from one white to another: the cone responses are scaled by the whites' ratio.
/// from, to  XYZ; each component and each cone response in [1e-6, 1e6], else DomainError. The white
///           of a nearly monochromatic illuminant may have a cone response below 0.
/// Source: K. M. Lam, thesis, University of Bradford (1985); matrix as in CIECAM97s (CIE 131).
ColorMatrix bradford(const Triple& from, const Triple& to);

enum class Adaptation { bradford, none };

/// Linear rgb of XYZ seen under the white `white` (XYZ, Y = 1).
/// With Adaptation::bradford the white itself becomes exactly {1, 1, 1}, in every space, and the
/// white has to satisfy bradford(); with Adaptation::none it plays no part.
class RgbTransform {
public:
    RgbTransform(const RgbSpace& space, const Triple& white, Adaptation adaptation);
    Triple operator()(const Triple& xyz) const;
    /// XYZ of a linear rgb: the inverse.
    Triple xyz_of(const Triple& rgb) const;

private:
    Adaptation adaptation_;
    Triple white_;
    ColorMatrix matrix_;  ///< acts on XYZ / white if adapted, else on XYZ
};

/// The space's encoding of one linear component in [0, 1], else DomainError; result in [0, 1].
double encoded(const RgbSpace& space, double linear);

/// The inverse of encoded(), for a value in [0, 1], else DomainError.
double decoded(const RgbSpace& space, double value);

/// Linear rgb, each in [0, 1], of "#rrggbb" in the space's encoding; hexadecimal digits of either
/// case. Throws DomainError for anything else.
Triple rgb_of_hex(const RgbSpace& space, std::string_view text);

/// "#rrggbb": encoded, clipped to [0, 1], rounded to the nearest of 256 levels. NaN is a
/// DomainError.
std::string hex(const RgbSpace& space, const Triple& linear_rgb);

/// True if all three components lie in [0, 1].
bool in_gamut(const Triple& linear_rgb);

}  // namespace irido
