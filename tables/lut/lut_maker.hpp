#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tables/lut/lut.hpp"
#include "tables/lut/lut_format.hpp"
#include "tables/lut/lut_kind.hpp"

namespace irido::tables {

/// What a table for a tolerance has, of which another with the same plan gets its size.
struct FittedAxes {
    struct Range {
        double first, last;
        std::size_t count;
    };
    std::vector<Range> ranges;  ///< per axis
    std::vector<std::string> notes;
};

/// How to choose the numbers of samples along the axes.
struct LutSizing {
    std::vector<std::size_t> counts{};  ///< per axis; empty: as planned, or by the tolerance
    std::optional<double> tolerance{};  ///< largest interpolation error, in the plan's measure
    bool power_of_two = true;           ///< restricts sizes chosen by the tolerance
    /// What the same sizing found before: its trials are not done again.
    std::optional<FittedAxes> fitted{};
};

/// Options for making a table.
struct LutMaking {
    LutSizing sizing{};
    LutType type = LutType::f32;
    bool mips = false;     ///< makes the first axis mip levels, where the plan allows it
    bool measure = true;   ///< stores the interpolation error in the facts
    unsigned threads = 0;  ///< 0: one per core; the table does not depend on it
    /// Called with the part of the values that is done, 0 before, and what is being worked on.
    std::function<void(double done, const std::string& what)> progress{};
};

/// The error of a table that is interpolated linearly along all axes that are ranges. Measured at
/// the middles of the cells along each axis and along all axes, and on a finer grid in the eight
/// worst cells: a sampled maximum, not a bound. Of more than 2048 middles, those along lines where
/// the table's own curvature promises the largest errors, and along as many evenly spaced ones.
/// Uses the values as stored.
struct InterpolationError {
    double value = 0;
    std::vector<double> at;       ///< its location, one number per axis
    std::vector<double> of_axis;  ///< along each axis alone
};

/// The error of each mip level, or of the table if it has none.
std::vector<InterpolationError> interpolation_errors(const LutPlan& plan, const Lut& lut,
                                                     unsigned threads);

/// Samples the plan's function. With a tolerance: axes along which it is constant get one sample,
/// ranges are cut where it becomes constant (both are recorded in the facts' notes), and sizes grow
/// until the error, that of the first mip level if there are several, meets the tolerance. Throws
/// ToleranceError if no size up to 8192 does, LutError for impossible sizes.
Lut make_lut(const LutKind& kind, LutPlan plan, const LutMaking& making);

/// Number of evaluations of the plan's function by make_lut(): approximate or, with a tolerance, a
/// lower bound.
double least_evaluations(const LutPlan& plan, const LutMaking& making);

/// The result of make_lut() without values and error.
Lut sized_lut(const LutKind& kind, LutPlan plan, const LutMaking& making);

/// The estimated interpolation error of each mip level of a sized table, from a few samples in the
/// cells that would be worst at a single thickness. Empty if there are no levels.
std::vector<double> estimated_level_errors(const LutPlan& plan, const Lut& sized, unsigned threads);

/// Estimated seconds of make_lut() after it has found the sizes of a table: its values, and errors
/// of mip levels, extrapolated from a few samples of each level.
double estimated_seconds(const LutPlan& plan, const Lut& sized, const LutMaking& making);

}  // namespace irido::tables
