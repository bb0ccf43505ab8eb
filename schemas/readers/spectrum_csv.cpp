#include "schemas/readers/spectrum_csv.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/column_text.hpp"
#include "schemas/readers/index_rows.hpp"

namespace irido::schemas {

namespace {

/// Values are relative: this leaves room for their products and sums.
constexpr double kLargestPower = 1e30;

bool is_wavelength(const std::optional<SpectralColumn>& column) {
    return column && (!column->unit || *column->unit == SpectralUnit::nm ||
                      *column->unit == SpectralUnit::um || *column->unit == SpectralUnit::angstrom);
}

/// Powers are per wavelength, in whatever unit; powers per eV are others.
bool are_spectrum_columns(const std::vector<std::string>& header) {
    return is_wavelength(spectral_column(header[0])) && !spectral_column(header[1]);
}

double wavelength_of(const ColumnRow& row, SpectralUnit unit, const std::string& name) {
    const double nm = to_nm(row.values[0], unit);
    if (nm >= kAllWavelengths.first_nm && nm <= kAllWavelengths.last_nm) return nm;
    throw InputError(name, place_of(row.line, row.cells[0]),
                     "wavelength_nm must be in [1, 1e+07] (got " + to_text(nm) + ")");
}

}  // namespace

Table read_spectrum_csv(std::string_view text, const std::string& name) {
    const ColumnNames names{are_spectrum_columns,
                            "a wavelength in nm, um or angstrom, and a power per wavelength", 2, 2};
    const ColumnText table = read_columns(lines_of(text), name, names);
    const auto column_name =
        table.header.empty() ? SpectralColumn{} : spectral_column(table.header[0]).value();
    if (!column_name.unit) require_nm(table, 0, name, "power");
    if (table.rows.size() < 2) throw InputError(name, "", "must have at least 2 rows (got 1)");
    double largest = 0;
    std::vector<IndexRow> rows;
    for (const ColumnRow& row : table.rows) {
        if (!(row.values[1] >= 0 && row.values[1] <= kLargestPower))
            throw InputError(
                name, place_of(row.line, row.cells[1]),
                "the value must be in [0, 1e+30] (got " + to_text(row.values[1]) + ")");
        largest = std::max(largest, row.values[1]);
        rows.push_back({wavelength_of(row, column_name.unit.value_or(SpectralUnit::nm), name),
                        row.values[1], 0});
    }
    if (largest < 1 / kLargestPower)
        throw InputError(name, "",
                         "the largest value must be at least 1e-30 (got " + to_text(largest) + ")");
    std::ranges::stable_sort(rows, {}, [](const IndexRow& row) { return row[0]; });
    for (std::size_t i = 1; i < rows.size(); ++i)
        if (rows[i][0] == rows[i - 1][0])
            throw InputError(
                name, "",
                "must have one row per wavelength (got two at " + to_text(rows[i][0]) + " nm)");
    return column(rows, 1);
}

}  // namespace irido::schemas
