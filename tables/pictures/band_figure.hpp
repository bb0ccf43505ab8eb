#pragma once

#include "tables/pictures/figure.hpp"

namespace irido::tables {

/// Photonic gaps over wavelength and angle.
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

/// s to the left, its angles growing to the left, p to the right.
Figure band_figure(const BandDiagram& diagram);

}  // namespace irido::tables
