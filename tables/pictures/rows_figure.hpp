#pragma once

#include "tables/pictures/figure.hpp"
#include "tables/records/records.hpp"

namespace irido::tables {

/// A column that tells rows apart.
struct RowKey {
    std::string column;
    FigureAxis axis;
    bool has_panels = false;  ///< points and curves of each of its values have a panel
};

/// A column that is drawn.
struct RowValue {
    std::string column;
    FigureAxis axis;
    std::string panel = {};  ///< values of the same panel are drawn over each other; by default
                             ///< each has its own
};

/// What the columns of records are, all that a command says of how its rows are drawn.
struct RowPlot {
    std::string title = {};
    std::vector<RowKey> keys = {};      ///< those first that are rather drawn along x
    std::vector<RowValue> values = {};  ///< or
    std::vector<Ink> inks = {};         ///< a colour for each row
    Series::Form form = Series::Form::line;
    std::vector<std::string> notes = {};
};

/// Draws rows over the keys that vary: curves, points or bars over one number; heat maps over two
/// where curves would be too many; colours as strips and maps. A column of values that are all 0
/// is left out if there are others, and a note says so. Throws PictureError where there are no
/// rows, or too many numbers vary.
Figure figure_of(const Records& records, const RowPlot& plot);

/// The values of a column of numbers, or of texts; throws PictureError if there is none.
std::vector<double> column_numbers(const Records& records, const std::string& name);
std::vector<std::string> column_texts(const Records& records, const std::string& name);

/// The axis of a column by its name, unit included: wavelength_nm, angle_deg, R, psi_deg, a path of
/// a stack.
FigureAxis axis_of_column(const std::string& name);

}  // namespace irido::tables
