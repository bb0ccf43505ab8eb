#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "cli/queries/query.hpp"
#include "cli/sweep/space.hpp"
#include "schemas/documents/varied_stack.hpp"

namespace irido::cli {

/// The stacks of a sweep. Stacks that differ only in thicknesses share one structure, which is read
/// and prepared once unless more than kMostStructures others are used in between. Thread-safe.
class SweptStacks {
public:
    /// `space` and `query` must outlive it. Throws InputError for the first value that is invalid
    /// regardless of the other values.
    SweptStacks(schemas::StackSource source, const SweepSpace& space, const Query& query);

    static constexpr std::size_t kMostStructures = 32;

    /// The document of the first combination, except for its thicknesses.
    const schemas::StackDocument& first() const { return first_; }

    /// Visits stacks, combination by combination, on one thread.
    class Walk {
    public:
        explicit Walk(SweptStacks& stacks) : stacks_(stacks) {}

        struct Place {
            std::shared_ptr<const PreparedStack> prepared;
            Stack stack;
            Stack written;               ///< the same in document order, if that is reversed
            std::vector<Layer*> varied;  ///< its layers, one for each varied thickness
        };
        /// The prepared structure of a combination and its stack, valid until the next call.
        /// Throws InputError.
        const Place& at(std::uint64_t combination);

    private:
        Place& structure_at(std::uint64_t combination);

        SweptStacks& stacks_;
        std::vector<std::size_t> key_;
        std::map<std::vector<std::size_t>, Place> places_;
    };

    /// Number of preparations, including repeated ones.
    std::uint64_t prepared() const { return prepared_count_; }

private:
    struct Structure {
        std::mutex making;
        std::shared_ptr<const PreparedStack> prepared;
        std::uint64_t last_used = 0;
    };

    void read_values();
    schemas::StackDocument document(const std::vector<std::size_t>& key) const;
    std::vector<std::size_t> key_of(std::uint64_t combination) const;
    std::shared_ptr<const PreparedStack> prepared(const std::vector<std::size_t>& key);
    std::shared_ptr<Structure> entry(const std::vector<std::size_t>& key);

    const SweepSpace& space_;
    const Query& query_;
    std::vector<std::size_t> structural_, thicknesses_;  ///< columns of the space
    bool is_reversed_;
    schemas::VariedStack varied_;
    std::string file_;
    schemas::StackDocument first_;
    std::mutex lock_;
    std::map<std::vector<std::size_t>, std::shared_ptr<Structure>> structures_;
    std::uint64_t uses_ = 0;
    std::atomic<std::uint64_t> prepared_count_{0};
};

}  // namespace irido::cli
