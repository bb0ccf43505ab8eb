#pragma once

#include <span>
#include <string_view>

namespace irido::cli {

/// A problem of `irido bench design`: a task and its best known merit.
struct DesignCase {
    std::string_view name;
    std::string_view summary;
    double best;  ///< best known merit, published or from longer searches; 0: has an exact solution
    std::string_view task;  ///< a design task, JSON
};

std::span<const DesignCase> design_cases();

}  // namespace irido::cli
