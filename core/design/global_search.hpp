#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/design/local_search.hpp"

namespace irido {

/// Something to say in the course of a search; from any thread.
struct SearchNews {
    double merit = 0;            ///< the best so far
    double done = 0;             ///< of the evaluations, [0, 1]
    std::size_t layers = 0;      ///< of needles: of the best so far
    std::vector<double> best{};  ///< its values
};

/// Evaluations of a search that is not told how many.
inline constexpr std::size_t kUsualEvaluations = 300000;

struct SearchSettings {
    std::uint64_t seed = 1;
    std::size_t evaluations = kUsualEvaluations;  ///< of all runs together
    std::uint64_t first_run =
        0;  ///< number of the first run: others are another part of the search
    unsigned threads = 0;
    SimdLevel simd = best_simd_level();
    std::function<bool()> should_stop{};            ///< asked often, from any thread
    std::function<void(const SearchNews&)> tell{};  ///< told on improvement
    double color_tolerance = 0.02;                  ///< while searching
};

/// What one run came to.
struct SearchRun {
    std::vector<double> x;
    double merit = 0;
};

struct SearchResult {
    std::vector<double> x;
    double merit = 0;
    std::size_t evaluations = 0;
    LocalEnd end = LocalEnd::flat;
    std::vector<SearchRun> runs;  ///< best first; with integers, the best of each combination
    std::size_t runs_within = 0;  ///< of those, with a merit within 1 % of the best
    bool is_stopped = false;
};

/// The best local optimum from the given values; integers move by one as long as that helps.
SearchResult refine(const DesignProblem& problem, const SearchSettings& settings);

inline constexpr std::size_t kSearchRuns = 8;

/// The best of kSearchRuns independent runs, each of which hops from optimum to optimum: it moves
/// or redraws a few values, or a pair of neighbours to another place, refines, and stays unless
/// that is more than 5 % worse. Runs depend on the seed and their number alone, and share the
/// evaluations evenly, so that the answer does not depend on the threads; it ends early once half
/// of the runs agree. With integers, every combination (up to 1000) is searched on its own. Throws
/// DomainError for a value without finite bounds.
SearchResult search(const DesignProblem& problem, const SearchSettings& settings);

}  // namespace irido
