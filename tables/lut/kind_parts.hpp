#pragma once

#include <string>
#include <string_view>

#include "tables/lut/lut_kind.hpp"

namespace irido::tables {

// What kinds of tables have in common.

/// The axis of a list option: as typed, fixed unless equally spaced, or `otherwise`. Throws
/// DomainError that names the option unless the samples ascend or descend.
AxisPlan listed_axis(const LutRequest& request, std::string_view option, LutAxis otherwise);

/// `count` samples with one step from 0: 0, step, 2 step ..
std::vector<double> stepped(double step, std::size_t count);

/// --alpha and --theta-i, --theta-d as kinds of rough layers have them, and their axes: by default
/// alpha 0.1 and angles 0:89.75:0.25 degrees. Throw DomainError.
LutOption alpha_option();
LutOption angles_option(std::string_view name, std::string_view help);
AxisPlan alpha_axis(const LutRequest& request);
AxisPlan angles_axis(const LutRequest& request, std::string_view option, std::string name);

/// Whether any medium of the stack amplifies at one of the wavelengths: then there is no upper
/// bound, which plans note as the fact "amplifies".
bool amplifies(const Stack& stack, std::vector<double> wavelength_nm);

/// Differences divided by what scale() gives for the row; axes alpha, theta_i and any third one.
LutMeasure relative_to(std::string name,
                       std::function<double(double alpha, double theta_i_deg)> scale);

/// s, p or u, as the command line has it.
std::string letter_of(Light light);

/// The values' relative rounding by the table's number format, and of sums over a row of them.
double rounding_of(LutType type);

/// Where a value of a table stands, for problems(): "theta_i_deg 20, theta_d_deg 15".
std::string place_in(const Lut& lut, std::size_t sample);

/// Lines for values that are not finite or outside [0, most(sample)]; the first ones only.
std::vector<std::string> out_of_range(const Lut& lut,
                                      const std::function<double(std::size_t sample)>& most);

}  // namespace irido::tables
