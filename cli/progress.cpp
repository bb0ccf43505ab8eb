#include "cli/progress.hpp"

#include <unistd.h>

#include <algorithm>
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
    : is_on_(!quiet && isatty(STDERR_FILENO) == 1), next_(Clock::now() + kPatience) {}

void Progress::set(double done, const std::string& text) {
    if (!is_on_) return;
    const std::lock_guard guard(lock_);
    if (Clock::now() < next_) return;
    next_ = Clock::now() + kInterval;
    is_shown_ = true;
    const double part = std::clamp(done, 0.0, 1.0);
    const int width = text.empty() ? kWidth : kShortWidth;
    const std::string bar(static_cast<std::size_t>(width * part), '=');
    std::fprintf(stderr, "\r[%-*s] %3.0f %%%s\033[K", width, bar.c_str(), 100 * part,
                 text.empty() ? "" : ("  " + text).c_str());
}

void Progress::clear() {
    if (!is_shown_) return;
    std::fputs("\r\033[K", stderr);
    is_shown_ = false;
}

}  // namespace irido::cli
