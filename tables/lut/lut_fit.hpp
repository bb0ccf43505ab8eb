#pragma once

#include "tables/lut/interpolation.hpp"

namespace irido::tables {

/// Finds the axes of a table whose interpolation error is at most making.sizing.tolerance: those of
/// the plan may be cut, those of the table get their sizes. As make_lut() says; throws as that
/// does.
///   sample  of the plan, exact enough for its errors
void fit_axes(LutPlan& plan, Sampler& sample, const LutMaking& making, Lut& lut);

/// The same from what an earlier call found; false, and nothing changed, if that is not of this
/// plan.
bool set_fitted_axes(const FittedAxes& fitted, LutPlan& plan, Lut& lut);

}  // namespace irido::tables
