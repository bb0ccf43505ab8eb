#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tables/lut/lut.hpp"
#include "tables/lut/lut_format.hpp"
#include "tables/lut/lut_kind.hpp"

namespace irido::tables {

/// How many samples a table gets along its axes.
struct LutSizing {
    std::vector<std::size_t> counts{};  ///< of every axis; empty: as planned or by the tolerance
    std::optional<double> tolerance{};  ///< largest interpolation error, in the plan's measure
    bool power_of_two = true;           ///< sizes by the tolerance
};

struct LutMaking {
    LutSizing sizing{};
    LutType type = LutType::f32;
    bool mips = false;     ///< the first axis as mip levels, where the plan allows it
    bool measure = true;   ///< the interpolation error goes into the facts
    unsigned threads = 0;  ///< 0: one per core; the table does not depend on it
    std::function<void(double done)> progress{};  ///< called with a growing fraction
};

/// How far a table, interpolated linearly along all axes that are ranges, is from its function:
/// measured at the middles of the cells along each axis and along all of them, and on a finer grid
/// in the eight worst of these cells: a sampled maximum, not a bound. Samples are taken as stored.
struct InterpolationError {
    double value = 0;
    std::vector<double> at;       ///< the place, one number an axis
    std::vector<double> of_axis;  ///< along each axis alone
};

/// Of each mip level, or of the table alone.
std::vector<InterpolationError> interpolation_errors(const LutPlan& plan, const Lut& lut,
                                                     unsigned threads);

/// Samples the plan's function. With a tolerance: axes that do not matter get one sample, ranges
/// end where the function has become constant, and sizes grow until the error is met, of the first
/// level where there are mip levels; what was left out is in the facts' notes. Throws
/// ToleranceError if no size up to 8192 meets it, LutError for sizes that cannot be.
Lut make_lut(const LutKind& kind, LutPlan plan, const LutMaking& making);

/// How often make_lut() will compute the plan's function: about, or, with a tolerance, at least.
double least_evaluations(const LutPlan& plan, const LutMaking& making);

/// make_lut() without the values and their error: what the table will be.
Lut sized_lut(const LutKind& kind, LutPlan plan, const LutMaking& making);

/// Of each mip level of a sized table its interpolation error, or what few samples show of it: in
/// the cells in which it would be worst without a spread. Empty if there are no levels.
std::vector<double> estimated_level_errors(const LutPlan& plan, const Lut& sized, unsigned threads);

/// Seconds that make_lut() will take for the values of a sized table and their error, from the time
/// that few samples of each level take.
double estimated_seconds(const LutPlan& plan, const Lut& sized, unsigned threads);

}  // namespace irido::tables
