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

    std::string text;  ///< as typed, without blanks
    std::string column;
    Side side = Side::at_most;
    double value = 0;

    /// Whether a number keeps it; NaN does not.
    bool holds(double number) const;
};

/// Throws UsageError.
std::vector<SampleLimit> parse_limits(const std::vector<std::string>& texts);

/// A stream that keeps, instead of rows, what their statistics need: the numbers of every quantity,
/// and which samples keep the limits. Its blocks are in packed_format().
///
/// finish() hands over the records quantity, mean, sd, p5, p50, p95, preceded by those columns that
/// tell rows of one sample apart (angles, wavelengths, varied values) and have more than one value.
/// sd is that of a population, the square root of the mean squared deviation; percentiles are
/// interpolated linearly between order statistics, as by NumPy. Of a limit the quantity is 1 for a
/// sample whose rows all keep it, else 0, and so the mean is the yield; `yield` is that of all
/// limits together.
/// layout, space, query  of the sweep, which must have samples and outlive the stream
/// limits                of columns of the layout
/// take                  gets the records
/// Throws UsageError for a limit of a column that is none, and in append() if the samples have more
/// than 2^27 numbers.
std::unique_ptr<tables::RecordStream> sample_summary(
    const tables::RecordLayout& layout, const SweepSpace& space, const Query& query,
    std::vector<SampleLimit> limits, std::function<void(const tables::Records&)> take);

}  // namespace irido::cli
