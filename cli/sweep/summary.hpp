#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cli/queries/query.hpp"
#include "cli/sweep/space.hpp"
#include "tables/resume/record_stream.hpp"

namespace irido::cli {

/// A condition on the rows of a sample: COLUMN<=VALUE, or >=, <, >.
struct SampleLimit {
    enum class Side { at_most, at_least, below, above };

    std::string text;  ///< as given, without blanks
    std::string column;
    Side side = Side::at_most;
    double value = 0;

    /// Whether a number satisfies it; NaN does not.
    bool holds(double number) const;
};

/// Throws UsageError.
std::vector<SampleLimit> parse_limits(const std::vector<std::string>& texts);

/// A stream that keeps, instead of rows, the data for their statistics: the numbers of every
/// quantity, and which samples satisfy the limits. Its blocks are in packed_format().
///
/// finish() passes on records with the columns quantity, mean, sd, p5, p50, p95, preceded by the
/// columns (angles, wavelengths, varied values) that distinguish the rows of a sample and have more
/// than one value. sd is the population standard deviation, the square root of the mean squared
/// deviation; percentiles are interpolated linearly between order statistics, as in NumPy. The
/// quantity of a limit is 1 for a sample whose rows all satisfy it, else 0, so its mean is the
/// yield; `yield` is that of all limits together. Throws UsageError for a limit on an unknown
/// column, and in append() if the samples have more than 2^27 numbers.
/// layout, space, query  of the sweep, which must have samples and outlive the stream
/// limits                on columns of the layout
/// take                  receives the records
std::unique_ptr<tables::RecordStream> sample_summary(
    const tables::RecordLayout& layout, const SweepSpace& space, const Query& query,
    std::vector<SampleLimit> limits, std::function<void(const tables::Records&)> take);

}  // namespace irido::cli
