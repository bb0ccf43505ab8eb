#pragma once

#include <chrono>
#include <optional>

#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "core/design/global_search.hpp"
#include "schemas/documents/design_document.hpp"

namespace irido::cli {

/// When a search must end: at a signal or after its time.
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

/// Settings of a task's search, which ends according to `end` and reports to `progress`; keeps
/// references to both.
/// task      the design task
/// end       when to end
/// progress  receives the progress
/// threads   number of threads
SearchSettings search_settings(const schemas::DesignTask& task, const SearchEnd& end,
                               Progress& progress, unsigned threads);

}  // namespace irido::cli
