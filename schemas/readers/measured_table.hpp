#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace irido::schemas {

/// Measurements at one angle, in file order.
struct MeasuredRows {
    std::optional<double> angle_deg;  ///< empty if the file has no angle column
    std::vector<double> wavelength_nm;
    std::vector<double> value;
    std::vector<double> sigma;  ///< empty if the file has no such column
};

/// Reads one quantity of a table whose header names its columns (column_text.hpp): the spectral
/// column with its unit, the values and, optionally, the angle (angle_deg, angle, aoi, theta) and
/// the standard deviation (sigma_R, R_sigma, R_error). Two columns for one purpose are refused.
/// Percentages, `R [%]` or R_percent, become fractions. R, T and A outside [-0.02, 1.02] are
/// refused, in a column that states percent or fraction outside [-0.2, 1.5]; psi outside [-1, 91]
/// degrees. Angles in rad become degrees. Rows are grouped by angle. Throws InputError with file
/// `name` and "line:column".
/// text      the file's content
/// name      the file's name in messages
/// quantity  as in a design target: R, psi_deg
/// column    the name of its column, "" to search for it
std::vector<MeasuredRows> read_measured_table(std::string_view text, const std::string& name,
                                              std::string_view quantity, std::string_view column);

/// A quantity and its column, as read_measured_table() takes them.
struct MeasuredColumn {
    std::string quantity;
    std::string column;  ///< "" if there is no other of that quantity
};

/// The columns of R, T, A, psi_deg and delta_deg. None of a text that is not such a table.
std::vector<MeasuredColumn> measured_columns(std::string_view text);

}  // namespace irido::schemas
