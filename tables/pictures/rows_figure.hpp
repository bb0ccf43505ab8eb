#pragma once

#include "tables/pictures/figure.hpp"
#include "tables/records/records.hpp"

namespace irido::tables {

/// A column that distinguishes rows.
struct RowKey {
    std::string column;
    FigureAxis axis;
    bool has_panels = false;  ///< each of its values gets a panel for points and curves
};

/// A column to be drawn.
struct RowValue {
    std::string column;
    FigureAxis axis;
    std::string panel = {};  ///< values with the same panel share it; by default each has its own
};

/// The meaning of the columns of records: all that a command specifies about plotting its rows.
struct RowPlot {
    std::string title = {};
    std::vector<RowKey> keys = {};      ///< in order of preference for the x axis
    std::vector<RowValue> values = {};  ///< or
    std::vector<Ink> inks = {};         ///< one colour per row
    Series::Form form = Series::Form::line;
    std::vector<std::string> notes = {};
};

/// Draws rows over the keys that vary: curves, points or bars over one number; heat maps over two
/// where curves would be too many; colours as strips and maps. A column of zeros is left out, with
/// a note, if there are other columns. Throws PictureError if there are no rows or too many numbers
/// vary.
Figure figure_of(const Records& records, const RowPlot& plot);

/// The values of a column of numbers, or of strings; throws PictureError if there is none.
std::vector<double> column_numbers(const Records& records, const std::string& name);
std::vector<std::string> column_texts(const Records& records, const std::string& name);

/// The axis for a column name that includes the unit: wavelength_nm, angle_deg, R, psi_deg, or a
/// path in a stack.
FigureAxis axis_of_column(const std::string& name);

}  // namespace irido::tables
