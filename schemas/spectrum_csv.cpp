#include "schemas/spectrum_csv.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "schemas/csv_rows.hpp"
#include "schemas/input_error.hpp"

namespace irido {

Table read_spectrum_csv(std::string_view text, const std::string& name) {
    const auto rows = read_csv_rows(text, name, 2, 2);
    if (rows.size() < 2) throw InputError(name, "", "must have at least 2 rows (got 1)");
    for (const CsvRow& row : rows)
        if (row.values[1] < 0)
            throw InputError(name, row.place,
                             "the value must not be negative (got " + to_text(row.values[1]) + ")");
    const auto is_zero = [](const CsvRow& row) { return row.values[1] == 0; };
    if (std::all_of(rows.begin(), rows.end(), is_zero))
        throw InputError(name, "", "the values must not all be 0");
    return table_of(rows, 1);
}

}  // namespace irido
