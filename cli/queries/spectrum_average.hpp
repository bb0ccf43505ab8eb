#pragma once

#include <string>
#include <vector>

#include "cli/queries/query.hpp"
#include "core/spectrum/cone.hpp"

namespace irido::cli {

/// A weight over wavelength: a product of piecewise linear functions, each 0 outside its rows.
struct AverageWeight {
    std::string name;
    std::vector<Table> factors;  ///< empty: 1 everywhere

    double at(double wavelength_nm) const;
};

/// Parses flat, photopic (D65 times ybar of the 2-degree observer) or the name of a file with rows
/// nm,weight. Throws UsageError, or InputError for errors in the file.
AverageWeight parse_average(const std::string& text);

/// The largest error of an average.
inline constexpr double kAverageError = 1e-10;

/// int w X dl / int w dl over the range, for X = R, T and A, in the form of spectra() at one
/// wavelength. Panels end at the rows of the weight and of tabulated materials. Throws InputError
/// for materials, UsageError if the weight is 0 throughout, ToleranceError, DomainError.
///   document    names the stack's materials in errors
///   stack       the stack
///   range       of wavelengths
///   weight      w
///   angles_deg  degrees, [0, 90]
///   cone        about each angle, or none
///   execution   threads and SIMD level
Spectra average_power(const schemas::StackDocument& document, const Stack& stack,
                      WavelengthRange range, const AverageWeight& weight,
                      std::span<const double> angles_deg, const ConeSize& cone,
                      const Execution& execution);

}  // namespace irido::cli
