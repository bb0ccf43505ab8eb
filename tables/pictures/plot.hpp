#pragma once

#include <string>
#include <vector>

namespace irido::tables {

/// Small panels in rows of four, with the same two logarithmic axes.
struct Plot {
    struct Point {
        double x = 0, y = 0;
    };
    /// Points of one kind, joined by a line.
    struct Series {
        std::size_t kind = 0;  ///< index into `legend`; gives colour and marker
        std::vector<Point> points;
    };
    struct Panel {
        std::string title;
        std::vector<Point> highlight;  ///< a broad pale line behind the series
        std::vector<Series> series;
    };
    /// From one power of ten to another; what lies outside is drawn on the edge.
    struct Axis {
        std::string title;  ///< name and unit
        int first_power = 0, last_power = 1;
    };
    std::string title;
    Axis x, y;
    std::vector<std::string> legend;  ///< names of the kinds
    std::string highlight;            ///< legend of the pale line, "" for none
    std::vector<Panel> panels;
};

/// An SVG 1.1 picture, 1080 units wide. Colours keep apart for the colour-blind (M. Okabe and
/// K. Ito, Color Universal Design, 2008), markers for those who see none.
std::string write_plot(const Plot& plot);

}  // namespace irido::tables
