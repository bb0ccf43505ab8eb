#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/design/local_search.hpp"

namespace irido {

/// Progress report of a search; may come from any thread.
struct SearchNews {
    double merit = 0;            ///< the best so far
    double done = 0;             ///< fraction of the evaluations, [0, 1]
    std::size_t layers = 0;      ///< for needles: layers of the best design so far
    std::vector<double> best{};  ///< its values
};

/// Default number of evaluations of a search.
inline constexpr std::size_t kUsualEvaluations = 300000;

struct SearchSettings {
    std::uint64_t seed = 1;
    std::size_t evaluations = kUsualEvaluations;  ///< of all runs together
    std::uint64_t first_run =
        0;  ///< number of the first run: others are another part of the search
    unsigned threads = 0;
    SimdLevel simd = best_simd_level();
    std::function<bool()> should_stop{};            ///< polled often, from any thread
    std::function<void(const SearchNews&)> tell{};  ///< called on improvement
    double color_tolerance = 0.02;                  ///< CIELAB, while searching
};

/// Outcome of one run.
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
    std::size_t runs_within = 0;  ///< number of them with a merit within 1 % of the best
    bool is_stopped = false;
};

/// Best local optimum reached from the given values; integers step by one as long as that helps.
SearchResult refine(const DesignProblem& problem, const SearchSettings& settings);

inline constexpr std::size_t kSearchRuns = 8;

/// Best of kSearchRuns independent basin-hopping runs. A hop perturbs or redraws a few values, or
/// moves a pair of neighbours elsewhere, refines, and is accepted unless it is more than 5 % worse.
/// Runs depend on the seed and their number only and share the evaluations evenly, so the result
/// does not depend on the number of threads; the search ends early once half of the runs agree.
/// With integers, each combination (up to 1000) is searched separately. Throws DomainError for a
/// value without finite bounds.
SearchResult search(const DesignProblem& problem, const SearchSettings& settings);

}  // namespace irido
