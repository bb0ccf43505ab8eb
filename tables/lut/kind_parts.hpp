#pragma once

#include <string>
#include <string_view>

#include "tables/lut/lut_kind.hpp"

namespace irido::tables {

// Shared by the kinds of tables.

/// The axis for a list option: as given (fixed unless equally spaced), or `otherwise` if not given.
/// Throws DomainError, which names the option, unless the samples are strictly monotonic.
AxisPlan listed_axis(const LutRequest& request, std::string_view option, LutAxis otherwise);

/// `count` samples 0, step, 2 step, ...
std::vector<double> stepped(double step, std::size_t count);

/// The options --alpha, --theta-i and --theta-d of rough layers, and their axes; the defaults are
/// alpha 0.1 and angles 0:89.75:0.25 degrees. Throw DomainError.
LutOption alpha_option();
LutOption angles_option(std::string_view name, std::string_view help);
AxisPlan alpha_axis(const LutRequest& request);
AxisPlan angles_axis(const LutRequest& request, std::string_view option, std::string name);

/// Whether any medium of the stack amplifies at any of the wavelengths. Values then have no upper
/// bound, and plans set the fact "amplifies".
bool amplifies(const Stack& stack, std::vector<double> wavelength_nm);

/// Differences divided by scale(alpha, theta_i); for tables with the axes alpha, theta_i, any.
LutMeasure relative_to(std::string name,
                       std::function<double(double alpha, double theta_i_deg)> scale);

/// s, p or u, as on the command line.
std::string letter_of(Light light);

/// Relative rounding error of values in the table's number format, and of sums over a row.
double rounding_of(LutType type);

/// Location of a sample in words: "theta_i_deg 20, theta_d_deg 15".
std::string place_in(const Lut& lut, std::size_t sample);

/// The first problems with values that are not finite or outside [0, most(sample)].
std::vector<std::string> out_of_range(const Lut& lut,
                                      const std::function<double(std::size_t sample)>& most);

}  // namespace irido::tables
