#pragma once

#include "core/colorimetry/observer.hpp"
#include "core/colorimetry/space.hpp"
#include "tables/pictures/figure.hpp"

namespace irido::tables {

/// A sequence of colours.
struct ChromaticityPath {
    std::string name;  ///< "" if it is the only one
    struct Stop {
        Triple xyz;  ///< omitted if its sum is 0 and so has no chromaticity
        Ink ink;
        std::string label;  ///< written next to some stops, including the first and the last
    };
    std::vector<Stop> stops;
};

/// Paths in the CIE 1931 diagram (x, y) and the CIE 1976 one (u', v'), side by side, with the
/// observer's spectral locus, the triangle of sRGB and the white point. Throws PictureError if no
/// stop of a path has a chromaticity.
/// title  the figure's title
/// paths  the paths
/// eye    whose spectral locus is drawn
/// white  XYZ of the white point
Figure chromaticity_figure(const std::string& title, const std::vector<ChromaticityPath>& paths,
                           const Observer& eye, const Triple& white);

}  // namespace irido::tables
