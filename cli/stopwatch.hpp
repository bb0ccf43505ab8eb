#pragma once

#include <algorithm>
#include <chrono>

namespace irido::cli {

inline double seconds_of(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Time in seconds of the fastest of repeated runs: at least two, `budget` seconds in total; the
/// first is a warm-up.
double best_seconds(double budget, const auto& work) {
    double best = seconds_of(work);
    for (double spent = 0; spent < budget;) {
        const double once = seconds_of(work);
        best = std::min(best, once);
        spent += once;
    }
    return best;
}

}  // namespace irido::cli
