#pragma once

#include <string>
#include <vector>

#include "cli/queries/query.hpp"
#include "core/spectrum/cone.hpp"

namespace irido::cli {

/// A weight over the wavelength: the product of piecewise linear functions, 0 outside their rows.
struct AverageWeight {
    std::string name;
    std::vector<Table> factors;  ///< none: 1 everywhere

    double at(double wavelength_nm) const;
};

/// flat, photopic (D65 times ybar of 2 degrees) or a file of rows nm,weight. Throws UsageError, or
/// InputError for errors of the file.
AverageWeight parse_average(const std::string& text);

/// The largest error of an average.
inline constexpr double kAverageError = 1e-10;

/// int w X dl / int w dl over [range] of X = R, T and A, as spectra() of one wavelength. Panels end
/// at the rows of the weight and of tabulated materials. Throws InputError for materials,
/// UsageError where the weight is 0 throughout, ToleranceError, DomainError.
///   document    names the stack's materials in errors
///   angles_deg  [0, 90], cones about them if `cone` is one
Spectra average_power(const schemas::StackDocument& document, const Stack& stack,
                      WavelengthRange range, const AverageWeight& weight,
                      std::span<const double> angles_deg, const ConeSize& cone,
                      const Execution& execution);

}  // namespace irido::cli
