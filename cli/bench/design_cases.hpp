#pragma once

#include <span>
#include <string_view>

namespace irido::cli {

/// A problem of `irido bench design`: a task, and the best merit that is known.
struct DesignCase {
    std::string_view name;
    std::string_view summary;
    double best;  ///< best known merit, published or by longer searches; 0: what fits exactly
    std::string_view task;  ///< a design task, JSON
};

std::span<const DesignCase> design_cases();

}  // namespace irido::cli
