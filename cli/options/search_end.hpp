#pragma once

#include <chrono>
#include <optional>

#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "core/design/global_search.hpp"
#include "schemas/documents/design_document.hpp"

namespace irido::cli {

/// When a search has to end: by a signal, or by its time.
class SearchEnd {
public:
    explicit SearchEnd(std::optional<double> time_s) : time_s_(time_s) {}

    bool operator()() const;
    double seconds() const;
    int signal() const { return orderly_.signal(); }

private:
    using Clock = std::chrono::steady_clock;
    std::optional<double> time_s_;
    OrderlyEnd orderly_;
    Clock::time_point start_ = Clock::now();
};

/// Settings of a task's search, which ends as `end` says and tells `progress`; refers to both.
SearchSettings search_settings(const schemas::DesignTask& task, const SearchEnd& end,
                               Progress& progress, unsigned threads);

}  // namespace irido::cli
