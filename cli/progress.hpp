#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace irido::cli {

/// A progress bar with the time left on standard error, shown on a terminal for work that takes
/// more than a second.
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
    /// Whether anything is ever shown.
    bool is_on() const { return is_on_; }

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

/// The progress of work that consists of steps. A step is shown while it lasts, even if it says
/// nothing itself.
class StepProgress {
public:
    StepProgress(bool quiet, std::size_t steps);
    ~StepProgress() { clear(); }

    /// Begins the first step, then the next ones.
    void begin(const std::string& what);
    /// Of the current step: what it is at, and the part of it that is done; from any thread.
    void set(double part, const std::string& what);
    /// Removes the bar for good.
    void clear();

private:
    void show();

    Progress progress_;
    double steps_, begun_ = 0, part_ = 0;
    std::string step_, what_;
    std::mutex lock_;
    std::condition_variable_any woken_;
    std::jthread ticker_;
};

}  // namespace irido::cli
