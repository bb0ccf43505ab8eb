#pragma once

#include <string>
#include <vector>

namespace irido::tables {

/// Photonic gaps over wavelength and angle, as a picture: s to the left, p to the right.
struct BandDiagram {
    struct Edges {
        double short_nm = 0, long_nm = 0;
    };
    /// One gap at all angles.
    struct Gap {
        double order = 0;
        std::vector<Edges> s, p;  ///< one for each angle
    };
    std::string title;
    double first_nm = 360, last_nm = 830;  ///< the range shown
    std::vector<double> angles_deg;        ///< ascending, at least two
    std::vector<Gap> gaps;
};

/// An SVG 1.1 picture, 760 units wide. The strip at the axis has the hues of the wavelengths from
/// 380 to 780 nm: those of the CIE 1931 observer, brought into sRGB.
std::string write_band_diagram(const BandDiagram& diagram);

}  // namespace irido::tables
