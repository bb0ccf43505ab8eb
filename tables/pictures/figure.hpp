#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "tables/pictures/drawing.hpp"

namespace irido::tables {

/// What cannot be drawn; one line of text.
struct PictureError : Error {
    using Error::Error;
};

/// What lies along one side of a panel, or of a bar of colours.
struct FigureAxis {
    std::string quantity = {};  ///< in words
    std::string unit = {};      ///< "" for a pure number
    bool logarithmic = false;
    std::optional<double> first = {}, last = {};  ///< ends; by default those of the data. first
                                                  ///< above last: the axis runs backwards
    bool from_zero = false;  ///< the data's range is widened to 0, unless it is far from there
    bool hues = false;       ///< wavelengths in nm: with a strip of what the eye sees of each
    double period = 0;       ///< of values that wrap: a curve is cut where it jumps by half of it
    double step = 0;         ///< between labels; 0: a round number
    std::vector<std::string> names = {};  ///< labels of 0, 1, 2, ... instead of numbers

    /// "vacuum wavelength, nm"
    std::string title() const { return unit.empty() ? quantity : quantity + ", " + unit; }
};

/// Points of one kind; x and y as on the axes.
struct Series {
    /// guide: thin and grey; highlight: broad and pale
    enum class Form { line, line_with_points, points, bars, guide, highlight };
    std::string name = {};  ///< in the legend, once for all that have it; "" for none
    std::size_t style = 0;  ///< colour, dashes and marker
    std::vector<Point> points = {};
    Form form = Form::line;
    std::vector<Ink> inks = {};  ///< of the points one by one, instead of the style's
};

/// What lies between two curves over x.
struct Area {
    std::string name = {};         ///< as of a series
    std::size_t style = 0;         ///< its colour
    std::string title = {};        ///< what it is, where a picture can say so
    std::string label = {};        ///< written where it is tallest, or:
    bool label_in_middle = false;  ///< between its ends, if there is room
    std::vector<double> x = {}, low = {}, high = {};
};

/// Cells around samples of both axes, [y][x]: of their own inks, or of values, which get theirs
/// from the panel's bar. Cells reach halfway to their neighbours; a value that is not finite leaves
/// its cell empty.
struct SampleGrid {
    std::vector<double> x, y;  ///< each ascending
    std::vector<Ink> inks = {};
    std::vector<double> values = {};
};

/// Text at a place.
struct Label {
    Point at;
    std::string text;
    std::optional<Point> away_from =
        {};  ///< on which other side of `at` it stands; else right of it
};

struct Panel {
    std::string title = {};
    FigureAxis x = {}, y = {};
    std::vector<Series> series = {};
    std::vector<Area> areas = {};
    std::optional<SampleGrid> grid = {};
    FigureAxis bar = {};  ///< of the grid's values
    std::vector<Label> labels = {};
};

/// Panels in rows, with what explains them: all that a command says of a picture. What is shared is
/// written once, at the bottom or at the left.
struct Figure {
    std::string title = {};
    std::string subtitle = {};
    std::vector<Panel> panels = {};
    std::size_t columns = 1;
    double width = 760;
    double panel_height = 0;   ///< 0: by their number
    bool equal_units = false;  ///< a unit of x is as long as one of y
    bool shared_x = false, shared_y = false;
    bool joined = false;  ///< columns touch each other
    std::vector<std::string> notes = {};
    std::string metadata = {};
};

/// Colours keep apart for the colour-blind, dashes and markers for those who see no colours; the
/// legend stands above the panels. Curves of more points than can be seen are drawn as what lies
/// between their least and greatest values, and a note says so. Throws PictureError for numbers
/// that are not finite or too large to be drawn, and where there is nothing to draw.
/// Source of the colours: M. Okabe and K. Ito, Color Universal Design (2008).
Drawing drawn(const Figure& figure);

}  // namespace irido::tables
