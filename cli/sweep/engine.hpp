#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "cli/sweep/stacks.hpp"
#include "tables/resume/record_stream.hpp"

namespace irido::cli {

/// Counts of a run; left_out is in units.
struct SweepCounts {
    std::atomic<std::uint64_t> rows{0}, stacks{0}, left_out{0};
};

/// Computes the rows of a sweep in blocks. A unit of work is one combination or, if the query's
/// angles are independent, one angle of it. Units are ordered, and so are their rows.
class SweepEngine {
public:
    /// The first three arguments must outlive the engine. Throws InputError or UsageError if the
    /// first combination cannot be prepared.
    /// stacks      the sweep's stacks
    /// space       the combinations
    /// query       the quantity to evaluate
    /// keep_going  skip combinations that cannot be computed
    SweepEngine(SweptStacks& stacks, const SweepSpace& space, const Query& query, bool keep_going);

    std::uint64_t units() const { return units_; }
    const tables::RecordLayout& layout() const { return layout_; }
    /// Number of rows of one unit; 0 if not known in advance.
    std::uint64_t rows_per_unit() const { return rows_per_unit_; }
    /// The unit at which shard K of N ends, for K in [0, N]. Shards have about equal cost and are
    /// the same on every machine.
    std::vector<std::uint64_t> shard_ends(std::uint64_t shards);

    /// Estimated seconds for the units in [begin, end) on that many threads; see tried_seconds().
    double seconds_of(std::uint64_t begin, std::uint64_t end, unsigned threads);

    /// Computes the rows of the units in [begin, end) and writes them in order. Returns false if
    /// stopped early by `proceed`. Throws the first error of a unit.
    /// begin, end  units, in [0, units()]
    /// format      turns rows into bytes
    /// stream      receives the bytes
    /// threads     number of threads; 0: one per core
    /// proceed     called repeatedly with the number of units written; returning false stops the
    ///             run
    bool run(std::uint64_t begin, std::uint64_t end, const tables::RecordFormat& format,
             tables::RecordStream& stream, unsigned threads,
             const std::function<bool(std::uint64_t)>& proceed);

    const SweepCounts& counts() const { return counts_; }
    /// The error of the first unit that was skipped: "at PATH=VALUE: message".
    std::string first_left_out() const { return first_left_out_; }

private:
    struct Block;
    class Blocks;

    std::uint64_t combination_of(std::uint64_t unit) const {
        return is_inner_angle_ ? unit : unit / angles_.size();
    }
    double number_at(std::size_t column, std::uint64_t combination) const {
        return space_.columns()[column].numbers[space_.at(column, combination)];
    }
    double cost_us(std::uint64_t unit, SweptStacks::Walk& walk) const;
    void compute(Block& block, SweptStacks::Walk& walk, const tables::RecordFormat& format,
                 const std::atomic<bool>& stopped);
    /// Processes one unit; with keep_going, skips it if it fails.
    void take_alone(std::uint64_t unit, const std::function<void()>& take);
    std::size_t add(std::uint64_t unit, std::size_t count, SweptStacks::Walk& walk,
                    QueryResult& result);
    /// Computes `units` units, or a fraction of one, and discards the rows; returns the number
    /// computed.
    double try_units(std::uint64_t first, double units);
    tables::Records assembled(tables::Records leading, tables::Records computed) const;

    SweptStacks& stacks_;
    const SweepSpace& space_;
    const Query& query_;
    bool keep_going_;
    std::span<const double> angles_;  ///< of one combination, one per unit
    bool is_inner_angle_ = false;     ///< angles_ are the space's last column
    std::vector<std::size_t>
        led_by_;  ///< columns with values of the stack, at the front of each row
    std::optional<std::size_t> angle_column_, wavelength_column_;  ///< set by the combination
    std::uint64_t units_ = 0, rows_per_unit_ = 0;
    tables::RecordLayout layout_;
    SweepCounts counts_;
    std::mutex left_out_lock_;
    std::uint64_t first_left_out_unit_ = ~std::uint64_t{0};
    std::string first_left_out_;
};

}  // namespace irido::cli
