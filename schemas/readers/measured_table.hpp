#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace irido::schemas {

/// Measured values at one angle, in the order of the file.
struct MeasuredRows {
    std::optional<double> angle_deg;  ///< none if the file has no column of angles
    std::vector<double> wavelength_nm;
    std::vector<double> value;
    std::vector<double> sigma;  ///< empty if the file has no such column
};

/// One quantity of a table whose heading names its columns (column_text.hpp): the spectral column
/// with its unit, that of the values, and where there are any those of the angle (angle_deg, angle,
/// aoi, theta) and of the standard deviation (sigma_R, R_sigma, R_error). Percentages, %R or
/// R_percent, become fractions. Angles are set apart. Throws InputError with file `name` and
/// "line:column".
/// quantity  as of a design target: R, psi_deg;   column  the column's name, "" to look for it
std::vector<MeasuredRows> read_measured_table(std::string_view text, const std::string& name,
                                              std::string_view quantity, std::string_view column);

}  // namespace irido::schemas
