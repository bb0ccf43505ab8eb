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

/// Definition of an RGB space, from which its matrices follow.
struct RgbSpace {
    std::string_view name;
    std::array<Chromaticity, 3> primaries;  ///< red, green, blue
    Triple white;                           ///< XYZ of r = g = b = 1, Y = 1
    Encoding encoding = Encoding::linear;
};

/// srgb (IEC 61966-2-1), rec2020 (ITU-R BT.2020), display-p3 (SMPTE EG 432-1 primaries, D65, sRGB
/// encoding), acescg (Academy S-2014-004, AP1) or xyz (primaries X, Y, Z and white E: r, g, b are
/// X, Y, Z). Throws DomainError listing the names if `name` is unknown.
const RgbSpace& rgb_space(std::string_view name);

/// All names that rgb_space() accepts, the default first.
std::span<const std::string_view> rgb_space_names();

/// Matrix from linear rgb to XYZ: its columns are the XYZ of the primaries, scaled so that {1, 1,
/// 1} is the space's white.
ColorMatrix xyz_from_rgb(const RgbSpace& space);

/// Matrix from XYZ to linear rgb; exactly the identity for xyz.
ColorMatrix rgb_from_xyz(const RgbSpace& space);

/// Bradford adaptation of XYZ from one white to another: cone responses are scaled by the ratio of
/// the whites.
///   from, to  XYZ; each component and cone response in [1e-6, 1e6], else DomainError (the white of
///             a nearly monochromatic illuminant may have a negative cone response)
/// Source: K. M. Lam, thesis, University of Bradford (1985); matrix as in CIECAM97s (CIE 131).
ColorMatrix bradford(const Triple& from, const Triple& to);

enum class Adaptation { bradford, none };

/// Conversion of XYZ, seen under the white `white` (XYZ, Y = 1), to linear rgb. With
/// Adaptation::bradford the white maps to exactly {1, 1, 1} in every space and must satisfy
/// bradford(); with Adaptation::none it is ignored.
class RgbTransform {
public:
    RgbTransform(const RgbSpace& space, const Triple& white, Adaptation adaptation);
    Triple operator()(const Triple& xyz) const;
    /// XYZ of a linear rgb, the inverse transform.
    Triple xyz_of(const Triple& rgb) const;

private:
    Adaptation adaptation_;
    Triple white_;
    ColorMatrix matrix_;  ///< applied to XYZ / white if adapted, else to XYZ
};

/// Encodes one linear component in [0, 1], else DomainError; the result is in [0, 1].
double encoded(const RgbSpace& space, double linear);

/// Inverse of encoded(), for a value in [0, 1], else DomainError.
double decoded(const RgbSpace& space, double value);

/// Linear rgb, each in [0, 1], from "#rrggbb" in the space's encoding, with digits of either case.
/// Throws DomainError for anything else.
Triple rgb_of_hex(const RgbSpace& space, std::string_view text);

/// "#rrggbb": encoded, clipped to [0, 1] and rounded to 8 bits. Throws DomainError for NaN.
std::string hex(const RgbSpace& space, const Triple& linear_rgb);

/// Whether all three components lie in [0, 1].
bool in_gamut(const Triple& linear_rgb);

}  // namespace irido
