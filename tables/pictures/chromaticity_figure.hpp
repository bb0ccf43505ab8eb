#pragma once

#include "core/colorimetry/observer.hpp"
#include "core/colorimetry/space.hpp"
#include "tables/pictures/figure.hpp"

namespace irido::tables {

/// Colours that follow each other.
struct ChromaticityPath {
    std::string name;  ///< "" if it is the only one
    struct Stop {
        Triple xyz;  ///< a sum of 0 has no place and is left out
        Ink ink;
        std::string label;  ///< written beside some of the stops, the first and the last among them
    };
    std::vector<Stop> stops;
};

/// Paths in the CIE 1931 diagram, x and y, and the CIE 1976 one, u' and v', side by side, with the
/// observer's spectral locus, the triangle of sRGB and the white point. Throws PictureError if no
/// stop of a path has a place.
Figure chromaticity_figure(const std::string& title, const std::vector<ChromaticityPath>& paths,
                           const Observer& eye, const Triple& white);

}  // namespace irido::tables
