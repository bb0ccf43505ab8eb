#pragma once

#include <string>
#include <vector>

#include "core/design/design_model.hpp"
#include "schemas/documents/design_document.hpp"
#include "tables/pictures/figure.hpp"
#include "tables/records/records.hpp"

namespace irido::cli {

/// Differences that count as met where a target states no sigma: of R, T and A; of all others, in
/// their unit.
inline constexpr double kMetFraction = 0.01, kMetOther = 1;

/// One row a value of every target, `values` and residuals those of the stack: target, quantity,
/// angle_deg, polarization, wavelength_nm, value, target_value, difference, weight, met. A colour
/// has rows of L, a and b and one of its difference.
tables::Records target_report(const schemas::DesignTask& task, const DesignRows& rows);

/// How many of the rows above that say so are met.
struct MetTargets {
    std::size_t met = 0, all = 0;
};
MetTargets met_targets(const tables::Records& report);

/// Lines for people: how many targets are met, and colours that are out of reach with the nearest
/// that was found, the first few of them.
std::vector<std::string> summary_lines(const tables::Records& report);

/// The report as a picture: values over the wavelength beside their targets, a panel a quantity;
/// colours over the angle. With `residuals` differences instead.
tables::Figure target_figure(const schemas::DesignTask& task, const tables::Records& report,
                             bool residuals);

/// The text of the stack with these values and the member "design", for a file at that path.
std::string designed_text(const schemas::DesignTask& task, const std::vector<double>& values,
                          nlohmann::json design, const std::string& path);

/// The names of quantities as targets have them.
std::string_view name_of(DesignQuantity quantity);

}  // namespace irido::cli
