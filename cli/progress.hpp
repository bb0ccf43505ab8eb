#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

namespace irido::cli {

/// A progress bar with the time left on standard error, shown on a terminal for work that takes
/// more than a second.
class Progress {
public:
    explicit Progress(bool quiet);
    ~Progress() { clear(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// done  a fraction of the work, [0, 1]; from any thread
    /// text  shown after the bar
    void set(double done, const std::string& text = "");
    /// Removes the bar.
    void clear();

private:
    using Clock = std::chrono::steady_clock;

    /// From how quickly the work went since little of it was done; "" until that is known.
    std::string time_left(double part);

    bool is_on_;
    std::mutex lock_;
    Clock::time_point next_;
    bool is_shown_ = false;
    Clock::time_point begin_;  ///< when the part was begun_
    double begun_ = 0;
};

}  // namespace irido::cli
