#include "cli/options/search_end.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "cli/options/command.hpp"

namespace irido::cli {

namespace {

std::string short_merit(double merit) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.5g", merit);
    return text.data();
}

}  // namespace

bool SearchEnd::operator()() const {
    return orderly_.signal() != 0 || (time_s_ && seconds() >= *time_s_);
}

double SearchEnd::seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

SearchSettings search_settings(const schemas::DesignTask& task, const SearchEnd& end,
                               Progress& progress, unsigned threads) {
    constexpr std::size_t kUnlimited = std::size_t{1} << 50;
    SearchSettings settings;
    settings.seed = task.seed;
    settings.threads = threads;
    settings.simd = execution_of().simd;
    settings.should_stop = [&end] { return end(); };
    settings.evaluations = task.evaluations.value_or(
        task.time_s && task.method != "refine" ? kUnlimited : kUsualEvaluations);
    settings.tell = [&end, &progress, time_s = task.time_s](const SearchNews& news) {
        std::string text = "merit " + short_merit(news.merit);
        if (news.layers > 0) text += ", " + std::to_string(news.layers) + " layers";
        double done = news.done;
        if (time_s) {
            const double left = std::max(0.0, *time_s - end.seconds());
            done = std::max(done, 1 - left / *time_s);
            text += ", " + std::to_string(std::lround(left)) + " s left";
        }
        progress.set(done, text);
    };
    return settings;
}

}  // namespace irido::cli
