#include "cli/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace irido::cli {

namespace {

constexpr auto kPatience = std::chrono::seconds(1);
constexpr auto kInterval = std::chrono::milliseconds(100);
/// The short bar leaves room for text in 80 columns.
constexpr int kWidth = 40, kShortWidth = 20;

}  // namespace

Progress::Progress(bool quiet)
    : is_on_(!quiet && isatty(STDERR_FILENO) == 1),
      next_(Clock::now() + kPatience),
      begin_(Clock::now()) {}

void Progress::set(double done, const std::string& text) {
    if (!is_on_) return;
    const std::lock_guard guard(lock_);
    if (Clock::now() < next_) return;
    next_ = Clock::now() + kInterval;
    is_shown_ = true;
    const double part = std::clamp(done, 0.0, 1.0);
    const int width = text.empty() ? kWidth : kShortWidth;
    const std::string bar(static_cast<std::size_t>(width * part), '=');
    std::fprintf(stderr, "\r[%-*s] %3.0f %%%s%s\033[K", width, bar.c_str(), 100 * part,
                 text.empty() ? "" : ("  " + text).c_str(), time_left(part).c_str());
}

std::string Progress::time_left(double part) {
    constexpr double kFewest = 0.02, kManySeconds = 100, kMinute = 60;
    const Clock::time_point now = Clock::now();
    if (part < kFewest) {
        begin_ = now;
        begun_ = part;
    }
    if (part < begun_ + kFewest) return "";
    const std::chrono::duration<double> taken = now - begin_;
    const double left = taken.count() * (1 - part) / (part - begun_);
    const bool is_short = left < kManySeconds;
    return ", " + std::to_string(std::lround(is_short ? left : left / kMinute)) +
           (is_short ? " s left" : " min left");
}

void Progress::clear() {
    if (!is_shown_) return;
    std::fputs("\r\033[K", stderr);
    is_shown_ = false;
}

StepProgress::StepProgress(bool quiet, std::size_t steps)
    : progress_(quiet), steps_(static_cast<double>(std::max<std::size_t>(1, steps))) {
    if (!progress_.is_on()) return;
    ticker_ = std::jthread([this](const std::stop_token& stop) {
        std::unique_lock guard(lock_);
        while (!stop.stop_requested()) {
            woken_.wait_for(guard, stop, kInterval, [] { return false; });
            if (begun_ > 0 && !stop.stop_requested()) show();
        }
    });
}

void StepProgress::begin(const std::string& what) {
    const std::lock_guard guard(lock_);
    begun_ += 1;
    part_ = 0;
    step_ = what;
    what_.clear();
}

void StepProgress::set(double part, const std::string& what) {
    const std::lock_guard guard(lock_);
    part_ = std::clamp(part, 0.0, 1.0);
    what_ = what;
}

void StepProgress::show() {
    progress_.set((begun_ - 1 + part_) / steps_, what_.empty() ? step_ : step_ + ": " + what_);
}

void StepProgress::clear() {
    if (ticker_.joinable()) {
        ticker_.request_stop();
        ticker_.join();
    }
    progress_.clear();
}

}  // namespace irido::cli
