#pragma once

#include <time.h>

#include <algorithm>
#include <chrono>

namespace irido::cli {

inline double seconds_of(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Of the processor in this thread, which other programs do not change.
inline double thread_seconds_of(const auto& work) {
    const auto now = [] {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    };
    const double start = now();
    work();
    return now() - start;
}

/// Seconds of the fastest of repeated runs: at least two, for `budget` seconds in all; the first
/// one warms up.
///   measure  seconds of a run
double fastest_seconds(double budget, const auto& measure) {
    double best = measure();
    for (double spent = 0; spent < budget;) {
        const double once = measure();
        best = std::min(best, once);
        spent += once;
    }
    return best;
}

double best_seconds(double budget, const auto& work) {
    return fastest_seconds(budget, [&] { return seconds_of(work); });
}
double best_thread_seconds(double budget, const auto& work) {
    return fastest_seconds(budget, [&] { return thread_seconds_of(work); });
}

}  // namespace irido::cli
