#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace irido::schemas {

/// A line of text, without its line end.
struct TextLine {
    std::size_t number = 1;
    std::string_view text;
};

/// Splits text into lines, which end in LF, CR LF or CR; drops a byte order mark.
std::vector<TextLine> lines_of(std::string_view text);

/// "LINE:COLUMN" of a part of a line.
std::string place_of(const TextLine& line, std::string_view part);

/// A row of numbers.
struct ColumnRow {
    TextLine line;
    std::vector<double> values;
    std::vector<std::string_view> cells;  ///< the cells as text, views into the line
};

/// A table of numbers with or without a header.
struct ColumnText {
    std::vector<std::string> header;  ///< one name per value of a row, or empty
    std::vector<ColumnRow> rows;      ///< at least one, all of the same length
    bool has_semicolon_comments = false;
};

/// The names in a line of a header; where blanks separate them, a unit in brackets belongs to the
/// word before it.
std::vector<std::string> column_names(std::string_view line, char separator);

/// The column names that a header may have.
struct ColumnNames {
    bool (*are)(const std::vector<std::string>& header);
    std::string known;  ///< lists them, for messages
    std::size_t fewest = 2, most = 3;
    std::string others = {};  ///< lists the other formats that can be read, for texts without rows
};

/// Reads a table of numbers. The separator is the first of semicolon, tab, comma and blank that
/// splits the first row into numbers; unless it is the comma, decimal commas are allowed. Cells may
/// be quoted; an empty cell at the end of a row is dropped. Lines that begin with ; ! % or // are
/// comments, and so is everything after #. If there are lines above the first row, one of them must
/// be the header, and the next may hold units; a comment that names all columns also counts as a
/// header. Throws InputError with file `name` and "line:column".
ColumnText read_columns(std::span<const TextLine> lines, const std::string& name,
                        const ColumnNames& names);

/// Units of the first column of a table.
enum class SpectralUnit { nm, um, angstrom, ev, per_cm };

/// Meaning of a column's name: "wavelength_um", "Energy (eV)", "nm".
struct SpectralColumn {
    std::optional<SpectralUnit> unit;  ///< none: "wavelength" alone
};

/// Empty if the name is not that of a spectral column.
std::optional<SpectralColumn> spectral_column(std::string_view column);

/// A column's name as lower-case words, with Greek letters, superscripts and subscripts spelt out:
/// "eps_1 (-)" gives "eps 1".
std::string plain_words(std::string_view column);

/// value * 10^power, rounded only once, as by moving the decimal point: 58.5 gives 0.0585.
double shifted(double value, int power);

/// Vacuum wavelength in nm, without adding rounding errors: 0.57 um gives exactly 570.
double to_nm(double value, SpectralUnit unit);

/// Throws InputError if wavelengths without a unit look like um: if all are below 50.
///   values   the other columns of a header that would say so: "n,k"
void require_nm(const ColumnText& table, std::size_t column, const std::string& name,
                std::string_view values);

}  // namespace irido::schemas
