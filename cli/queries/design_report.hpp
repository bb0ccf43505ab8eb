#pragma once

#include <string>
#include <vector>

#include "core/design/design_model.hpp"
#include "schemas/documents/design_document.hpp"
#include "tables/pictures/figure.hpp"
#include "tables/records/records.hpp"

namespace irido::cli {

/// Differences that count as met where a target states no sigma: for R, T and A; for all others, in
/// their unit.
inline constexpr double kMetFraction = 0.01, kMetOther = 1;

/// One row per value of every target, with `values` and residuals of the stack: target, quantity,
/// angle_deg, polarization, wavelength_nm, value, target_value, difference, weight, met. A colour
/// has rows for L, a and b and one for the difference.
tables::Records target_report(const schemas::DesignTask& task, const DesignRows& rows);

/// How many of these rows are met.
struct MetTargets {
    std::size_t met = 0, all = 0;
};
MetTargets met_targets(const tables::Records& report);

/// Lines for people: how many targets are met, and the first few unattainable colours with the
/// nearest one found.
std::vector<std::string> summary_lines(const tables::Records& report);

/// The report as a picture: values over wavelength with their targets, one panel per quantity;
/// colours over the angle. With `residuals`, differences instead.
tables::Figure target_figure(const schemas::DesignTask& task, const tables::Records& report,
                             bool residuals);

/// The JSON text of the stack with these values and the member "design", to be stored at that path.
/// task    the design task
/// values  one per free value
/// design  the member "design"
/// path    path of the file, for relative paths
std::string designed_text(const schemas::DesignTask& task, const std::vector<double>& values,
                          nlohmann::json design, const std::string& path);

/// The name of a quantity in targets.
std::string_view name_of(DesignQuantity quantity);

}  // namespace irido::cli
