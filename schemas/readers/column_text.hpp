#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace irido::schemas {

/// A line of a text, without its end.
struct TextLine {
    std::size_t number = 1;
    std::string_view text;
};

/// The lines of a text, which end in LF, CR LF or CR, without a byte order mark.
std::vector<TextLine> lines_of(std::string_view text);

/// "LINE:COLUMN" of a part of a line's text.
std::string place_of(const TextLine& line, std::string_view part);

/// A row of numbers.
struct ColumnRow {
    TextLine line;
    std::vector<double> values;
    std::vector<std::string_view> cells;  ///< the values' texts, parts of the line
};

/// A table of numbers with or without a header.
struct ColumnText {
    std::vector<std::string> header;  ///< as many names as a row has values, or none
    std::vector<ColumnRow> rows;      ///< at least one, all of the same length
    bool has_semicolon_comments = false;
};

/// What names of columns a header may have.
struct ColumnNames {
    bool (*are)(const std::vector<std::string>& header);
    std::string known;  ///< what they are, for messages
    std::size_t fewest = 2, most = 3;
    std::string others = {};  ///< what else is read, for texts that have no rows
};

/// Reads a table of numbers whose cells are set apart by semicolons, tabs, commas or blanks, the
/// first of these that makes numbers of the first row; where it is not the comma, a comma is a
/// decimal point. Cells may be in quotes; an empty one at the end of a row is left out. Lines that
/// begin with ; ! % or // and what is behind # are comments. Of the lines above the first row, one
/// must be the header if any is there, perhaps with units in the next line; a comment that names
/// all columns is one, too. Throws InputError with file `name` and "line:column".
ColumnText read_columns(std::span<const TextLine> lines, const std::string& name,
                        const ColumnNames& names);

/// Units of the first column of a table.
enum class SpectralUnit { nm, um, angstrom, ev, per_cm };

/// What a column's name says: "wavelength_um", "Energy (eV)", "nm".
struct SpectralColumn {
    std::optional<SpectralUnit> unit;  ///< none: "wavelength" alone
};

/// Nothing for a name that is not that of a spectral column.
std::optional<SpectralColumn> spectral_column(std::string_view column);

/// Lower-case words of a column's name, with Greek letters and super- and subscripts spelt out:
/// "eps_1 (-)" gives "eps 1".
std::string plain_words(std::string_view column);

/// value * 10^power, the decimal point moved instead of a product rounded: 58.5 gives 0.0585.
double shifted(double value, int power);

/// Vacuum wavelength in nm; decimals stay as they are: 0.57 um gives 570.
double to_nm(double value, SpectralUnit unit);

/// Throws InputError if wavelengths without a unit look like um: if all are below 50.
///   values   the other columns of a header that would say so: "n,k"
void require_nm(const ColumnText& table, std::size_t column, const std::string& name,
                std::string_view values);

}  // namespace irido::schemas
