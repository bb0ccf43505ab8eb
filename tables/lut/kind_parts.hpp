#pragma once

#include <string>
#include <string_view>

#include "tables/lut/lut_kind.hpp"

namespace irido::tables {

// Shared by the kinds of tables.

/// The axis of a list option: as typed (fixed unless equally spaced), or `otherwise` if not given.
/// Throws DomainError, which names the option, unless the samples are strictly monotonic.
AxisPlan listed_axis(const LutRequest& request, std::string_view option, LutAxis otherwise);

/// `count` samples 0, step, 2 step, ...
std::vector<double> stepped(double step, std::size_t count);

/// --alpha and --theta-i, --theta-d as kinds of rough layers have them, and their axes: by default
/// alpha 0.1 and angles 0:89.75:0.25 degrees. Throw DomainError.
LutOption alpha_option();
LutOption angles_option(std::string_view name, std::string_view help);
AxisPlan alpha_axis(const LutRequest& request);
AxisPlan angles_axis(const LutRequest& request, std::string_view option, std::string name);

/// Whether any medium of the stack amplifies at one of the wavelengths. Then values have no upper
/// bound, and plans set the fact "amplifies".
bool amplifies(const Stack& stack, std::vector<double> wavelength_nm);

/// Differences divided by scale(alpha, theta_i); for tables with the axes alpha, theta_i, any.
LutMeasure relative_to(std::string name,
                       std::function<double(double alpha, double theta_i_deg)> scale);

/// s, p or u, as the command line has it.
std::string letter_of(Light light);

/// Relative rounding error of values in the table's number format, and of sums over a row.
double rounding_of(LutType type);

/// The place of a sample in words: "theta_i_deg 20, theta_d_deg 15".
std::string place_in(const Lut& lut, std::size_t sample);

/// The first problems with values that are not finite or outside [0, most(sample)].
std::vector<std::string> out_of_range(const Lut& lut,
                                      const std::function<double(std::size_t sample)>& most);

}  // namespace irido::tables
