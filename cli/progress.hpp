#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

namespace irido::cli {

/// A progress bar on standard error, shown on a terminal for work that takes more than a second.
class Progress {
public:
    explicit Progress(bool quiet);
    ~Progress() { clear(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// done  fraction of the work, [0, 1]; may be called from any thread
    /// text  shown after the bar
    void set(double done, const std::string& text = "");
    /// Removes the bar.
    void clear();

private:
    using Clock = std::chrono::steady_clock;

    bool is_on_;
    std::mutex lock_;
    Clock::time_point next_;
    bool is_shown_ = false;
};

}  // namespace irido::cli
