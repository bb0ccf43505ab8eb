#pragma once

#include <string>
#include <vector>

namespace irido::tables {

/// Strips of colour along one axis, as a picture.
struct Swatches {
    struct Strip {
        std::string label;
        std::vector<std::string> colors;  ///< "#rrggbb", one for each position
    };
    std::string title;
    std::string axis;               ///< name and unit of the positions
    std::vector<double> positions;  ///< at least one
    std::vector<Strip> strips;
};

/// An SVG 1.1 picture of the strips, 720 units wide.
std::string write_swatches(const Swatches& swatches);

}  // namespace irido::tables
