#pragma once

#include "tables/pictures/figure.hpp"

namespace irido::tables {

/// Photonic band gaps over wavelength and angle.
struct BandDiagram {
    struct Edges {
        double short_nm = 0, long_nm = 0;
    };
    /// One gap at all angles.
    struct Gap {
        double order = 0;
        std::vector<Edges> s, p;  ///< one per angle
    };
    std::string title;
    double first_nm = 360, last_nm = 830;  ///< the range shown
    std::vector<double> angles_deg;        ///< ascending, at least two
    std::vector<Gap> gaps;
};

/// s on the left with its angles growing leftwards, p on the right.
Figure band_figure(const BandDiagram& diagram);

}  // namespace irido::tables
