#include "schemas/spectrum_csv.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "schemas/csv_rows.hpp"
#include "schemas/input_error.hpp"

namespace irido {

namespace {

/// Values are relative: this leaves room for their products and sums.
constexpr double kLargestPower = 1e30;

}  // namespace

Table read_spectrum_csv(std::string_view text, const std::string& name) {
    const auto rows = read_csv_rows(text, name, 2, 2);
    if (rows.size() < 2) throw InputError(name, "", "must have at least 2 rows (got 1)");
    double largest = 0;
    for (const CsvRow& row : rows) {
        if (!(row.values[1] >= 0 && row.values[1] <= kLargestPower))
            throw InputError(
                name, row.place,
                "the value must be in [0, 1e+30] (got " + to_text(row.values[1]) + ")");
        largest = std::max(largest, row.values[1]);
    }
    if (largest < 1 / kLargestPower)
        throw InputError(name, "",
                         "the largest value must be at least 1e-30 (got " + to_text(largest) + ")");
    return table_of(rows, 1);
}

}  // namespace irido
