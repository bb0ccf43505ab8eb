#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "tables/pictures/drawing.hpp"

namespace irido::tables {

/// Something that cannot be drawn; one line of text.
struct PictureError : Error {
    using Error::Error;
};

/// One axis of a panel, or of a colour bar.
struct FigureAxis {
    std::string quantity = {};  ///< in words
    std::string unit = {};      ///< "" for a pure number
    bool logarithmic = false;
    std::optional<double> first = {}, last = {};  ///< default: of the data; first > last reverses
    bool from_zero = false;  ///< widens the range to 0, unless the data are far from it
    bool hues = false;       ///< wavelengths in nm: adds a strip of the spectral colours
    double period = 0;       ///< of values that wrap: curves are cut at jumps of half of it
    double step = 0;         ///< between labels; 0: a round number
    std::vector<std::string> names = {};  ///< labels of 0, 1, 2, ... instead of numbers

    /// "vacuum wavelength, nm"
    std::string title() const { return unit.empty() ? quantity : quantity + ", " + unit; }
};

/// Points of one kind; x and y in axis units.
struct Series {
    /// guide: thin and grey; highlight: broad and pale
    enum class Form { line, line_with_points, points, bars, guide, highlight };
    std::string name = {};  ///< in the legend, once per name; "" for none
    std::size_t style = 0;  ///< colour, dashes and marker
    std::vector<Point> points = {};
    Form form = Form::line;
    std::vector<Ink> inks = {};  ///< one per point, instead of the style's
};

/// The area between two curves over x.
struct Area {
    std::string name = {};         ///< as for a series
    std::size_t style = 0;         ///< its colour
    std::string title = {};        ///< description, for formats that can show one
    std::string label = {};        ///< written where the area is tallest, or:
    bool label_in_middle = false;  ///< midway between its ends, if there is room
    std::vector<double> x = {}, low = {}, high = {};
};

/// Cells around samples of both axes, [y][x], coloured by their own inks or by values through the
/// panel's colour bar. Cells reach halfway to their neighbours; a value that is not finite leaves
/// its cell empty.
struct SampleGrid {
    std::vector<double> x, y;  ///< each ascending
    std::vector<Ink> inks = {};
    std::vector<double> values = {};
};

/// Text at a position.
struct Label {
    Point at;
    std::string text;
    std::optional<Point> away_from =
        {};  ///< seen from `at`, the label is opposite; none: to the right
};

struct Panel {
    std::string title = {};
    FigureAxis x = {}, y = {};
    std::vector<Series> series = {};
    std::vector<Area> areas = {};
    std::optional<SampleGrid> grid = {};
    FigureAxis bar = {};  ///< for the grid's values
    std::vector<Label> labels = {};
};

/// Panels in rows, with their explanations: the complete description of a picture by a command.
/// Shared labels are written once, at the bottom or on the left.
struct Figure {
    std::string title = {};
    std::string subtitle = {};
    std::vector<Panel> panels = {};
    std::size_t columns = 1;
    double width = 760;
    double panel_height = 0;   ///< 0: chosen by the number of panels
    bool equal_units = false;  ///< x and y have the same scale
    bool shared_x = false, shared_y = false;
    bool joined = false;  ///< columns touch each other
    std::vector<std::string> notes = {};
    std::string metadata = {};
};

/// Draws a figure. Colours are distinguishable for colour-blind readers, and dashes and markers
/// without colour; the legend is above the panels. Curves with more points than can be shown are
/// drawn as the band between their least and greatest values, with a note. Throws PictureError for
/// numbers that are not finite or too large, and if there is nothing to draw.
/// Source of the colours: M. Okabe and K. Ito, Color Universal Design (2008).
Drawing drawn(const Figure& figure);

}  // namespace irido::tables
