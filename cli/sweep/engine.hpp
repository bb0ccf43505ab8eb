#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "cli/sweep/stacks.hpp"
#include "tables/resume/record_stream.hpp"

namespace irido::cli {

/// What is computed once and handed out many times, and how often.
struct SweepCounts {
    std::atomic<std::uint64_t> rows{0}, stacks{0}, left_out{0};
};

/// The rows of a sweep, block by block. Its units of work are the combinations, each angle of the
/// query by itself where it can be; they have an order, and so have their rows.
class SweepEngine {
public:
    /// keep_going  leaves out combinations that cannot be computed
    /// All arguments must outlive it. Throws InputError or UsageError if the first combination
    /// cannot be prepared.
    SweepEngine(SweptStacks& stacks, const SweepSpace& space, const Query& query, bool keep_going);

    std::uint64_t units() const { return units_; }
    const tables::RecordLayout& layout() const { return layout_; }
    /// Rows of one unit; 0 if their number is not known before.
    std::uint64_t rows_per_unit() const { return rows_per_unit_; }
    /// Where the part of shard K of N ends, for K in [0, N]: parts of the same cost, more or less,
    /// and the same ones on every machine.
    std::vector<std::uint64_t> shard_ends(std::uint64_t shards);

    /// Seconds that units in [begin, end) will take on so many threads; see tried_seconds().
    double seconds_of(std::uint64_t begin, std::uint64_t end, unsigned threads);

    /// Writes the rows of units in [begin, end) in order, computed by so many threads (0: one a
    /// core). `proceed` is called now and then with the number of units that are written; if it
    /// returns false, run() ends early and returns false. Throws what a unit throws.
    bool run(std::uint64_t begin, std::uint64_t end, const tables::RecordFormat& format,
             tables::RecordStream& stream, unsigned threads,
             const std::function<bool(std::uint64_t)>& proceed);

    const SweepCounts& counts() const { return counts_; }
    /// What was said of the first combination that was left out.
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
    /// Takes one unit, or leaves it out.
    void take_alone(std::uint64_t unit, const std::function<void()>& take);
    std::size_t add(std::uint64_t unit, std::size_t count, SweptStacks::Walk& walk,
                    QueryResult& result);
    /// Computes so many units, or part of one, and forgets them; returns how many it were.
    double try_units(std::uint64_t first, double units);
    tables::Records assembled(tables::Records leading, tables::Records computed) const;

    SweptStacks& stacks_;
    const SweepSpace& space_;
    const Query& query_;
    bool keep_going_;
    std::span<const double> angles_;   ///< of one combination but for its angle, one a unit
    bool is_inner_angle_ = false;      ///< they are the space's last column
    std::vector<std::size_t> led_by_;  ///< columns that are values of the stack
    std::optional<std::size_t> angle_column_, wavelength_column_;  ///< set by the combination
    std::uint64_t units_ = 0, rows_per_unit_ = 0;
    tables::RecordLayout layout_;
    SweepCounts counts_;
    std::mutex left_out_lock_;
    std::uint64_t first_left_out_unit_ = ~std::uint64_t{0};
    std::string first_left_out_;
};

}  // namespace irido::cli
